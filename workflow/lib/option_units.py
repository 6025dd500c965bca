"""Units of the programs' options, as the programs declare them (`make describe`)."""

from functools import cache
from pathlib import Path

import yaml

SCHEMA = Path(__file__).parents[1] / "config/schema.yaml"


@cache
def option_units() -> dict[str, str]:
    """By option; all others are pure numbers."""
    programs = yaml.safe_load(SCHEMA.read_text())["programs"]
    return {
        name: option["units"]
        for options in programs.values()
        for name, option in options.items()
        if "units" in option
    }
