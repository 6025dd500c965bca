"""Compares results with reruns by freshly compiled programs.

Exit status: 0 if all agree, 1 if not, 3 if there is nothing to rerun or a rerun failed.
"""

import argparse
import os
import random
import shutil
import subprocess
from pathlib import Path

from workflow.lib.load import FormatError
from workflow.pipeline.lock import lock_products
from workflow.pipeline.plan import runs_of
from workflow.pipeline.program import ProgramError, execute
from workflow.pipeline.provenance.compare import compared

BUILD = Path("build/verify")


def main(options: argparse.Namespace) -> int:
    """Reruns a sample of the results, or a panel's, with freshly compiled programs."""
    runs = runs_of(options.plan, options.panels or options.plan, options.quality)
    made = [path for path in runs if Path(path).is_file()]
    if not options.panels:
        made = random.sample(made, min(len(made), max(1, round(float(options.sample) * len(made)))))
    if not made:
        print(f"Nothing to verify: run make figures {options.effort}")
        return 3
    lock_products()
    shutil.rmtree(BUILD, ignore_errors=True)
    settings = os.environ | {"BUILD": str(BUILD)}
    if subprocess.run(
        ["bash", "workflow/pipeline/environment/build.sh", "all"], env=settings, check=False
    ).returncode:
        return 1
    differing = failed = 0
    for number, path in enumerate(made, 1):
        run, again = runs[path], BUILD / "again.h5"
        try:
            execute(run.program, run.options, again, "--overwrite", programs=BUILD / "bin")
            p, text, _ = compared(path, again, rerun=True)
            differing += p == 0
        except (FormatError, ProgramError) as error:
            text, failed = str(error), failed + 1
        print(f"{number} of {len(made)}: {path}: {text}", flush=True)
    print(f"{len(made)} results rerun: {differing} differ, {failed} could not be compared")
    return 1 if differing else 3 if failed else 0
