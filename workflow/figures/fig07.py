"""Fig. 7: spreading of a tagged particle at sigma = 1/2, with the paper's random total momentum and with zero
total momentum.

The mean square displacement of the centre of mass is the part due to drift.
"""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.caption import ERRORS, parameters
from workflow.lib.figure import Parts, plots
from workflow.lib.fit import format_with_error
from workflow.lib.load import Result
from workflow.physics.paper import PAPER

TITLE = "Mean square displacement of a tagged particle"
UNITS = {"fraction": "1", "slope_to_next": "1"}

GUIDED = 100  # last time over the first time of the guides
APART = 3  # factor between a guide and the last point

LOOKS = {False: style.points("o", style.BLUE), True: style.points("s", style.VERMILLION, "white")}


def zero(result: Result) -> bool:
    return bool(result.parameters["zero_total_momentum"])


def tabulate(result: Result) -> pd.DataFrame:
    """One row per time. The error of the fraction neglects the correlation of drift and variance: it is an
    upper bound."""
    variance, drift, slope = result["variance"], result["centre_of_mass_variance"], result["local_slope"]
    columns = result.columns("variance", "centre_of_mass_variance")
    run = {"cells": int(result.parameters["cells"]), "zero_total_momentum": zero(result)}
    table = pd.DataFrame({"time": variance.axes["time"], **run, **columns})
    table["fraction"] = drift.mean / variance.mean
    relative = np.hypot(drift.error / drift.mean, variance.error / variance.mean)
    table["fraction_error"] = table["fraction"] * relative
    table["slope_to_next"], table["slope_to_next_error"] = (
        np.append(values, np.nan) for values in (slope.mean, slope.error)
    )
    return table


def caption(random: pd.DataFrame, results: Sequence[Result]) -> str:
    last, paper = random.iloc[-1], results[0]
    without = next(style.format_quantity(result["alpha"]) for result in results if zero(result))
    return f"""
        The paper finds ⟨x²⟩ ∼ t^α with α slightly below 2. Here ({parameters([paper], "cells", "sigma", "particles_per_cell", "temperature", paper=PAPER["fig07"])}) α, fitted
        in the shaded window, is {style.format_quantity(paper["alpha"])}, and {without} with zero total momentum. (a) Lines show the drift of the centre of mass, in the end
        {format_with_error(100 * last.fraction, 100 * last.fraction_error)} % of ⟨x²⟩. (b) Exponents are local. {ERRORS}"""


@plots("all zero-momentum", varying="zero_total_momentum")
def draw(results: Sequence[Result]) -> Parts:
    results = sorted(results, key=zero)
    tables = [tabulate(result) for result in results]
    random = tables[0]
    time = random.time
    last = float(time.iloc[-1])
    window = (last / 10 ** results[0].parameters["fit_decades"], last)
    figure, (above, below) = style.stacked(2, 1, height=1.8)
    for result, table in zip(results, tables, strict=True):
        look = LOOKS[zero(result)]
        name = ("zero" if zero(result) else "random") + " total momentum"
        above.errorbar(table.time, table.variance, table.variance_error, label=name, **look)
        middle = np.sqrt(table.time * table.time.shift(-1))
        below.errorbar(middle, table.slope_to_next, table.slope_to_next_error, **look)
        if not zero(result):
            label = "centre of mass, random"
            drift, error = table.centre_of_mass_variance, table.centre_of_mass_variance_error
            above.plot(table.time, drift, color=look["color"], zorder=1, label=label)
            style.band(above, table.time, drift, error, look["color"])
    late = time[time > last / GUIDED]
    for table, power, factor in ((random, 2, APART), (tables[-1], 1, 1 / APART)):
        guide = factor * table.variance.iloc[-1] * (late / last) ** power
        above.plot(late, guide, **style.GUIDE)
        name, lift = ("$t^2$", (-18, -2)) if power == 2 else ("$t$", (-8, -14))
        style.name_point(above, name, (last, guide.iloc[-1]), lift, ha="right")
    for value in (1, 2):
        below.axhline(value, **style.GUIDE)
    for axes in (above, below):
        axes.axvspan(*window, **style.WINDOW)
    above.set(xscale="log", yscale="log", ylabel=r"$\langle x^2\rangle$")
    below.set(xlabel=f"time $t$ ({style.UNIT_SYSTEM})", ylabel=r"$d\ln\langle x^2\rangle/d\ln t$")
    title = f"${parameters(results, 'cells')}$, ${parameters(results, 'sigma')}$"
    figure.legend(
        *above.get_legend_handles_labels(), loc="outside upper left", ncols=2, title=title, alignment="left"
    )
    return figure, pd.concat(tables), caption(random, results)
