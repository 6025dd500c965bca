"""What the figure scripts share.

A script, FIGURE.py in workflow/figures, defines TITLE, in which {gamma} is that of the panel's own runs, and
draw(results). `@plots` before draw names the
plotted series. UNITS has the units of columns that are not named after a quantity, an axis or an option; they
also hold for the columns of their errors. Anything else is in workflow/lib and workflow/physics, or named by
`inputs` of the panel. The renderer adds the parameters (physics/setting.py), unless the script has LABELLED =
True, as its labels have them.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from workflow.lib.load import Result
from workflow.lib.text import listed

# Figure, table of the plotted numbers, and caption, plain text.
Parts = tuple[Figure, pd.DataFrame, str]

Draw = Callable[[Sequence[Result]], Parts]


@dataclass(frozen=True)
class Plot:
    """draw() of a script that plots series by their names. The caption names others of the panel.
    varied: parameters that may differ between plotted runs, besides those of which the paper has several
    values."""

    function: Draw
    series: tuple[str, ...]
    varied: tuple[str, ...] = ()

    def shown(self, results: Iterable[Result]) -> list[Result]:
        """The results of these series; all if none of them is given, as by a panel of one's own with this
        script."""
        given = [*results]
        return [result for result in given if result.series in self.series] or (given if self.series else [])

    def not_shown(self, results: Sequence[Result]) -> list[str]:
        """The other series of the panel itself."""
        shown = {result.series for result in self.shown(results)}
        own = (result.series for result in results if result.path.parent == results[-1].path.parent)
        return [*dict.fromkeys(series for series in own if series not in shown)]

    def __call__(self, results: Iterable[Result]) -> Parts:
        return self.function(self.shown(results))


def plots(series: str, varied: str = "") -> Callable[[Draw], Plot]:
    """Decorator of draw(), which then takes the results of these series only. Names of series and of
    `varied` parameters are separated by blanks."""
    return lambda draw: Plot(draw, tuple(series.split()), tuple(varied.split()))


class TheoryError(ValueError):
    """A theory does not hold for the results."""


class NoValueError(ValueError):
    """All values of a panel are undefined."""


def holds(results: Iterable[Result], **values: Any) -> bool:
    """Whether a theory for elastic collisions, and for these values of other parameters, holds for all
    results. Where it does not, it is not drawn. values: one, or a tuple of several."""
    required = {"rule": "elastic"} | values
    return all(
        result.parameters[name] in (allowed if isinstance(allowed, tuple) else (allowed,))
        for result in results
        for name, allowed in required.items()
        if name in result.parameters
    )


def require(theory: str, results: Sequence[Result], **values: Any) -> None:
    """Raises TheoryError where a theory does not hold, with which all of the panel is compared."""
    for result in results:
        if not holds([result], **values):
            required = listed(f"{name} {value}" for name, value in ({"rule": "elastic"} | values).items())
            raise TheoryError(
                f"{theory} holds for {required} only, not for {result.path}: leave it out of the panel"
            )
