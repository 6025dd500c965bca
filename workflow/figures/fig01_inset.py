"""Fig. 1, inset: number of particles inside against the logarithm of time.

Below, its slope dn/d ln t, which is the height of |p| n_t(p) above the front once the chain is filled. At
early times the scatterers ahead of both fronts are at rest and few particles leave, so that n(t) grows
faster, until the fronts have crossed the chain.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, plots
from workflow.lib.fit import local_slopes
from workflow.lib.load import Result
from workflow.lib.text import format_quantity
from workflow.physics import run_parameters

TITLE = "Number of particles in a filling chain"
UNITS = {"slope": "1", "slope_time": "time", "number": "1", "number_fitted": "1"}

SURE = 3  # standard errors above which a curvature is significant
APART = 3  # number of time steps of a slope; slopes between neighbouring times would have large errors
NUMBER = style.points("o", style.BLUE)
HEIGHT = style.points("s", style.VERMILLION, "white", label=r"$|p|\,n_t(|p|)$")


def straight(result: Result) -> bool:
    """Whether n(t) has no significant curvature in ln t."""
    curvature = result["log_curvature"]
    return not abs(float(curvature.mean)) > SURE * float(curvature.error)


def tabulate(result: Result) -> pd.DataFrame:
    """One row per time: number, slope, and the line fitted from the first of --times on if n is straight
    in ln t."""
    count = result["total_number"]
    time = count.axes["time"]
    late = time >= result["plateau"].axes["time"][0] * (1 - 1e-9)
    x = np.log(time)
    line = count.mean[late].mean() + float(result["log_slope"].mean) * (x - x[late].mean())
    table = pd.DataFrame({"time": time, "number": count.mean, "number_error": count.error})
    table["number_fitted"] = np.where(late & straight(result), line, np.nan)
    table.insert(0, "cell_length", run_parameters.spacing(result)[0])
    return pd.concat([table, slopes(table)], axis=1)


def slopes(table: pd.DataFrame) -> pd.DataFrame:
    """dn/d ln t between times that are APART steps from each other, in the row of the earlier one. The
    errors assume independent numbers; they are upper bounds, as n(t) is positively correlated in time."""
    few = table.iloc[::-APART][::-1]
    middle, slope, error = local_slopes(np.log(few.time), few.number, few.number_error)
    local = pd.DataFrame({"slope": slope, "slope_error": error, "slope_time": np.exp(middle)}, few.index)
    return local.reindex(table.index)


def draw_number(axes: Axes, table: pd.DataFrame, result: Result) -> None:
    axes.errorbar(table.time, table.number, table.number_error, **NUMBER, label="$n(t)$")
    if straight(result):
        axes.plot(table.time, table.number_fitted, color=style.BLACK, zorder=3, label=r"$a + b\,\ln t$")
    title = rf"$\lambda = {run_parameters.spacing(result)[1]}$"
    filled = table.cell_length.iloc[0] < 1
    axes.legend(title=title, alignment="left", loc="lower right" if filled else "upper left")
    axes.set(xscale="log", ylabel="particles inside $n(t)$", ylim=(0, None))


def draw_slopes(axes: Axes, table: pd.DataFrame, result: Result) -> None:
    axes.errorbar(table.slope_time, table.slope, table.slope_error, label="slope of $n(t)$", **NUMBER)
    plateau = result["plateau"]
    axes.errorbar(plateau.axes["time"], plateau.mean, plateau.error, **HEIGHT)
    axes.set(xlabel=f"time $t$ ({style.UNIT_SYSTEM})", ylabel=r"$dn/d\ln t$")
    axes.set_ylim(bottom=min(0, axes.get_ylim()[0]))


def caption(chain: Result) -> str:
    text = """The paper finds that the number n(t) of particles in a filling chain grows as ln t. Shaded:
        times at which a line is fitted. At λ = {spacing} it has the slope {slope}. At λ = {spacing} n(t)
        is curved, d²n/d(ln t)² = {curvature}. Bottom: slope of n(t), and height of |p| n_t(|p|)
        (squares), {height} at last; both are equal in a filled chain."""
    slope = format_quantity(chain["log_slope"]) if straight(chain) else None
    curvature = None if slope else format_quantity(chain["log_curvature"])
    spacing, height = run_parameters.spacing(chain)[1], format_quantity(chain["plateau"], -1)
    return fill(text, spacing=spacing, slope=slope, curvature=curvature, height=height)


@plots("unit-spacing unit-chain", varied="cell_length")
def draw(results: Sequence[Result]) -> Parts:
    results = run_parameters.in_order_of_spacing(results)
    size = (len(results) * style.COLUMN, 1.5 * style.HEIGHT)
    figure, rows = plt.subplots(
        2, len(results), sharex="col", figsize=size, height_ratios=[2, 1], squeeze=False
    )
    tables = [tabulate(result) for result in results]
    for (above, below), result, table in zip(rows.T, results, tables, strict=True):
        draw_number(above, table, result)
        draw_slopes(below, table, result)
        for axes in (above, below) if straight(result) else ():
            axes.axvspan(*result["plateau"].axes["time"][[0, -1]], **style.WINDOW)
    rows[1, 0].legend(loc="lower right", handletextpad=0.2)
    style.letter(*rows.flat)
    return figure, pd.concat(tables), caption(results[0])
