"""Entry point of the figure scripts: loads the results, renders and saves a panel.

A script defines draw(results) and ends with `run(draw, title)`. A title that differs between panels is a function of the results.
Units of columns that are not named after a quantity, an axis or an option are keyword arguments, which also hold for the columns of
their errors: `run(draw, title, deviation="1")`.
"""

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.closure import FilesRead
from workflow.lib.columns import as_csv, inherited
from workflow.lib.figure_metadata import Parents
from workflow.lib.files import ROOT, refuse_another_folder
from workflow.lib.load import FormatError, Result, load
from workflow.lib.save import Text, save
from workflow.lib.units import UnitsError

Drawn = tuple[
    Figure, pd.DataFrame, str
]  # figure, table of the plotted numbers, caption as one paragraph of plain text
READ = FilesRead()  # created at the first import of a script, so that all later reads are recorded

Draw = Callable[[Sequence[Result]], Drawn]


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


def run(draw: Draw, title: str | Callable[[Sequence[Result]], str], **units: str) -> None:
    """Renders the panel that the command line names."""
    parser = argparse.ArgumentParser(description="Renders a panel from its results.")
    parser.add_argument("--data", type=Path, nargs="+", required=True, help="result files of the panel")
    parser.add_argument("--output", type=Path, required=True, help="figures/QUALITY/PANEL, without suffix")
    options = parser.parse_args()
    script = Path(sys.argv[0]).resolve()
    refuse_another_folder()
    if not script.is_relative_to(ROOT):
        sys.exit(f"{script} is not in {ROOT}: move it into workflow/figures")
    try:
        results = [load(path) for path in options.data]
        style.apply()
        figure, table, caption = draw(results)
        errors = {f"{name}_error": text for name, text in units.items()}
        saved = as_csv(table, inherited(results) | errors | units)
    except (FormatError, OSError, TheoryError, UnitsError) as error:
        sys.exit(str(error))
    parents = Parents.of(str(script.relative_to(ROOT)), options.output, results)
    if unknown := READ.beside(parents.sources):
        sys.exit(
            f"{script.name} reads {unknown[0]}, and no literal in its modules names that file, so that a change of it would not be "
            "noticed: write the name as one literal, relative to the module's folder"
        )
    name = title if isinstance(title, str) else title(results)
    save(figure, saved, options.output, Text(name, " ".join(caption.split())), parents)
