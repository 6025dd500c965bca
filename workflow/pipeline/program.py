"""Compiles and runs the programs of build/bin."""

import os
import subprocess
import sys
from functools import cache
from pathlib import Path

from workflow.lib.identity import ROOT
from workflow.pipeline.configuration import Options, arguments
from workflow.pipeline.described import DESCRIPTIONS, BuildError, describe
from workflow.pipeline.plan import Run
from workflow.pipeline.sources import is_sampled, programs, source_hash

PROGRAMS = ROOT / "build/bin"
WRITTEN = (0, 4)  # exit statuses with a result; 4: stopped before the target error, and marked
REPLICAS_PER_THREAD, MOST_THREADS = 32, 16


class ProgramError(ValueError):
    """A program has refused its options, or has failed."""


def is_built(program: str) -> bool:
    """Whether a program is described, starts and states the hash of its present sources. Neither times nor
    folders decide."""
    if not (DESCRIPTIONS / f"{program}.json").is_file():
        return False
    try:
        done = subprocess.run([PROGRAMS / program, "--version"], capture_output=True, text=True, check=False)
    except OSError:
        return False
    return source_hash(program) in done.stdout


@cache
def require_built(program: str) -> None:
    """Raises BuildError."""
    if not is_built(program):
        state = "not built from the present sources" if (PROGRAMS / program).is_file() else "missing"
        raise BuildError(f"build/bin/{program} is {state}: run make build")


def compile_programs() -> list[str]:
    """Compiles the programs unless all are built and described. CXX may choose another compiler, so that
    the build is checked in any case. Returns the sources that do not compile if others do, after a message.
    Raises CalledProcessError."""

    def unbuilt() -> list[str]:
        return [name for name in programs() if not is_built(name)]

    lacking = unbuilt()
    if not lacking and "CXX" not in os.environ:
        return []
    if lacking:
        number = f"{len(lacking)} program{'s' * (len(lacking) > 1)}"
        print(f"Compiling {number}; all ten take about 70 seconds of CPU time", flush=True)
    done = subprocess.run(["bash", "workflow/pipeline/environment/build.sh", "all"], check=False)
    failed = [f"cpp/observables/{name}.cpp" for name in unbuilt()] if done.returncode else []
    if not 0 < len(failed) < len(programs()):
        done.check_returncode()
    if failed:
        print(f"{', '.join(failed)}: not compiled, for the reason above", file=sys.stderr)
    return failed


def threads_of(run: Run) -> int:
    """Threads among which the replicas of a run are divided without waste."""
    least = describe(run.program).get("least_replicas", 1) if "target-error" in run.options else 1
    return max(1, min(MOST_THREADS, int(run.options.get("replicas", least)) // REPLICAS_PER_THREAD))


def command_line(run: Run, threads: int = 1) -> list[str]:
    """Command of a run as a list of words, without the option --output."""
    conduct = ["--threads", str(threads), "--resume"] if is_sampled(run.program) else []
    return [f"build/bin/{run.program}", *arguments(run.options), *conduct]


def execute(program: str, options: Options, output: Path, programs: Path = PROGRAMS) -> None:
    """Executes a program, which writes its result to `output`. Raises ProgramError with what it prints."""
    command = [str(programs / program), *arguments(options), "--overwrite", "--output", str(output)]
    done = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode not in WRITTEN:
        raise ProgramError(done.stderr.strip() or f"{program} exits with {done.returncode}")
