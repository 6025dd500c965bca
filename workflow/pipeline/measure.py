"""Results from Python: `measure("conductivity", cells=[16, 32], gamma="N", replicas=64)["kappa"]`."""

import itertools
import json
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import pandas as pd

from workflow.lib.identity import ROOT
from workflow.lib.load import FormatError, Result, load, set_aside
from workflow.lib.suggestion import suggestion
from workflow.pipeline.configuration import Options
from workflow.pipeline.described import options_of_programs
from workflow.pipeline.plan import Run, seed_of
from workflow.pipeline.program import ProgramError, execute, require_built
from workflow.pipeline.sources import code_hashes

if TYPE_CHECKING:
    import xarray

MEASURED = ROOT / "data/measured"
CONDUCT = ("threads",)  # options of the execution


class MeasureError(ValueError):
    """The program or an option is unknown, or the program has refused a value."""


def measure(program: str, **options: object) -> "xarray.DataTree":
    """Runs a program and returns its result as from Result.to_xarray(). Options are those of the command line, with underscores for dashes and
    True for a flag; also threads. A list of values of an option gives every quantity its dimension; of options whose value is
    itself a list, as times, a list of numbers is one value, and a list of texts as "1,2,4" gives the dimension. `result["doubts"]` has the
    reasons to doubt each result.

    The seed follows from program and options, so that two calls with different options have independent errors; `seed=1` in several
    calls shares their random numbers. A result of these options and sources in data/measured is not measured again, unless it was
    edited. An interrupted call writes a checkpoint, from which the next one continues. Warns if a run was not stationary or missed its target error.

    Raises MeasureError; BuildError if the program is not built from the present sources."""
    known = options_of_programs()
    if program not in known:
        raise MeasureError(f"{program} is not a program; {suggestion(program, known)}")
    given = _checked(program, options, known[program])
    code_hashes.cache_clear()  # the sources may have changed in this session
    require_built(program)
    listed = {name: value for name, value in given.items() if isinstance(value, list)}
    points = [
        _plain(dict(zip(listed, values, strict=True))) for values in itertools.product(*listed.values())
    ]
    results = [_result(program, _plain(given | point), known[program]) for point in points]
    for point, result in zip(points, results, strict=True):
        if result.doubts:
            where = "".join(f" at {name} = {value}" for name, value in point.items())
            warnings.warn(f"{program}{where}: {', '.join(result.doubts)}", stacklevel=2)
    trees = [result.to_xarray() for result in results]
    return _combined(trees, listed)


def _checked(program: str, options: Mapping[str, object], known: Mapping[str, Any]) -> dict[str, Any]:
    """Options by the names of the command line, with lists for several values. Raises MeasureError."""
    given: dict[str, Any] = {}
    allowed = [*known, *CONDUCT]
    for key, value in options.items():
        name = key.replace("_", "-")
        if name not in allowed:
            raise MeasureError(f"{program} has no option {name}; {suggestion(name, allowed)}")
        given[name] = value
        if isinstance(value, str) or not isinstance(value, Iterable) or getattr(value, "ndim", 1) == 0:
            continue
        given[name] = [*value]
        of_numbers = given[name] and not any(isinstance(each, str) for each in given[name])
        if of_numbers and "," in known.get(name, {}).get("pattern", ""):  # one value is a list
            given[name] = ",".join(map(str, given[name]))
            continue
        if len({*given[name]}) < max(1, len(given[name])):
            raise MeasureError(f"{name} has no value, or one twice; give a list of different values")
    return given


def _plain(options: Mapping[str, Any]) -> Options:
    """Converts numbers of NumPy to Python's, and whole numbers to integers."""
    plain = {name: getattr(value, "item", lambda value=value: value)() for name, value in options.items()}
    whole = {
        name: int(number)
        for name, number in plain.items()
        if isinstance(number, float) and number.is_integer()
    }
    return plain | whole


def _result(program: str, options: Options, known: Mapping[str, Any]) -> Result:
    threads = {name: options.pop(name) for name in CONDUCT if name in options}
    if "seed" in known and "seed" not in options:
        options["seed"] = seed_of(json.dumps([program, options], sort_keys=True))
    run = Run(program, program, options)
    path = MEASURED / f"{run.name}.{run.identity}.h5"
    if path.exists():
        try:
            return load(path)
        except FormatError as error:
            warnings.warn(set_aside(path, error), stacklevel=4)
    path.parent.mkdir(parents=True, exist_ok=True)
    resume = ["--resume", "--progress", "log"] if run.replicated else []
    try:
        execute(program, options | threads, path, *resume, relay=True)
    except ProgramError as error:
        raise MeasureError(str(error)) from error
    return load(path)


def _combined(trees: "Sequence[xarray.DataTree]", listed: Mapping[str, list[Any]]) -> "xarray.DataTree":
    """Quantities of all points, with a dimension per list, in its order. Axes of different lengths are filled up with NaN."""
    import xarray  # noqa: PLC0415

    def gridded(parts: "Sequence[xarray.Dataset]") -> "xarray.Dataset":
        for name, values in reversed([*listed.items()]):
            dimension = pd.Index(values, name=name)
            groups = [parts[k : k + len(values)] for k in range(0, len(parts), len(values))]
            parts = [
                xarray.concat(group, dimension, join="outer", combine_attrs="drop_conflicts")
                for group in groups
            ]
        return parts[0]

    names = [name for name in trees[0].children if all(name in tree.children for tree in trees)]
    states = ("converged", "doubts")
    root = gridded(
        [xarray.Dataset({name: tree.attrs[name] for name in states}, attrs=tree.attrs) for tree in trees]
    )
    root.attrs = {name: value for name, value in root.attrs.items() if name not in (*states, *listed)}
    return xarray.DataTree.from_dict(
        {"/": root, **{name: gridded([tree[name].to_dataset() for tree in trees]) for name in names}}
    )
