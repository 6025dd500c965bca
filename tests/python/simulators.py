"""Runs programs on one thread, and the reference simulators of tests/cpp/reference."""

import subprocess
import tempfile
from pathlib import Path

import numpy as np

from workflow.configuration import arguments
from workflow.lib.load import Result, load
from workflow.program import PROGRAMS, execute


def call(program: str, **options: object) -> Result:
    """Result of a program; underscores in names of options become dashes. Raises ProgramError."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "out.h5"
        execute(program, _dashed(options), output)
        return load(output)


def simulate(simulator: str, **options: object) -> np.ndarray:
    """Table printed by a reference simulator, as text. Raises CalledProcessError."""
    command = [str(PROGRAMS / "reference_simulator"), simulator, *arguments(_dashed(options))]
    printed = subprocess.check_output(command, text=True)
    return np.array([line.split() for line in printed.splitlines()])


def _dashed(options: dict[str, object]) -> dict[str, object]:
    return {name.replace("_", "-"): value for name, value in options.items()}
