"""Reruns a sample of the results with programs that are compiled afresh, or all of a panel and its figure, and compares bytes.

Exit status: 0 if all get the same bytes, 1 if one does not, 2 for bad input, 3 if there is nothing to compare with.
"""

import os
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from workflow.lib.configuration import arguments
from workflow.lib.figure_metadata import ROOT, file_hash
from workflow.lib.plan import data_path
from workflow.provenance.checks import command
from workflow.provenance.redraw import redraw

FRESH = ROOT / "build/verify"
WRITTEN = (0, 4)  # exit statuses of programs that wrote their result


def compile_afresh() -> Path:
    """Folder of the executables, compiled without the compiler's cache."""
    shutil.rmtree(FRESH, ignore_errors=True)
    settings = os.environ | {"BUILD": str(FRESH), "CCACHE_DISABLE": "1"}
    subprocess.run(["bash", "workflow/environment/build.sh", "all"], cwd=ROOT, env=settings, check=True)
    return FRESH / "bin"


def main() -> None:
    options, products, panels = command(
        __doc__,
        sample={"type": float, "required": True, "help": "fraction of the results, without a panel"},
        programs={"type": Path, "help": "executables; compiled afresh where none are given"},
    )
    quality = options.quality
    runs = [(panel.name, run) for panel in panels for run in panel.runs]
    runs = [(panel, run) for panel, run in runs if (ROOT / data_path(quality, panel, run.name)).is_file()]
    if not options.panel:
        runs = random.sample(runs, min(len(runs), max(1, round(options.sample * len(runs)))))
    if not runs:
        print(f"No results at quality {quality}: run make figures QUALITY={quality}", file=sys.stderr)
        sys.exit(3)
    programs = options.programs or compile_afresh()
    differing = []
    with tempfile.TemporaryDirectory() as folder:
        for number, (panel, run) in enumerate(runs, 1):
            path, again = data_path(quality, panel, run.name), Path(folder) / "again.h5"
            again.unlink(missing_ok=True)
            rerun = [str(ROOT / programs / run.program), *arguments(run.options), "--output", str(again)]
            done = subprocess.run(rerun, capture_output=True, text=True, check=False)
            same = done.returncode in WRITTEN and file_hash(again) == file_hash(ROOT / path)
            print(f"{number} of {len(runs)}: {path}: {'same bytes' if same else 'other bytes'}", flush=True)
            differing += [] if same else [path]
    if options.panel and (fault := redraw(products, options.panel)):
        print(fault)
        differing.append(fault.path)
    print(f"{len(runs)} results rerun: {len(differing)} differ")
    sys.exit(1 if differing else 0)


if __name__ == "__main__":
    main()
