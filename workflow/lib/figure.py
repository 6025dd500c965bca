"""The frame of every figure script: loads the results, renders, saves.

A script defines draw(results) and ends with `run(draw, title)`, where a title that differs between its panels is a function of
the results. It names the units of the columns that are named neither after a quantity nor after an axis or an option, as in
`run(draw, title, deviation="1")`.
"""

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.columns import as_csv, inherited
from workflow.lib.figure_metadata import ROOT, Parents
from workflow.lib.load import FormatError, Result, load
from workflow.lib.save import Text, save
from workflow.lib.units import UnitsError

Draw = Callable[[Sequence[Result]], tuple[Figure, pd.DataFrame, str]]


def run(draw: Draw, title: str | Callable[[Sequence[Result]], str], **units: str) -> None:
    """draw gets the panel's results and returns the figure, the table of the plotted numbers, and the caption: a paragraph
    of plain text with numbers from the data."""
    parser = argparse.ArgumentParser(description="Renders a panel from its results.")
    parser.add_argument("--data", type=Path, nargs="+", required=True, help="result files of the panel")
    parser.add_argument("--configuration", default="", help="hash of the panel's configuration")
    parser.add_argument("--output", type=Path, required=True, help="figures/QUALITY/PANEL, without suffix")
    options = parser.parse_args()
    script = Path(sys.argv[0]).resolve()
    if Path.cwd() != ROOT or not script.is_relative_to(ROOT):
        sys.exit(f"The modules of {ROOT} are installed here, not those of {Path.cwd()}: run make setup")
    try:
        results = [load(path) for path in options.data]
        style.apply()
        figure, table, caption = draw(results)
        saved = as_csv(table, inherited(results) | units)
    except (FormatError, OSError, UnitsError) as error:
        sys.exit(str(error))
    parents = Parents.of(str(script.relative_to(ROOT)), options.output, options.configuration, results)
    name = title if isinstance(title, str) else title(results)
    save(figure, saved, options.output, Text(name, " ".join(caption.split())), parents)
