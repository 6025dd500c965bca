"""Reruns a sample of the results, or a panel with its figure, with freshly compiled programs and compares bytes.

Exit status: 0 if all bytes are equal, 1 if not, 2 for bad input, 3 without results or if a result could not be checked.
"""

import os
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from workflow.lib.command import command, counted
from workflow.lib.files import ROOT, file_hash, in_one_line
from workflow.lib.program import ProgramError, execute
from workflow.provenance.checks import Products
from workflow.provenance.redraw import redraw

FRESH = ROOT / "build/verify"


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
    quality, products = options.quality, Products(options.quality, plan)
    runs = [(products.result(panel.name, run), run) for panel in panels for run in panel.runs]
    runs = [(path, run) for path, run in runs if (ROOT / path).is_file()]
    if bounded := [path for path, run in runs if run.hours is not None]:
        print(f"{len(bounded)} results not checked: HOURS stopped their runs by the clock")
        runs = [(path, run) for path, run in runs if path not in bounded]
    if not options.panel:
        runs = random.sample(runs, min(len(runs), max(1, round(options.sample * len(runs)))))
    if not runs:
        print(f"No results at quality {quality}: run make figures QUALITY={quality}", file=sys.stderr)
        sys.exit(3)
    programs = options.programs or compile_afresh()
    differing, unchecked = [], 0
    with tempfile.TemporaryDirectory() as folder:
        for number, (path, run) in enumerate(runs, 1):
            again = Path(folder) / f"{number}.h5"
            try:
                execute(run.program, run.options, again, programs=ROOT / programs)
                same = file_hash(again) == file_hash(ROOT / path)
                state = "equal bytes" if same else "other bytes"
                differing += [] if same else [path]
            except (ProgramError, OSError) as error:
                state = f"not checked: {in_one_line(error) if isinstance(error, OSError) else error}"
                unchecked += 1
            print(f"{number} of {len(runs)}: {path}: {state}", flush=True)
    figures = options.panel or []
    faults = [fault for fault in (redraw(products, name) for name in figures) if fault]
    print(*faults, sep="\n", end="\n" * bool(faults))
    rendered = f"; {counted(len(figures), 'panel')} rendered again: {len(faults)} differ" if figures else ""
    missing = f", {unchecked} not checked" if unchecked else ""
    print(f"{counted(len(runs), 'result')} rerun: {len(differing)} differ{missing}{rendered}")
    sys.exit(1 if differing or faults else 3 if unchecked else 0)


if __name__ == "__main__":
    main()
