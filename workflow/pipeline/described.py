"""Options and quantities that the programs declare: build/describe/*.json, which the build writes (PROGRAM
--describe)."""

import json
from functools import cache
from typing import Any

from workflow.lib.identity import ROOT
from workflow.pipeline.sources import programs


class BuildError(ValueError):
    """A program is missing, or is not built from the present sources."""


DESCRIPTIONS = ROOT / "build/describe"


@cache
def described() -> dict[str, dict[str, Any]]:
    """What each compiled program prints with --describe; docs/format.md has the keys."""
    paths = {name: DESCRIPTIONS / f"{name}.json" for name in programs()}
    return {name: json.loads(path.read_text("utf-8")) for name, path in paths.items() if path.exists()}


@cache
def options_of_programs() -> dict[str, dict[str, dict[str, Any]]]:
    """JSON Schema of every option that determines a result, by compiled program and name."""
    return {
        name: {
            option: schema
            for option, schema in program["options"]["properties"].items()
            if schema["affects_results"]
        }
        for name, program in described().items()
    }
