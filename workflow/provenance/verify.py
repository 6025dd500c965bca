"""Reruns a sample of the results, or a panel with its figure, with freshly compiled programs and compares bytes.

Exit status: 0 if all bytes are equal, 1 if not, 2 for bad input, 3 without results.
"""

import os
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from workflow.lib.command import command
from workflow.lib.configuration import arguments
from workflow.lib.figure_metadata import ROOT, file_hash
from workflow.lib.plan import data_path
from workflow.provenance.checks import Products
from workflow.provenance.redraw import redraw

FRESH = ROOT / "build/verify"
WRITTEN = (0, 4)  # exit statuses with a result


def compile_afresh() -> Path:
    """Compiles without a compiler cache. Returns the folder of the executables."""
    shutil.rmtree(FRESH, ignore_errors=True)
    settings = os.environ | {"BUILD": str(FRESH), "CCACHE_DISABLE": "1"}
    subprocess.run(["bash", "workflow/environment/build.sh", "all"], cwd=ROOT, env=settings, check=True)
    return FRESH / "bin"


def main() -> None:
    options, plan, panels = command(
        __doc__,
        sample={"type": float, "required": True, "help": "fraction of the results if no panel is given"},
        programs={"type": Path, "help": "folder of executables; by default they are compiled"},
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
            print(f"{number} of {len(runs)}: {path}: {'equal bytes' if same else 'other bytes'}", flush=True)
            differing += [] if same else [path]
    if options.panel and (fault := redraw(Products(quality, plan), options.panel)):
        print(fault)
        differing.append(fault.path)
    print(f"{len(runs)} results rerun: {len(differing)} differ")
    sys.exit(1 if differing else 0)


if __name__ == "__main__":
    main()
