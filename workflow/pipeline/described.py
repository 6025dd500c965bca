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
    """What each present program prints with --describe; docs/format.md has the keys. Raises BuildError
    before the first build."""
    paths = {name: DESCRIPTIONS / f"{name}.json" for name in programs()}
    built = {name: json.loads(path.read_text("utf-8")) for name, path in paths.items() if path.exists()}
    if not built:
        raise BuildError(
            "The options of the programs are unknown before they are compiled: run make build first"
        )
    return built


@cache
def options_of_programs() -> dict[str, dict[str, dict[str, Any]]]:
    """JSON Schema of every option that determines a result, by program and name. Raises BuildError before
    the first build."""
    return {
        name: {
            option: schema
            for option, schema in program["options"]["properties"].items()
            if schema["affects_results"]
        }
        for name, program in described().items()
    }
