"""Executes programs and reference simulators and measures their CPU time."""

import re
import resource
import subprocess
import tempfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from workflow.lib.configuration import arguments
from workflow.lib.load import Result, load
from workflow.lib.plan import Run, load_plan

PROGRAMS = Path(__file__).parents[2] / "build/bin"
QUALITY = "smoke"  # fewest pairs per replica and largest target errors
NUMBER = re.compile(r"(?<!\^)\d+\.?\d*(e[+-]?\d+)?")  # not an exponent of N


@dataclass(frozen=True)
class Done:
    result: Result
    seconds: float  # CPU time of the process
    log: str  # standard error


@cache
def planned(panel: str, run: str) -> Run:
    return load_plan(QUALITY)[panel].run(run)


def shortened(times: float | str, fraction: float) -> str:
    """Scales a time, each time of a list, or every term of a polynomial in N."""
    return NUMBER.sub(lambda number: f"{fraction * float(number[0]):.6g}", str(times))


def call(program: str, **options: object) -> Done:
    """Executes a program; underscores in names of options become dashes. Raises RuntimeError."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "out.h5"
        named = {name.replace("_", "-"): value for name, value in options.items()} | {"output": output}
        done, seconds = _timed(program, arguments(named))
        return Done(load(output), seconds, done.stderr)


def execute(run: Run, **changes: object) -> Done:
    """Executes a planned run with changed options on one thread."""
    threads = {"threads": 1} if run.replicated else {}
    return call(run.program, **run.options | {"progress": "log"} | threads | changes)


def simulate(simulator: str, *words: object) -> tuple[np.ndarray, float]:
    """Table printed by a simulator of tests/cpp/reference, and its CPU seconds. Raises RuntimeError."""
    done, seconds = _timed(f"reference_{simulator}", [str(word) for word in words])
    return np.array([line.split() for line in done.stdout.splitlines()]), seconds


def _timed(program: str, words: list[str]) -> tuple[subprocess.CompletedProcess[str], float]:
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([PROGRAMS / program, *words], check=False, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 4):  # 4: the target error was not reached
        raise RuntimeError(done.stderr)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
