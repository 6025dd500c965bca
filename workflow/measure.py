"""One result from Python: `measure("conductivity", cells=64, gamma="N", replicas=64)["kappa"]`."""

import hashlib
import json
import subprocess
from typing import TYPE_CHECKING

from workflow.lib.configuration import Options, arguments
from workflow.lib.load import load
from workflow.lib.nearest import nearest
from workflow.lib.units import SCHEMA
from workflow.provenance.build_id import ROOT, built

if TYPE_CHECKING:
    import xarray

FOLDER = ROOT / "data/measured"
NOT_CONVERGED = 4  # exit status: the result is written, and marked


class MeasureError(ValueError):
    """The program or an option is unknown, or the program has refused a value."""


def measure(program: str, **options: object) -> "xarray.DataTree":
    """Runs a program, unless its result of these options and this build is in data/measured, and returns what
    Result.to_xarray() does. Options are those of the command line, with underscores for dashes and True for a flag.
    Raises MeasureError; BuildError if the program is missing or older than its sources."""
    known = json.loads(SCHEMA.read_text("utf-8"))["programs"]
    if program not in known:
        raise MeasureError(f"{program} is not a program; {nearest(program, known)}")
    named: Options = {name.replace("_", "-"): value for name, value in sorted(options.items())}
    for name in named.keys() - known[program].keys():
        raise MeasureError(f"{program} has no option {name}; {nearest(name, known[program])}")
    words = [program, *arguments(named)]
    identity = hashlib.sha256(json.dumps([*words, built(program)["build_id"]]).encode()).hexdigest()
    path = FOLDER / program / f"{identity[:16]}.h5"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        words += ["--progress", "none", "--output", str(path)]
        done = subprocess.run(
            words, executable=ROOT / "build/bin" / program, stderr=subprocess.PIPE, text=True, check=False
        )
        if done.returncode not in (0, NOT_CONVERGED):
            raise MeasureError(done.stderr.strip())
    return load(path).to_xarray()
