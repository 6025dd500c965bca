"""Renders a panel again in build/audit and compares bytes."""

import subprocess
import sys
from pathlib import Path

from workflow.lib.figure_metadata import read_panel
from workflow.lib.files import ROOT, file_hash
from workflow.lib.plan import drawing_command
from workflow.provenance.checks import Fault, Kind, Products, other_package


def redraw(products: Products, panel: str) -> Fault | None:
    """Fault of the first file whose bytes differ, which stays for comparison; None if all are equal."""
    *files, record = products.files_of(products.plan[panel])
    drawn_with = read_panel(ROOT / record)["parents"].python
    here = f"{sys.version_info.major}.{sys.version_info.minor}"
    if drawn_with != here:
        return Fault(files[0], f"rendered by Python {drawn_with}, this is {here}", Kind.UNCHECKED)
    if difference := other_package():
        return Fault(files[0], f"other packages: {difference}", Kind.UNCHECKED)
    again = ROOT / "build/audit" / products.quality
    command = drawing_command(products.plan[panel].script, str(again / panel), products.results_of(panel))
    words = ["bash", "-c", f"source workflow/environment/variables.sh; {command}"]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        return Fault(files[0], f"cannot be rendered: {last}", Kind.UNCHECKED)
    for path in files:
        fresh = again / Path(path).name
        if file_hash(ROOT / path) != file_hash(fresh):
            return Fault(path, f"rendering it again gives other bytes: compare {fresh.relative_to(ROOT)}")
    for fresh in again.glob(f"{panel}.*"):
        fresh.unlink()
    return None
