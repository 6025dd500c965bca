"""One result from Python: `measure("conductivity", cells=64, gamma="N", replicas=64)["kappa"]`."""

import json
from typing import TYPE_CHECKING

from workflow.lib.configuration import Options
from workflow.lib.files import ROOT
from workflow.lib.load import load
from workflow.lib.nearest import nearest
from workflow.lib.plan import Run, build_id
from workflow.lib.program import ProgramError, execute
from workflow.lib.units import SCHEMA

if TYPE_CHECKING:
    import xarray

FOLDER = ROOT / "data/measured"


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
    build_id.cache_clear()  # the program may have been compiled again in this session
    run = Run(program, program, named)
    path = FOLDER / f"{run.name}.{run.identity}.h5"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            execute(program, named, path, "--progress", "none")
        except ProgramError as error:
            raise MeasureError(str(error)) from error
    return load(path).to_xarray()
