"""What the programs declare: their output with --describe (docs/format.md)."""

import json
import subprocess
from functools import cache
from typing import Any

from workflow.lib.identity import ROOT
from workflow.pipeline.sources import programs


@cache
def described() -> dict[str, dict[str, Any]]:
    """Options and quantities of all programs, by name."""
    texts = {
        name: subprocess.run(
            [ROOT / "build/bin" / name, "--describe"], capture_output=True, check=True
        ).stdout
        for name in programs()
    }
    return {name: json.loads(text) for name, text in texts.items()}


def options_of_programs() -> dict[str, dict[str, dict[str, Any]]]:
    """Description of every option that determines a result, by program and name."""
    return {
        name: {option: what for option, what in program["options"].items() if what["role"] != "execution"}
        for name, program in described().items()
    }
