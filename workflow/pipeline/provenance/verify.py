"""Compares results with reruns by programs that are compiled afresh, once for each state of the sources.

Exit status: 0 if all agree, 1 if not, 3 if there is nothing to rerun or a rerun failed.
"""

import argparse
import os
import random
import shutil
import signal
import subprocess
from pathlib import Path

from workflow.lib.files import missing
from workflow.lib.identity import identity
from workflow.lib.load import FormatError
from workflow.pipeline.lock import lock
from workflow.pipeline.plan import runs_of
from workflow.pipeline.program import ProgramError, execute
from workflow.pipeline.provenance.compare import compared
from workflow.pipeline.sources import programs as all_programs
from workflow.pipeline.sources import source_hash

BUILD = Path("build/verify")  # with a folder for each hash of the sources


def main(options: argparse.Namespace) -> int:
    """Reruns a sample of the results, or a panel's. Other commands may make products meanwhile."""
    runs = runs_of(options.plan, options.panels or options.plan, options.quality)
    lacking = {*missing(runs)}
    made = [path for path in runs if path not in lacking]
    if not options.panels:
        made = random.sample(made, min(len(made), max(1, round(float(options.sample) * len(made)))))
    if not made:
        print(f"Nothing to verify: run make figures {options.effort}")
        return 3
    lock(BUILD)
    signal.signal(signal.SIGINT, signal.default_int_handler)  # by which execute() stops the program
    programs = sorted({runs[path].program for path in made})
    fresh = BUILD / identity([source_hash(program) for program in all_programs()])
    for former in (folder for folder in BUILD.iterdir() if folder.is_dir() and folder != fresh):
        shutil.rmtree(former)
    uncompiled = [program for program in programs if not (fresh / "bin" / program).exists()]
    if uncompiled:
        print(f"Compiling {', '.join(uncompiled)}", flush=True)
        command = ["bash", "workflow/pipeline/environment/build.sh", *uncompiled]
        if subprocess.run(command, env=os.environ | {"BUILD": str(fresh)}, check=False).returncode:
            return 1
    differing = failed = 0
    for number, path in enumerate(made, 1):
        run, again = runs[path], fresh / "again.h5"
        try:
            execute(run.program, run.options, again, "--overwrite", programs=fresh / "bin")
            p, text, _ = compared(path, again, rerun=True)
            differing += p == 0
        except (FormatError, ProgramError) as error:
            text, failed = str(error), failed + 1
        print(f"{number} of {len(made)}: {path}: {text}", flush=True)
    print(f"{len(made)} results rerun: {differing} differ, {failed} could not be compared")
    return 1 if differing else 3 if failed else 0
