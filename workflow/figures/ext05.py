"""Ext. 5: rates and currents along an open chain, and the accumulation of particles at its ends."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.fit import fit_line, with_error
from workflow.lib.load import Result

# Deviation of a quantity from a straight line or from the mean over the bonds, with an error of its own.
SIDES = {"rate_right": ">", "rate_left": "<"}
CURRENTS = {"particle_current": "o", "energy_current": "s"}


def plot_deviations(axes: Axes, result: Result, curves: dict[str, str]) -> list[pd.DataFrame]:
    """In percent of the mean."""
    tables = []
    cells = int(result.parameters["cells"])
    color = style.BY_GAMMA[result.parameters["gamma"]][1]
    for index, (name, marker) in enumerate(curves.items()):
        whole, deviation = result[name], result[f"{name}_deviation"]
        (axis,) = whole.axes
        x = (whole.axes[axis] + (0.5 if axis == "cell" else 0)) / cells
        scale = 100 / np.abs(whole.mean).mean()
        look = {"marker": marker, "color": color, "markerfacecolor": "white" if index else color}
        label = rf"{name.replace('_', ' ')}, $\gamma = {style.gamma(result)}$"
        percent, error = scale * deviation.mean, scale * deviation.standard_error
        axes.errorbar(x, percent, error, label=label, **look, **style.POINTS)
        table = pd.DataFrame({"quantity": name, "x": x, "value": whole.mean, "error": whole.standard_error})
        table["deviation_percent"], table["deviation_percent_error"] = percent, error
        tables.append(table.assign(units=whole.units, gamma=style.gamma(result), cells=cells))
    return tables


def plot_excess(axes: Axes, results: Sequence[Result]) -> pd.DataFrame:
    """Excess density of both end cells against the size, with a + b ln N through the chains of 20 cells or more."""
    cells = np.array([int(result.parameters["cells"]) for result in results])
    tables = []
    for end, (name, marker, color) in enumerate(
        (("left", "o", style.BLUE), ("right", "s", style.VERMILLION))
    ):
        excess = np.array([result["density_excess"].mean[end] for result in results])
        error = np.array([result["density_excess"].standard_error[end] for result in results])
        fitted = cells >= 20
        line = fit_line(np.log(cells[fitted]), excess[fitted], error[fitted])
        label = (
            rf"{name}: slope {with_error(line.slope, line.error)} per $\ln N$, "
            rf"$\chi^2 = {line.chi_square:.1f}$ of {line.freedom}"
        )
        look = {"marker": marker, "color": color, "markerfacecolor": "white", **style.POINTS}
        axes.errorbar(cells, excess, error, label=label, **look)
        axes.plot(cells[fitted], line.at(np.log(cells[fitted])), color=color)
        table = pd.DataFrame({"quantity": f"density_excess {name}", "cells": cells, "value": excess})
        tables.append(table.assign(error=error, units="1", gamma=style.gamma(results[0])))
    return pd.concat(tables)


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    profiles = [result for result in results if result.parameters["cells"] == 30]
    sizes = [result for result in results if style.gamma(result) == "1"]
    sizes.sort(key=lambda result: result.parameters["cells"])
    figure, (rates, currents, excess) = plt.subplots(3, 1, figsize=(style.COLUMN, 2.6 * style.HEIGHT))
    tables = []
    for result in profiles:
        tables += plot_deviations(rates, result, SIDES)
        tables += plot_deviations(currents, result, CURRENTS)
    tables.append(plot_excess(excess, sizes))
    rates.set(xlabel="$x$", ylabel="rates minus line / %")
    currents.set(xlabel="$x$", ylabel="currents minus mean / %")
    excess.set(xscale="log", xlabel="number of cells $N$", ylabel="excess density of an end cell")
    excess.legend(loc="upper left", fontsize=7, title=r"$\gamma = 1$")
    low, high = excess.get_ylim()
    excess.set_ylim(min(0, low), high + 0.5 * (high - low))
    for axes in (rates, currents):
        axes.axhline(0, **style.GUIDE)
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.55 * (high - low))
        axes.legend(loc="upper center", ncols=2, fontsize=6.5)
    return figure, pd.concat(tables)


if __name__ == "__main__":
    by_row = {"value": "column units", "error": "column units"}
    run(
        draw,
        "Rates, currents and density along the chain",
        x="1",
        deviation_percent="1",
        deviation_percent_error="1",
        **by_row,
    )
