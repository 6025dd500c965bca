"""Options and quantities that the programs declare: build/describe/*.json, which the build writes (PROGRAM
--describe)."""

import json
from typing import Any

from workflow.lib.identity import ROOT
from workflow.pipeline.sources import programs


class BuildError(ValueError):
    """A program is missing, or is not built from the present sources."""


DESCRIPTIONS = ROOT / "build/describe"


def describe(program: str) -> dict[str, Any]:
    """What a compiled program prints with --describe; docs/format.md has the keys. Raises OSError."""
    return dict(json.loads((DESCRIPTIONS / f"{program}.json").read_text("utf-8")))


def described() -> dict[str, dict[str, Any]]:
    """Descriptions of all compiled programs, by name."""
    return {name: describe(name) for name in programs() if (DESCRIPTIONS / f"{name}.json").exists()}


def options_of_programs() -> dict[str, dict[str, dict[str, Any]]]:
    """Description of every option that determines a result, by compiled program and name."""
    return {
        name: {
            option: description
            for option, description in program["options"].items()
            if description["role"] != "execution"
        }
        for name, program in described().items()
    }
