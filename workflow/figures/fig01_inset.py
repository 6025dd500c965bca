"""Fig. 1, inset: number of particles inside against the logarithm of time.

Below, its slope dn/d ln t, which is the height of |p| n_t(p) above the front where the chain has filled.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.figures.fig01 import by_spacing
from workflow.lib import style
from workflow.lib.caption import BATHS, ERRORS, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.load import Result

SURE = 3  # standard errors of a curvature that is not chance


def fitted(result: Result) -> pd.DataFrame:
    """Numbers and slopes at the times of the file; from the first of --times on the fitted straight line."""
    count, slope = result["total_number"], result["number_slope"]
    time = count.axes["time"]
    late = time >= result["plateau"].axes["time"][0] * (1 - 1e-9)
    x = np.log(time)
    line = count.mean[late].mean() + float(result["log_slope"].mean) * (x - x[late].mean())
    table = pd.DataFrame({"time": time, "number": count.mean, "number_error": count.error})
    table["number_fitted"] = np.where(late, line, np.nan)
    table["slope_to_next"], table["slope_to_next_error"] = (
        np.append(values, np.nan) for values in (slope.mean, slope.error)
    )
    table.insert(0, "cell_length", style.spacing(result)[0])
    return table


def straight(result: Result) -> bool:
    curvature = result["log_curvature"]
    return not abs(float(curvature.mean)) > SURE * float(curvature.error)


def draw_number(axes: Axes, table: pd.DataFrame, result: Result) -> None:
    axes.errorbar(
        table.time,
        table.number,
        table.number_error,
        marker="o",
        color=style.BLUE,
        **style.POINTS,
        label="$n(t)$",
    )
    dashes = "solid" if straight(result) else "dotted"
    label = r"$a + b\,\ln t$" + ("" if straight(result) else ", rejected")
    axes.plot(table.time, table.number_fitted, color=style.BLACK, linestyle=dashes, zorder=3, label=label)
    axes.set(xscale="log", ylabel="particles inside $n(t)$", ylim=(0, None))
    title = rf"$\lambda = {style.spacing(result)[1]}$"
    axes.legend(
        title=title, alignment="left", loc="lower right" if table.cell_length.iloc[0] < 1 else "upper left"
    )


def draw_slopes(axes: Axes, table: pd.DataFrame, result: Result) -> None:
    between = np.sqrt(table.time * table.time.shift(-1))
    axes.errorbar(
        between,
        table.slope_to_next,
        table.slope_to_next_error,
        marker="o",
        color=style.BLUE,
        label="slope of $n(t)$",
        **style.POINTS,
    )
    plateau = result["plateau"]
    look = {
        "marker": "s",
        "color": style.VERMILLION,
        "markerfacecolor": "white",
        "label": r"$|p|\,[n_t(p) + n_t(-p)]$",
        **style.POINTS,
    }
    axes.errorbar(plateau.axes["time"], plateau.mean, plateau.error, **look)
    axes.set(xlabel=f"time $t$ ({style.UNITS})", ylabel=r"$dn/d\ln t$")


def caption(results: Sequence[Result]) -> str:
    said = []
    for result in results:
        slope, curvature, height = (
            style.with_error(result["log_slope"]),
            style.with_error(result["log_curvature"]),
            style.with_error(result["plateau"], -1),
        )
        verdict = "no curvature is resolved" if straight(result) else "not straight"
        said.append(
            f"at λ = {style.spacing(result)[1]} slope {slope}, whose change with ln t is {curvature}, so {verdict}, and "
            f"height {height}"
        )
    first, last = results[0]["plateau"].axes["time"][[0, -1]]
    return f"""
        Number n(t) of particles in a chain that starts empty, against the logarithm of time, at the distances λ between
        scatterers of fig. 1; {parameters(results, "cells", "sigma", "gamma", *BATHS)}, {replicas(results)}. Above n(t)
        with the straight line fitted in the shaded window from t = {first:g} to {last:g}, dotted where n is not straight in ln t there;
        below its slope dn/d ln t from each time to the next (circles), and the height of |p| [n_t(p) + n_t(−p)] above the front
        (squares), which it should be once the chain has filled. {ERRORS}. Fits: {"; ".join(said)}. The paper states logarithmic
        growth; where the line is not straight the chain still fills, and the fitted slope is no property of the gas. What n does before
        the window, a bend or a fall, belongs to the start from an empty chain with scatterers at rest, and is not fitted."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    figure, rows = plt.subplots(
        2,
        len(results),
        sharex="col",
        figsize=(3 * style.COLUMN, 1.5 * style.HEIGHT),
        height_ratios=[2, 1],
    )
    results = by_spacing(results)
    tables = [fitted(result) for result in results]
    for (above, below), result, table in zip(rows.T, results, tables, strict=True):
        draw_number(above, table, result)
        draw_slopes(below, table, result)
        for axes in (above, below):
            axes.axvspan(*result["plateau"].axes["time"][[0, -1]], **style.WINDOW)
    rows[1, 0].legend(loc="lower right", handletextpad=0.2)
    style.letter(*rows.flat)
    return figure, pd.concat(tables), caption(results)


if __name__ == "__main__":
    names = ("number", "number_error", "number_fitted", "slope_to_next", "slope_to_next_error")
    run(draw, "Number of particles in an open chain", **dict.fromkeys(names, "1"))
