"""Compares results with reruns by programs that are compiled afresh, once for each state of the sources.

Exit status: 0 if all agree, 1 if not, 3 if there is nothing to rerun or a rerun failed.
"""

import os
import random
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path
from shlex import quote

import numpy as np

from workflow.lib.identity import identity_of
from workflow.lib.load import FormatError, Result, load
from workflow.pipeline.lock import lock
from workflow.pipeline.plan import Plan, runs_of
from workflow.pipeline.program import ProgramError, execute
from workflow.pipeline.sources import programs as all_programs
from workflow.pipeline.sources import source_hash
from workflow.render.files import missing

BUILD = Path("build/verify")  # with a folder for each hash of the sources


def differing(one: Result, other: Result) -> list[str]:
    """Names of the quantities whose arrays differ."""

    def arrays(result: Result, name: str) -> dict[str, np.ndarray]:
        return result[name].arrays() if name in result.quantities else {}

    def equal(name: str) -> bool:
        a, b = arrays(one, name), arrays(other, name)
        return a.keys() == b.keys() and all(np.array_equal(a[part], b[part], equal_nan=True) for part in a)

    return [name for name in {**one.quantities, **other.quantities} if not equal(name)]


def verify(plan: Plan, names: Sequence[str], sample: float) -> int:
    """Reruns the results of the named panels, or a sample of all. Other commands may make products
    meanwhile. Returns the exit status."""
    runs = runs_of([plan[name] for name in names] or plan)
    lacking = {*missing(runs)}
    made = [path for path in runs if path not in lacking]
    if not names:
        made = random.sample(made, min(len(made), max(1, round(sample * len(made)))))
    if not made:
        target = f"panel PANEL={quote(' '.join(names))}" if names else "figures"
        print(f"Nothing to verify: run make {target} {plan.quality.arguments}")
        return 3
    lock(BUILD)
    programs = sorted({runs[path].program for path in made})
    fresh = BUILD / identity_of([source_hash(program) for program in all_programs()])
    for former in (folder for folder in BUILD.iterdir() if folder.is_dir() and folder != fresh):
        shutil.rmtree(former)
    uncompiled = [program for program in programs if not (fresh / "bin" / program).exists()]
    if uncompiled:
        print(f"Compiling {', '.join(uncompiled)}", flush=True)
        command = ["bash", "workflow/pipeline/environment/build.sh", *uncompiled]
        if subprocess.run(command, env=os.environ | {"BUILD": str(fresh)}, check=False).returncode:
            return 1
    differ = failed = 0
    for number, path in enumerate(made, 1):
        run, again = runs[path], fresh / "again.h5"
        try:
            execute(run.program, run.options, again, fresh / "bin")
            quantities = differing(load(path), load(again))
            differ += bool(quantities)
            text = f"differs: {', '.join(quantities)}" if quantities else "equal"
        except (FormatError, ProgramError) as error:
            text, failed = str(error), failed + 1
        print(f"{number} of {len(made)}: {path}: {text}", flush=True)
    print(f"{len(made)} results rerun: {differ} differ, {failed} could not be compared")
    return 1 if differ else 3 if failed else 0
