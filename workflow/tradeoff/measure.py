"""Runs programs at the settings of panels and says what they found and what they cost."""

import json
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from workflow.lib.configuration import arguments
from workflow.lib.load import Result, load
from workflow.lib.plan import Run, load_plan

QUALITY = "smoke"  # whose pairs per replica and target errors are the smallest


def planned(panel: str, run: str) -> Run:
    return load_plan(QUALITY)[panel].run(run)


def shortened(times: float | str, share: float) -> str:
    """A part of a time, of each of a list, or of every term of a polynomial in N."""
    return re.sub(
        r"(?<!\^)\d+\.?\d*(e[+-]?\d+)?", lambda number: f"{share * float(number[0]):.6g}", str(times)
    )


@dataclass(frozen=True)
class Done:
    result: Result
    seconds: float  # CPU time of the process, on one thread
    said: str  # on standard error


def call(program: Path, **options: object) -> Done:
    """Runs a program once. Underscores of the options stand for dashes; of two options that then are one the last
    counts. Raises RuntimeError with what the program says if it fails."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "out.h5"
        named = {key.replace("_", "-"): value for key, value in options.items()} | {"output": output}
        done = subprocess.run([program, *arguments(named)], check=False, capture_output=True, text=True)
        if done.returncode not in (0, 4):  # 4: the target was not reached
            raise RuntimeError(done.stderr)
        seconds = json.loads(output.with_suffix(".cost.json").read_text())["cpu_seconds"]
        return Done(load(output), seconds, done.stderr)


def attempt(programs: Path, run: Run, **changes: object) -> Done:
    """At the settings of a run, but for the changes; reports its progress."""
    threads = {"threads": 1} if run.replicated else {}
    return call(programs / run.program, **run.options | changes | threads, progress="log")


def execute(programs: Path, run: Run, **changes: object) -> tuple[Result, float]:
    done = attempt(programs, run, **changes)
    return done.result, done.seconds
