"""Compiles and runs the programs of build/bin."""

import os
import re
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

from workflow.lib.identity import ROOT
from workflow.pipeline.configuration import ConfigurationError, Options, arguments
from workflow.pipeline.plan import Run
from workflow.pipeline.sources import is_sampled, programs, source_hash

PROGRAMS = ROOT / "build/bin"
WRITTEN = (0, 4)  # exit statuses with a result; 4: stopped before the target error, and marked
REPLICAS_PER_THREAD, MOST_THREADS = 32, 16
LEAST = 64  # replicas with a target error, as in cpp/program/stopping_rule.hpp


class BuildError(ValueError):
    """A program is missing, or is not built from the present sources."""


class ProgramError(ValueError):
    """A program has refused its options, or has failed."""


def is_built(program: str) -> bool:
    """Whether a program starts and states the hash of its present sources. Neither times nor folders
    decide."""
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


def require_valid(runs: Iterable[Run]) -> None:
    """Raises ConfigurationError with one line, for the first run, for each reason why a program refuses its
    options, at the position of the option that it names."""

    def refusal(run: Run) -> tuple[str, Run]:
        command = [str(PROGRAMS / run.program), *arguments(run.options), "--describe"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        return done.stderr.strip() if done.returncode else "", run

    refused: dict[str, list[Run]] = defaultdict(list)
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as threads:
        for reason, run in threads.map(refusal, runs):
            if reason:
                refused[reason].append(run)
    lines = []
    for reason, (first, *more) in refused.items():
        position = first.position(re.findall(r"--([\w-]+)", reason))
        number = f" and {len(more)} more" if more else ""
        lines.append(f"{position}: {first.name}{number}: {reason}")
    if lines:
        raise ConfigurationError("\n".join(lines))


def compile_programs() -> list[str]:
    """Compiles the programs unless all are built. CXX may choose another compiler, so that the build is
    checked in any case. Returns the sources that do not compile if others do, after a message. Raises
    CalledProcessError."""

    def unbuilt() -> list[str]:
        return [name for name in programs() if not is_built(name)]

    lacking = unbuilt()
    if not lacking and "CXX" not in os.environ:
        return []
    if lacking:
        number = f"{len(lacking)} programs" if lacking[1:] else "1 program"
        print(f"Compiling {number}: about 7 seconds of CPU time each", flush=True)
    done = subprocess.run(["bash", "workflow/pipeline/environment/build.sh", "all"], check=False)
    failed = [f"cpp/observables/{name}.cpp" for name in unbuilt()] if done.returncode else []
    if not 0 < len(failed) < len(programs()):
        done.check_returncode()
    if failed:
        print(f"{', '.join(failed)}: not compiled, for the reason above", file=sys.stderr)
    return failed


def threads_of(run: Run) -> int:
    """Threads among which the replicas of a run are divided without waste; 1 without replicas."""
    if not is_sampled(run.program):
        return 1
    replicas = run.options.get("replicas", LEAST if "target-error" in run.options else 1)
    return max(1, min(MOST_THREADS, int(replicas) // REPLICAS_PER_THREAD))


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
