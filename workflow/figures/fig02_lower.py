"""Fig. 2, lower panel: particles per cell, averaged over the stated window; below, divided by a straight
line through the bulk."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, plots
from workflow.lib.load import Result
from workflow.lib.text import format_quantity, listed
from workflow.physics import run_parameters

TITLE = "Density profiles"
UNITS = dict.fromkeys(("x", "bulk", "relative"), "1")


def tabulate(result: Result) -> pd.DataFrame:
    """One row per cell, with the line through the middle half and the density relative to it."""
    density = result["density"]
    table = pd.DataFrame({"x": (density.axes["cell"] + 0.5) / len(density.mean)})
    table["density"], table["density_error"] = density.mean, density.error
    bulk = table.iloc[len(table) // 4 : len(table) - len(table) // 4]  # as in density_excess, without weights
    table["bulk"] = np.polyval(np.polyfit(bulk.x, bulk.density, 1), table.x)
    table["relative"] = table.density / table.bulk
    table["relative_error"] = table.density_error / table.bulk
    table.insert(0, "gamma", run_parameters.gamma(result))
    return table


def caption(results: Sequence[Result]) -> str:
    excess = []
    for result in results:
        ends = [f"{format_quantity(result['density_excess'], end, 100)} %" for end in (0, 1)]
        excess.append(f"{listed(ends)} at γ = {run_parameters.gamma(result)}")
    text = """The paper finds that particles accumulate at the ends of the chain, more at γ = 1. (a)
        Particles per cell, with lines through the bulk (shaded). (b) The density over these lines: the first
        and the last cell exceed them by {excess}. Bars: without the error of the line."""
    return fill(text, excess=", ".join(excess))


@plots("deterministic rare")
def draw(results: Sequence[Result]) -> Parts:
    figure, (above, below) = style.stacked(1.7, 1, height=1.5, width=1.1)
    tables = [tabulate(result) for result in results]
    looks = style.by_gamma(map(run_parameters.gamma, results))
    for result, table in zip(results, tables, strict=True):
        look = style.points(*looks[run_parameters.gamma(result)], "white")
        label = rf"$\gamma = {run_parameters.gamma(result)}$"
        above.errorbar(table.x, table.density, table.density_error, **look, label=label)
        above.plot(table.x, table.bulk, color=look["color"], linewidth=0.6, zorder=1)
        below.errorbar(table.x, table["relative"], table.relative_error, **look)
    below.axhline(1, **style.GUIDE)
    for axes in (above, below):
        axes.axvspan(0.25, 0.75, **style.WINDOW)
    above.set(ylabel=r"particles per cell, $\rho(x)$", xlim=(0, 1))
    below.set(xlabel="position $x$", ylabel=r"$\rho$ / bulk line")
    above.legend(loc="upper right")
    return figure, pd.concat(tables), caption(results)
