"""Fig. 1, inset: number of particles inside against the logarithm of time.

Below, its slope dn/d ln t, which is the height of |p| n_t(p) above the front where the chain has filled.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.figures.fig01 import JUDGED, by_spacing
from workflow.lib import style
from workflow.lib.caption import ERRORS, baths, number, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.load import Result

SURE = 3  # standard errors of a curvature that is not chance
NUMBER = style.points("o", style.BLUE)
HEIGHT = style.points("s", style.VERMILLION, "white", label=r"$|p|\,[n_t(p) + n_t(-p)]$")


def straight(result: Result) -> bool:
    curvature = result["log_curvature"]
    return not abs(float(curvature.mean)) > SURE * float(curvature.error)


def tabulate(result: Result) -> pd.DataFrame:
    """Numbers and slopes at the times of the file; where n is straight in ln t, the line fitted from the first of --times on."""
    count, slope = result["total_number"], result["number_slope"]
    time = count.axes["time"]
    late = time >= result["plateau"].axes["time"][0] * (1 - 1e-9)
    x = np.log(time)
    line = count.mean[late].mean() + float(result["log_slope"].mean) * (x - x[late].mean())
    table = pd.DataFrame({"time": time, "number": count.mean, "number_error": count.error})
    table["number_fitted"] = np.where(late & straight(result), line, np.nan)
    table["slope_to_next"], table["slope_to_next_error"] = (
        np.append(values, np.nan) for values in (slope.mean, slope.error)
    )
    table.insert(0, "cell_length", style.spacing(result)[0])
    return table


def draw_number(axes: Axes, table: pd.DataFrame, result: Result) -> None:
    axes.errorbar(table.time, table.number, table.number_error, **NUMBER, label="$n(t)$")
    if straight(result):
        axes.plot(table.time, table.number_fitted, color=style.BLACK, zorder=3, label=r"$a + b\,\ln t$")
    given = style.spacing(result)[1]
    title = rf"$\lambda = {given}$" + " (claims)" * (given == JUDGED)
    filled = table.cell_length.iloc[0] < 1
    axes.legend(title=title, alignment="left", loc="lower right" if filled else "upper left")
    axes.set(xscale="log", ylabel="particles inside $n(t)$", ylim=(0, None))


def draw_slopes(axes: Axes, table: pd.DataFrame, result: Result) -> None:
    between = np.sqrt(table.time * table.time.shift(-1))
    axes.errorbar(between, table.slope_to_next, table.slope_to_next_error, label="slope of $n(t)$", **NUMBER)
    plateau = result["plateau"]
    axes.errorbar(plateau.axes["time"], plateau.mean, plateau.error, **HEIGHT)
    axes.set(xlabel=f"time $t$ ({style.UNITS})", ylabel=r"$dn/d\ln t$")


def caption(results: Sequence[Result]) -> str:
    first, last = results[0]["plateau"].axes["time"][[0, -1]]
    (judged,) = (result for result in results if result.run == "unit-chain")
    slope, height = style.with_error(judged["log_slope"]), style.with_error(judged["plateau"], -1)
    return f"""
        Number n(t) of particles in a chain that is empty at t = 0; {parameters(results, "cells", "sigma", "gamma")},
        {baths(results[0])}, {replicas(results)}. Above: n(t); line: a + b ln t, fitted in the shaded window, t = {number(first)} to {number(last)},
        where no curvature is resolved. Below: slope dn/d ln t between neighbouring times (circles) and height of |p| n_t(p) above the front, both signs
        (squares). They agree in a filled chain, which that with the largest λ is not yet: at λ = {JUDGED}, slope {slope} and height {height} at the end,
        logarithmic growth as in the paper. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    size = (3 * style.COLUMN, 1.5 * style.HEIGHT)
    figure, rows = plt.subplots(2, len(results), sharex="col", figsize=size, height_ratios=[2, 1])
    results = by_spacing(results)
    tables = [tabulate(result) for result in results]
    for (above, below), result, table in zip(rows.T, results, tables, strict=True):
        draw_number(above, table, result)
        draw_slopes(below, table, result)
        for axes in (above, below) if straight(result) else ():
            axes.axvspan(*result["plateau"].axes["time"][[0, -1]], **style.WINDOW)
    rows[1, 0].legend(loc="lower right", handletextpad=0.2)
    style.letter(*rows.flat)
    return figure, pd.concat(tables), caption(results)


if __name__ == "__main__":
    run(draw, "Number of particles in a filling chain", number="1", number_fitted="1", slope_to_next="1")
