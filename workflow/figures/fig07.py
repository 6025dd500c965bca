"""Fig. 7: spreading of a tagged particle at sigma = 1/2, with random total momentum, also in a
longer ring, and with zero total momentum.

The mean square displacement of the centre of mass is the part due to drift.
"""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.lines import Line2D

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, plots
from workflow.lib.load import Result
from workflow.lib.text import format_quantity

TITLE = "Mean square displacement of a tagged particle"
UNITS = {"fraction": "1", "slope_to_next": "1"}

GUIDED = 100  # last time over the first time of the guides
APART = 3  # factor between a guide and the last point

LOOKS = [  # the paper's ring and longer ones
    style.points("o", style.BLUE),
    style.points("^", style.GREEN),
    style.points("D", style.ORANGE),
]
ZERO = style.points("s", style.VERMILLION, "white")


def zero(result: Result) -> bool:
    return bool(result.parameters["zero_total_momentum"])


def tabulate(result: Result) -> pd.DataFrame:
    """One row per time. The error of the fraction neglects the correlation of both mean squares: it is an
    upper bound."""
    square, drift, slope = (
        result["mean_square_displacement"],
        result["mean_square_drift"],
        result["local_slope"],
    )
    columns = result.columns("mean_square_displacement", "mean_square_drift")
    run = {"cells": int(result.parameters["cells"]), "zero_total_momentum": zero(result)}
    table = pd.DataFrame({"time": square.axes["time"], **run, **columns})
    table["fraction"] = drift.mean / square.mean
    relative = np.hypot(drift.error / drift.mean, square.error / square.mean)
    table["fraction_error"] = table["fraction"] * relative
    table["slope_to_next"], table["slope_to_next_error"] = (
        np.append(values, np.nan) for values in (slope.mean, slope.error)
    )
    return table


def caption(results: Sequence[Result]) -> str:
    without = [format_quantity(result["alpha"]) for result in results if zero(result)]
    text = """The paper finds ⟨x²⟩ ∼ t^α with α slightly below 2 for a tagged particle. Here α is {alpha}
        at N = {cells} in the shaded window. At zero total momentum it is {without}. Lines: mean square
        displacement of the centre of mass, by which the ring drifts. (b) Local exponents. Dashed guides
        are not fits."""
    numbers = {"alpha": format_quantity(results[0]["alpha"]), "cells": str(results[0].parameters["cells"])}
    return fill(text, without=without[0] if without else None, **numbers)


@plots("all zero-momentum large", varied="cells")
def draw(results: Sequence[Result]) -> Parts:
    results = sorted(results, key=lambda result: (zero(result), result.parameters["cells"]))
    tables = [tabulate(result) for result in results]
    random = tables[0]
    time = random.time
    last = float(time.iloc[-1])
    window = (last / 10 ** results[0].parameters["fit_decades"], last)
    figure, (above, below) = style.stacked(2, 1, height=1.8)
    for k, (result, table) in enumerate(zip(results, tables, strict=True)):
        look = ZERO if zero(result) else LOOKS[k % len(LOOKS)]
        name = f"$N = {table.cells.iloc[0]}${', zero momentum' if zero(result) else ''}"
        square, error = table.mean_square_displacement, table.mean_square_displacement_error
        above.errorbar(table.time, square, error, label=name, **look)
        middle = np.sqrt(table.time * table.time.shift(-1))
        below.errorbar(middle, table.slope_to_next, table.slope_to_next_error, **look)
        if not zero(result):
            drift, error = table.mean_square_drift, table.mean_square_drift_error
            above.plot(table.time, drift, color=look["color"], zorder=1)
            style.band(above, table.time, drift, error, look["color"])
    late = time[time > last / GUIDED]
    for table, power, factor in ((random, 2, APART), (tables[-1], 1, 1 / APART)):
        guide = factor * table.mean_square_displacement.iloc[-1] * (late / last) ** power
        above.plot(late, guide, **style.GUIDE)
        name, lift = ("$t^2$", (-18, -2)) if power == 2 else ("$t$", (-8, -14))
        style.name_point(above, name, (last, guide.iloc[-1]), lift, ha="right")
    for value in (1, 2):
        below.axhline(value, **style.GUIDE)
    for axes in (above, below):
        axes.axvspan(*window, **style.WINDOW)
    above.set(xscale="log", yscale="log", ylabel=r"$\langle x^2\rangle$")
    below.set(xlabel=f"time $t$ ({style.UNIT_SYSTEM})", ylabel=r"$d\ln\langle x^2\rangle/d\ln t$")
    below.set_ylim(bottom=min(0.8, below.get_ylim()[0]))
    drift = Line2D([], [], color="grey", label="centre of mass")
    handles = [*above.get_legend_handles_labels()[0], drift]
    figure.legend(handles=handles, loc="outside upper left", ncols=2)
    return figure, pd.concat(tables), caption(results)
