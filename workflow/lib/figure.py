"""What the figure scripts share.

A script, FIGURE.py in workflow/figures, defines draw(results), and TITLE, or title(results) where it differs
between panels. `@plots` before draw names the plotted series. UNITS has the units of columns that are not
named after a quantity, an axis or an option; they also hold for the columns of their errors. Anything else is
in workflow/lib and workflow/physics, or named by `inputs` of the panel.
"""

import inspect
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from workflow.lib.caption import listed
from workflow.lib.load import Result

Parts = tuple[
    Figure, pd.DataFrame, str
]  # figure, table of the plotted numbers, caption as one paragraph of plain text

PHYSICS = (  # parameters of a model; others are effort, or times and bins
    *("cells", "sigma", "gamma", "cell_length", "particles_per_cell", "fugacity", "zero_total_momentum"),
    *("temperature", "scatterer_temperature", "energy", "pulse_energy", "rule"),
    *("nu_left", "nu_right", "temperature_left", "temperature_right"),
)

Draw = Callable[[Sequence[Result]], Parts]


@dataclass(frozen=True)
class Plot:
    """draw() of a script that plots series by their names. It names others of the panel in the caption and
    on stderr. varying: parameters that tell the curves and points apart; others have one value, or runs would
    be taken for one another, and theories for those of other parameters."""

    function: Draw
    series: tuple[str, ...]
    varying: frozenset[str]

    def shown(self, results: Iterable[Result]) -> list[Result]:
        """The results of these series; all if none of them is given, as by a panel of one's own with this
        script."""
        given = [*results]
        return [result for result in given if result.series in self.series] or given * bool(self.series)

    def __call__(self, results: Iterable[Result]) -> Parts:
        given = [*results]
        shown = self.shown(given)
        self.require_one_value(shown)
        figure, table, caption = self.function(shown)
        if len(shown) == len(given):
            return figure, table, caption
        own = [result.series for result in given if result.path.parent == given[-1].path.parent]
        if others := [name for name in dict.fromkeys(own) if name not in self.series]:
            caption = f"{caption} Not shown: {listed(others)}."
            script = Path(inspect.getfile(self.function)).name
            print(f"Not shown: {listed(others)}; to plot it, extend {script}", file=sys.stderr)
        return figure, table, caption

    def require_one_value(self, results: Sequence[Result]) -> None:
        """Raises TheoryError if a parameter that the script does not tell apart has several values."""
        for name in (name for name in PHYSICS if name not in self.varying):
            given = [result.parameters for result in results if name in result.parameters]
            values = {parameters[name] for parameters in given}
            if name == "cell_length" and not any(isinstance(value, str) for value in values):
                # One length of all chains is one value, too.
                lengths = {f"{one[name] * one['cells']:.9g}" for one in given}
                values = values if len(lengths) > 1 else set()
            if len(values) > 1:
                option, script = name.replace("_", "-"), Path(inspect.getfile(self.function)).name
                raise TheoryError(
                    f"{script} plots one {option}, and the runs have {listed(sorted(map(str, values)))}: make a panel of each"
                )


def plots(series: str, varying: str) -> Callable[[Draw], Plot]:
    """Decorator of draw(), which then takes the results of these series only. series: names, varying:
    parameters in which they may differ, both separated by blanks."""
    return lambda draw: Plot(draw, tuple(series.split()), frozenset(varying.split()))


class TheoryError(ValueError):
    """A theory does not hold for the results."""


class NoValueError(ValueError):
    """All values of a panel are undefined."""


def require_elastic(results: Sequence[Result], theory: str) -> None:
    """Raises TheoryError if a result has another collision rule than the paper's."""
    for result in results:
        if result.parameters.get("rule", "elastic") != "elastic":
            raise TheoryError(
                f"{theory} holds for elastic collisions only, and {result.path} has the rule {result.parameters['rule']}: leave it "
                "out of the panel"
            )
