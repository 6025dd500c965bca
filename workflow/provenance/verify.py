"""Reruns a sample of the results with programs that are compiled afresh, or all of a panel and its figure, and compares bytes.

Exit status: 0 if all get the same bytes, 1 if one does not, 2 for bad input, 3 if there is nothing to compare with.
"""

import argparse
import random
import subprocess
import sys
import tempfile
from pathlib import Path

from workflow.lib.configuration import ConfigurationError, arguments
from workflow.lib.figure_metadata import ROOT, file_hash
from workflow.lib.plan import data_path, panel_named, with_used
from workflow.provenance.checks import Products
from workflow.provenance.redraw import redraw

FRESH = ROOT / "build/verify"
WRITTEN = (0, 4)  # exit statuses of programs that wrote their result


def compile_afresh() -> Path:
    """Folder of the executables, compiled without the compiler's cache."""
    configure = ["cmake", "-S", "cpp", "-B", str(FRESH), "-G", "Ninja", "-DCOMPILER_CACHE=none"]
    for command in (configure, ["ninja", "-C", str(FRESH), "-t", "clean"], ["ninja", "-C", str(FRESH)]):
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(
                f"{done.stdout[-2000:]}{done.stderr[-2000:]}make verify: the programs cannot be compiled"
            )
    return FRESH / "bin"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--sample", type=float, required=True, help="fraction of the results")
    parser.add_argument("--panel", help="all results that this panel shows, and its figure")
    parser.add_argument("--programs", type=Path, help="executables; compiled afresh where none are given")
    options = parser.parse_args()
    quality = options.quality
    try:
        products = Products(quality)
        panels = (
            with_used(products.plan, panel_named(products.plan, options.panel).name)
            if options.panel
            else products.plan.values()
        )
    except ConfigurationError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
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
            command = [str(ROOT / programs / run.program), *arguments(run.options), "--output", str(again)]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
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
