"""Entry point of the figure scripts: loads the results, renders and saves a panel.

A script defines draw(results) and ends with `main(draw, title)`. A title that differs between panels is a function of the results. `@plots`
before draw names the plotted series. Anything else is in workflow/lib and workflow/physics, or named by `reads` of the panel.
Units of columns that are not named after a quantity, an axis or an option are keyword arguments, which also hold for the columns of
their errors: `main(draw, title, deviation="1")`.
"""

import argparse
import inspect
import os
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import listed, with_doubts, with_rules
from workflow.lib.columns import as_csv, inherited
from workflow.lib.identity import ROOT, SHARED, named_identity, panel_identity, sources_of_panel
from workflow.lib.load import FormatError, Result, load, set_aside
from workflow.lib.save import Parents, Text, save
from workflow.lib.units import UnitsError

Parts = tuple[
    Figure, pd.DataFrame, str
]  # figure, table of the plotted numbers, caption as one paragraph of plain text

Draw = Callable[[Sequence[Result]], Parts]

SCRIPT = Path(sys.argv[0]).resolve()
FIGURES = ROOT / "workflow/figures"
LIBRARIES = (".venv", ".cache")  # uv.lock determines the packages; the cache changes no figure
opened: set[str] = set()  # files that the script reads


def _record(event: str, arguments: tuple[Any, ...]) -> None:
    if event == "open" and isinstance(arguments[0], str) and not arguments[2] & (os.O_WRONLY | os.O_CREAT):
        opened.add(arguments[0])


def _open_hdf5(name: bytes, *arguments: Any, original: Any = h5py.h5f.open, **named: Any) -> Any:
    """HDF5 opens files itself, and Python reports no event."""
    opened.add(os.fsdecode(name))
    return original(name, *arguments, **named)


if SCRIPT.parent == FIGURES:  # from here on, as a script may read files before it calls main
    sys.addaudithook(_record)
    h5py.h5f.open = _open_hdf5


class UndeclaredError(ValueError):
    """A script uses a file on which the identity of its panel does not depend."""


def require_declared(panel: str, allowed: Iterable[Path]) -> None:
    """Raises UndeclaredError if the script has read or imported another file of the project."""
    modules = [getattr(module, "__file__", None) for module in [*sys.modules.values()]]
    files = sorted({Path(os.path.abspath(file)) for file in (*opened, *modules) if file})
    free = [ROOT / name for name in (*SHARED, *LIBRARIES)] + [Path(os.path.abspath(path)) for path in allowed]
    for file in files:
        own = file.is_relative_to(ROOT) and file.suffix != ".pyc" and file.name != "__init__.py"
        if own and file.is_file() and not any(file.is_relative_to(path) for path in free):
            name = file.relative_to(ROOT)
            remedy = f"add `reads: [{name}]` to {panel} in workflow/config/paper.yaml"
            if file.suffix == ".py":
                remedy = "move what it takes from there to workflow/lib or workflow/physics"
            raise UndeclaredError(
                f"{SCRIPT.name} uses {name}, on which the identity of {panel} does not depend: {remedy}"
            )


@dataclass(frozen=True)
class Plot:
    """draw() of a script that plots series by their names. It names others of the panel in the caption and on stderr."""

    function: Draw
    series: tuple[str, ...]

    def shown(self, results: Iterable[Result]) -> list[Result]:
        """The results of these series; all if none of them is given, as by a panel of one's own with this script."""
        given = [*results]
        return [result for result in given if result.series in self.series] or given * bool(self.series)

    def __call__(self, results: Iterable[Result]) -> Parts:
        given = [*results]
        shown = self.shown(given)
        figure, table, caption = self.function(shown)
        if len(shown) == len(given):
            return figure, table, caption
        own = [result.series for result in given if result.path.parent == given[-1].path.parent]
        if others := [name for name in dict.fromkeys(own) if name not in self.series]:
            caption = f"{caption} Not shown: {listed(others)}."
            script = Path(inspect.getfile(self.function)).name
            print(f"Not shown: {listed(others)}; to plot it, extend {script}", file=sys.stderr)
        return figure, table, caption


def plots(series: str) -> Callable[[Draw], Plot]:
    """Decorator of draw(), which then takes the results of these series only. series: names, separated by blanks."""
    return lambda draw: Plot(draw, tuple(series.split()))


class TheoryError(ValueError):
    """A theory does not hold for the results."""


def require_elastic(results: Sequence[Result], theory: str) -> None:
    """Raises TheoryError if a result has another collision rule than the paper's."""
    for result in results:
        if result.parameters["rule"] != "elastic":
            raise TheoryError(
                f"{theory} holds for elastic collisions only, and {result.path} has the rule {result.parameters['rule']}: leave it "
                "out of the panel"
            )


def main(draw: Draw, title: str | Callable[[Sequence[Result]], str], **units: str) -> None:
    """Renders the panel that the command line names."""
    parser = argparse.ArgumentParser(description="Renders a panel from its results.")
    parser.add_argument("--data", type=Path, nargs="*", default=[], help="result files of the panel")
    parser.add_argument("--reads", nargs="*", default=[], help="files that the script reads, besides")
    parser.add_argument("--output", type=Path, required=True, help="FOLDER/QUALITY/PANEL, without suffix")
    options = parser.parse_args()
    if SCRIPT.parent != FIGURES:
        sys.exit(f"{SCRIPT} is not in {FIGURES}: move it there")
    sources = sources_of_panel(SCRIPT.stem, options.reads)
    panel = options.output.name.partition(".")[0]
    name = panel_identity(panel, map(str, options.data), sources)
    if named_identity(options.output) not in (name, ""):
        sys.exit(f"{', '.join(sources)}: one of these was edited meanwhile: repeat the command")
    costs = [path.with_suffix(".cost.json") for path in options.data]
    try:
        results = read(options.data, rename=bool(named_identity(options.output)))
        style.apply()
        figure, table, caption = draw(results)
        require_declared(panel, [SCRIPT, *options.data, *costs, *map(Path, options.reads)])
        errors = {f"{column}_error": text for column, text in units.items()}
        saved = as_csv(table, inherited(results) | errors | units)
    except (FormatError, OSError, TheoryError, UndeclaredError, UnitsError) as error:
        sys.exit(str(error))
    shown = draw.shown(results) if isinstance(draw, Plot) else results
    own = [result for result in shown if result.path.parent.name == panel] or shown
    whole = with_doubts(with_rules(" ".join(caption.split()), own), shown)
    text = Text(title if isinstance(title, str) else title(shown), whole)
    save(figure, saved, options.output, text, Parents(name, options.data, sources))


def read(paths: Sequence[Path], rename: bool) -> list[Result]:
    """Loads results. Raises FormatError for all that are refused. rename: also sets these aside."""
    results, refused = [], []
    for path in paths:
        try:
            results.append(load(path))
        except FormatError as error:
            again = rename and path.exists()
            refused.append(
                f"{set_aside(path, error)}: the same command makes it again" if again else str(error)
            )
    if refused:
        raise FormatError("\n".join(refused))
    return results
