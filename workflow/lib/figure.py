"""Entry point of the figure scripts: loads the results, renders and saves a panel.

A script defines draw(results) and ends with `main(draw, title)`. A title that differs between panels is a function of the results.
Units of columns that are not named after a quantity, an axis or an option are keyword arguments, which also hold for the columns of
their errors: `main(draw, title, deviation="1")`.
"""

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import with_rules
from workflow.lib.columns import as_csv, inherited
from workflow.lib.identity import ROOT, named_identity, panel_identity, sources_of_panel
from workflow.lib.load import REMEDY, FormatError, Result, load
from workflow.lib.save import Parents, Text, save
from workflow.lib.units import UnitsError

Drawn = tuple[
    Figure, pd.DataFrame, str
]  # figure, table of the plotted numbers, caption as one paragraph of plain text

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


def main(draw: Draw, title: str | Callable[[Sequence[Result]], str], **units: str) -> None:
    """Renders the panel that the command line names."""
    parser = argparse.ArgumentParser(description="Renders a panel from its results.")
    parser.add_argument("--data", type=Path, nargs="*", default=[], help="result files of the panel")
    parser.add_argument("--output", type=Path, required=True, help="FOLDER/QUALITY/PANEL, without suffix")
    options = parser.parse_args()
    script = Path(sys.argv[0]).resolve()
    if script.parent != ROOT / "workflow/figures":
        sys.exit(f"{script} is not in {ROOT}/workflow/figures: move it there")
    if others := [name for name in sys.modules if name.startswith("workflow.figures.")]:
        sys.exit(
            f"{script.name} imports the script {others[0]}: move what they share to workflow/physics or workflow/lib"
        )
    sources = sources_of_panel(script.stem)
    panel = options.output.name.partition(".")[0]
    name = panel_identity(panel, map(str, options.data), sources)
    if named_identity(options.output) not in (name, ""):
        sys.exit(
            f"{script.name}, workflow/lib, workflow/physics or uv.lock was edited meanwhile: repeat the command"
        )
    try:
        results = read(options.data, set_aside=bool(named_identity(options.output)))
        style.apply()
        figure, table, caption = draw(results)
        errors = {f"{column}_error": text for column, text in units.items()}
        saved = as_csv(table, inherited(results) | errors | units)
    except (FormatError, OSError, TheoryError, UnitsError) as error:
        sys.exit(str(error))
    own = [result for result in results if result.path.parent.name == panel] or results
    text = Text(
        title if isinstance(title, str) else title(results), with_rules(" ".join(caption.split()), own)
    )
    save(figure, saved, options.output, text, Parents(name, options.data, sources))


def read(paths: Sequence[Path], set_aside: bool) -> list[Result]:
    """Loads results. Raises FormatError for all that are refused. set_aside: also renames these, so that the same command makes them
    again."""
    results, refused = [], []
    for path in paths:
        try:
            results.append(load(path))
        except FormatError as error:
            refused.append(str(error))
            if set_aside and path.exists():
                path.rename(f"{path}.refused")
                refused[-1] = (
                    f"{refused[-1].removesuffix(REMEDY)}; renamed to {path.name}.refused: the same command makes it again"
                )
    if refused:
        raise FormatError("\n".join(refused))
    return results
