"""Runs the programs of build/bin."""

import subprocess
from collections.abc import Sequence
from pathlib import Path

from workflow.lib.configuration import Options, arguments
from workflow.lib.files import ROOT
from workflow.lib.plan import Run

PROGRAMS = ROOT / "build/bin"
WRITTEN = (0, 4)  # exit statuses with a result; 4: stopped before the target error, and marked


class ProgramError(ValueError):
    """A program has refused its options, or has failed."""


def command_line(run: Run, programs: Path | str = "build/bin", limit: float | None = None) -> list[str]:
    """Words of the command of a run, without its output. limit: seconds after which no replica starts."""
    conduct = ["--threads", "1", "--resume"] if run.replicated else []
    conduct += [] if limit is None or not run.replicated else ["--time-limit", f"{limit:.0f}"]
    return [f"{programs}/{run.program}", *arguments(run.options), *conduct]


def execute(
    program: str, options: Options, output: Path, *more: str, programs: Path = PROGRAMS
) -> subprocess.CompletedProcess[str]:
    """Writes the result of a program. Raises ProgramError with its message."""
    words: Sequence[str | Path] = [programs / program, *arguments(options), *more, "--output", output]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode not in WRITTEN:
        raise ProgramError(done.stderr.strip())
    return done
