"""Executes programs and reference simulators and measures their CPU time."""

import resource
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from workflow.configuration import arguments
from workflow.lib.load import Result, load
from workflow.plan import Run, load_plan
from workflow.program import PROGRAMS
from workflow.program import execute as execute_program

QUALITY = "smoke"  # fewest pairs per replica and largest target errors


@dataclass(frozen=True)
class Done:
    result: Result
    seconds: float  # CPU time of the process
    log: str  # output on the standard error stream


@cache
def planned(panel: str, run: str) -> Run:
    return load_plan(QUALITY)[panel].run(run)


def shortened(times: float | str, fraction: float) -> str:
    """Scales a time, or each time of a list."""
    return ",".join(f"{fraction * float(time):.6g}" for time in str(times).split(","))


def call(program: str, **options: object) -> Done:
    """Executes a program; underscores in names of options become dashes. Raises ProgramError."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "out.h5"
        log, seconds = _timed(lambda: execute_program(program, _dashed(options), output))
        return Done(load(output), seconds, log)


def execute(run: Run, **changes: object) -> Done:
    """Executes a planned run with changed options on one thread."""
    threads = {"threads": 1} if run.replicated else {}
    return call(run.program, **run.options | {"progress": "log"} | threads | changes)


def simulate(simulator: str, **options: object) -> tuple[np.ndarray, float]:
    """Table printed by a simulator of tests/cpp/reference, as text, and its CPU seconds. Raises CalledProcessError."""
    command = [str(PROGRAMS / "reference_simulator"), simulator, *arguments(_dashed(options))]
    printed, seconds = _timed(lambda: subprocess.check_output(command, text=True))
    return np.array([line.split() for line in printed.splitlines()]), seconds


def _dashed(options: dict[str, object]) -> dict[str, object]:
    return {name.replace("_", "-"): value for name, value in options.items()}


def _timed(run: Callable[[], str]) -> tuple[str, float]:
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = run()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
