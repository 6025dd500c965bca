"""Ext. 5: rates and currents along an open chain, and the accumulation of particles at its ends."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, WINDOW, baths, listed, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import fit_line, with_error
from workflow.lib.load import Result

FITTED = 20  # cells of the smallest chain in the fit of the excess

# Markers by quantity. Files have the deviation of a rate from a straight line, and of a current from its mean over the bonds, each with
# its own error.
SIDES = {"rate_right": ">", "rate_left": "<"}
CURRENTS = {"particle_current": "o", "energy_current": "s"}


def look_of(result: Result, marker: str, index: int) -> style.Look:
    """Style of the symbols: large at gamma = N, small at gamma = 1, open for the second of two curves."""
    gamma = result.parameters["gamma"]
    face, size = "white" if index else None, 4 if gamma == "N" else 2
    return style.points(marker, style.BY_GAMMA[gamma][1], face, markersize=size, capsize=0)


def plot_deviations(axes: Axes, result: Result, curves: dict[str, str]) -> list[pd.DataFrame]:
    """Plots the deviations of quantities in percent of their means. Returns one table per quantity."""
    tables = []
    cells = int(result.parameters["cells"])
    for index, (name, marker) in enumerate(curves.items()):
        whole, deviation = result[name], result[f"{name}_deviation"]
        (axis,) = whole.axes
        x = (whole.axes[axis] + (0.5 if axis == "cell" else 0)) / cells
        scale = 100 / np.abs(whole.mean).mean()
        look = look_of(result, marker, index)
        percent, error = scale * deviation.mean, scale * deviation.error
        inside = (x > 0) & (x < 1)
        axes.errorbar(x[inside], percent[inside], error[inside], **look)
        table = pd.DataFrame({"quantity": name, "x": x, "value": whole.mean, "error": whole.error})
        table["deviation_percent"], table["deviation_percent_error"] = percent, error
        tables.append(table.assign(units=whole.units, gamma=style.gamma(result), cells=cells))
    return tables


def plot_rates(axes: Axes, result: Result) -> None:
    """Plots both rates, with the fitted straight lines."""
    for index, (name, marker) in enumerate(SIDES.items()):
        rate, deviation = result[name], result[f"{name}_deviation"]
        x = (rate.axes["cell"] + 0.5) / int(result.parameters["cells"])
        look = look_of(result, marker, index)
        axes.errorbar(x, rate.mean, rate.error, **look)
        axes.plot(x, rate.mean - deviation.mean, color=look["color"], linewidth=0.6, zorder=1)


def plot_excess(axes: Axes, results: Sequence[Result]) -> pd.DataFrame:
    """Plots the excess density of both end cells against the size, with a + b ln N fitted to the longer chains. Returns the table."""
    cells = np.array([int(result.parameters["cells"]) for result in results])
    tables = []
    for end, (name, marker, color, dashes) in enumerate(
        (("left", "v", style.BLACK, "solid"), ("right", "D", style.GREEN, "dashed"))
    ):
        excess = np.array([result["density_excess"].mean[end] for result in results])
        error = np.array([result["density_excess"].error[end] for result in results])
        fitted = cells >= FITTED
        line = fit_line(np.log(cells[fitted]), excess[fitted], error[fitted])
        look = style.points(marker, color, "white", label=f"{name} end")
        axes.errorbar(cells, excess, error, **look)
        axes.plot(cells[fitted], line.at(np.log(cells[fitted])), color=color, linestyle=dashes)
        table = pd.DataFrame({"quantity": f"density_excess {name}", "cells": cells, "value": excess})
        table["fitted"] = np.where(fitted, line.at(np.log(cells)), np.nan)
        table["slope"], table["slope_error"], table["chi_square"] = line.slope, line.error, line.chi_square
        tables.append(table.assign(error=error, units="1", gamma=style.gamma(results[0])))
    return pd.concat(tables)


def caption(table: pd.DataFrame, profiles: Sequence[Result], sizes: Sequence[Result]) -> str:
    ends = table[table.quantity.str.startswith("density_excess")].drop_duplicates("quantity")
    slopes = listed(with_error(row.slope, row.slope_error) for row in ends.itertuples())
    largest = []
    for result in profiles:
        rows = table[(table.gamma == style.gamma(result)) & table.quantity.isin(SIDES)]
        far = rows.loc[rows.deviation_percent.abs().idxmax()]
        text = with_error(far.deviation_percent, far.deviation_percent_error)
        largest.append(f"{text} % at γ = {style.gamma(result)}")
    return f"""
        Open chain, {parameters(profiles, "sigma", "cell-length")}, {baths(profiles[0])}, {parameters(profiles, *WINDOW)},
        {replicas([*profiles, *sizes])}; (a)–(c) {parameters(profiles, "cells")}. (a) Arrivals at a scatterer per unit time; (b) over straight
        lines, minus one; (c) both currents over their mean, inside; that of particles falls, as they accumulate.
        The paper has linear rates; deviations: up to {listed(largest)}. (d) Excess density of the end cells at γ = 1; lines: a + b ln N from N = {FITTED} on,
        b = {slopes}, as in the paper. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    profiles = [result for result in results if result.parameters["cells"] == 30]
    sizes = [result for result in results if style.gamma(result) == "1"]
    sizes.sort(key=lambda result: result.parameters["cells"])
    figure, panels = plt.subplots(2, 2, figsize=(2 * style.COLUMN, 1.7 * style.HEIGHT))
    raw, rates, currents, excess = panels.flat
    tables = []
    for result in profiles:
        plot_rates(raw, result)
        tables += plot_deviations(rates, result, SIDES)
        tables += plot_deviations(currents, result, CURRENTS)
    tables.append(plot_excess(excess, sizes))
    table = pd.concat(tables).reset_index(drop=True)
    raw.set(xlabel="$x$", ylabel=f"rate at a scatterer ({style.UNITS})")
    rates.set(xlabel="$x$", ylabel="rate over line, minus 1 / %")
    currents.set(xlabel="$x$", ylabel="current over mean, minus 1 / %")
    excess.set(xscale="log", xlabel="number of cells $N$", ylabel="excess density of an end cell")
    excess.legend(loc="upper left", title=r"$\gamma = 1$")
    excess.set_ylim(bottom=0)
    for axes in (rates, currents):
        axes.axhline(0, **style.GUIDE)
    for name, index in (("to the right", 0), ("to the left", 1)):
        raw.errorbar([], [], [], **look_of(profiles[0], "><"[index], index), label=name)
    for name, index in (("particles", 0), ("energy", 1)):
        currents.errorbar([], [], [], **look_of(profiles[0], "os"[index], index), label=name)
    for result in profiles:
        rates.errorbar([], [], [], **look_of(result, "o", 0), label=rf"$\gamma = {style.gamma(result)}$")
    for axes in (raw, rates, currents):
        axes.legend(loc="upper right", handletextpad=0.2)
    style.letter(*panels.flat)
    return figure, table, caption(table, profiles, sizes)


if __name__ == "__main__":
    by_row = {"value": "column units", "error": "column units"}
    pure = dict.fromkeys(("x", "deviation_percent", "fitted", "slope", "chi_square"), "1")
    run(draw, "Rates, currents and density along the chain", **pure, **by_row)
