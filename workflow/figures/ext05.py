"""Ext. 5: rates and currents along an open chain, and the accumulation of particles at its ends."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import BATHS, ERRORS, WINDOW, listed, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import LEVEL, fit_line, p_value, with_error
from workflow.lib.load import Result

FITTED = 20  # cells of the smallest chain in the fit of the excess

# Deviation of a quantity from a straight line or from the mean over the bonds, with an error of its own.
SIDES = {"rate_right": ">", "rate_left": "<"}
CURRENTS = {"particle_current": "o", "energy_current": "s"}


def look_of(result: Result, marker: str, index: int) -> style.Look:
    """Large at gamma = N, small at gamma = 1; the second of two curves is open."""
    gamma = result.parameters["gamma"]
    _, color = style.BY_GAMMA[gamma]
    face = "white" if index else color
    size = 4 if gamma == "N" else 2
    return {"marker": marker, "color": color, "markerfacecolor": face, "markersize": size, **style.POINTS}


def plot_deviations(axes: Axes, result: Result, curves: dict[str, str]) -> list[pd.DataFrame]:
    """In percent of the mean."""
    tables = []
    cells = int(result.parameters["cells"])
    for index, (name, marker) in enumerate(curves.items()):
        whole, deviation = result[name], result[f"{name}_deviation"]
        (axis,) = whole.axes
        x = (whole.axes[axis] + (0.5 if axis == "cell" else 0)) / cells
        scale = 100 / np.abs(whole.mean).mean()
        look = look_of(result, marker, index)
        label = rf"{name.replace('_', ' ')}, $\gamma = {style.gamma(result)}$"
        percent, error = scale * deviation.mean, scale * deviation.error
        inside = (x > 0) & (x < 1)
        axes.errorbar(x[inside], percent[inside], error[inside], label=label, **look)
        table = pd.DataFrame({"quantity": name, "x": x, "value": whole.mean, "error": whole.error})
        table["deviation_percent"], table["deviation_percent_error"] = percent, error
        tables.append(table.assign(units=whole.units, gamma=style.gamma(result), cells=cells))
    return tables


def plot_rates(axes: Axes, result: Result) -> None:
    """As they are, with the straight line that the deviations are from."""
    for index, (name, marker) in enumerate(SIDES.items()):
        rate, deviation = result[name], result[f"{name}_deviation"]
        x = (rate.axes["cell"] + 0.5) / int(result.parameters["cells"])
        look = look_of(result, marker, index)
        axes.errorbar(x, rate.mean, rate.error, **look)
        axes.plot(x, rate.mean - deviation.mean, color=look["color"], linewidth=0.6, zorder=1)


def plot_excess(axes: Axes, results: Sequence[Result]) -> pd.DataFrame:
    """Excess density of both end cells against the size, with a + b ln N through the longer chains."""
    cells = np.array([int(result.parameters["cells"]) for result in results])
    tables = []
    for end, (name, marker, color, dashes) in enumerate(
        (("left", "v", style.BLACK, "solid"), ("right", "D", style.GREEN, "dashed"))
    ):
        excess = np.array([result["density_excess"].mean[end] for result in results])
        error = np.array([result["density_excess"].error[end] for result in results])
        fitted = cells >= FITTED
        line = fit_line(np.log(cells[fitted]), excess[fitted], error[fitted])
        look = {"marker": marker, "color": color, "markerfacecolor": "white", **style.POINTS}
        axes.errorbar(cells, excess, error, label=f"{name} end", **look)
        axes.plot(cells[fitted], line.at(np.log(cells[fitted])), color=color, linestyle=dashes)
        table = pd.DataFrame({"quantity": f"density_excess {name}", "cells": cells, "value": excess})
        table["fitted"] = np.where(fitted, line.at(np.log(cells)), np.nan)
        table["slope"], table["slope_error"], table["chi_square"] = line.slope, line.error, line.chi_square
        tables.append(table.assign(error=error, units="1", gamma=style.gamma(results[0])))
    return pd.concat(tables)


def caption(table: pd.DataFrame, profiles: Sequence[Result], sizes: Sequence[Result]) -> str:
    said = []
    for row in table.dropna(subset="slope").drop_duplicates("quantity").itertuples():
        freedom = int((table.quantity == row.quantity)[table.fitted.notna()].sum()) - 2
        said.append(
            f"{row.quantity.split()[-1]} {with_error(row.slope, row.slope_error)} per unit of ln N "
            f"(χ² = {row.chi_square:.1f} for {freedom} degrees of freedom)"
        )
    bent = []
    for result in profiles:
        rows = table[(table.gamma == style.gamma(result)) & table.quantity.isin(SIDES)]
        far = rows.loc[rows.deviation_percent.abs().idxmax()]
        value, error = far.deviation_percent, far.deviation_percent_error
        unresolved = len(rows) * p_value((value / error) ** 2, 1) > LEVEL  # by Bonferroni
        remark = ", which chance explains" if unresolved else ""
        bent.append(f"{with_error(value, error)} % at γ = {style.gamma(result)}{remark}")
    return f"""
        Rates, currents and accumulation in an open chain, {parameters(profiles, "sigma", "cell-length", *BATHS, *WINDOW)},
        {replicas([*profiles, *sizes])}; (a) to (c) {parameters(profiles, "cells")}, large symbols at γ = N and small ones at γ = 1. (a) Arrivals at a scatterer per unit
        time, to the right (full) and to the left (open), with straight lines through them; (b) the same minus the lines, in per cent, whose
        errors are those of the deviations; (c) currents of particles (circles) and energy (squares) minus their mean over all
        bonds, in per cent of it (a current of particles that falls along the chain leaves some there, as the content still grows), without the openings of the chain, where particles are injected, which have far larger errors and are in the table only:
        what is shown need not vanish on average. (d) Density of an end cell over a line
        through the bulk, minus one, at γ = 1 against N, with lines fitted from {FITTED} cells on: {"; ".join(said)}. {ERRORS}. The
        paper states linear rates and uniform currents: the rates deviate by at most {listed(bent)}; and an accumulation that turns singular
        as N grows."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    profiles = [result for result in results if result.parameters["cells"] == 30]
    sizes = [result for result in results if style.gamma(result) == "1"]
    sizes.sort(key=lambda result: result.parameters["cells"])
    figure, panels = plt.subplots(2, 2, figsize=(2 * style.COLUMN, 1.9 * style.HEIGHT))
    raw, rates, currents, excess = panels.flat
    tables = []
    for result in profiles:
        plot_rates(raw, result)
        tables += plot_deviations(rates, result, SIDES)
        tables += plot_deviations(currents, result, CURRENTS)
    tables.append(plot_excess(excess, sizes))
    table = pd.concat(tables)
    raw.set(xlabel="$x$", ylabel=f"rate at a scatterer ({style.UNITS})")
    rates.set(xlabel="$x$", ylabel="rates minus lines / %")
    currents.set(xlabel="$x$", ylabel="currents minus mean / %")
    excess.set(xscale="log", xlabel="number of cells $N$", ylabel="excess density of an end cell")
    excess.legend(loc="upper left", title=r"$\gamma = 1$")
    excess.set_ylim(bottom=0)
    for axes in (rates, currents):
        axes.axhline(0, **style.GUIDE)
    (points, names), (more, others) = (axes.get_legend_handles_labels() for axes in (rates, currents))
    figure.legend([*points, *more], [*names, *others], loc="outside upper center", ncols=4)
    style.letter(*panels.flat)
    table = table.reset_index(drop=True)
    return figure, table, caption(table, profiles, sizes)


if __name__ == "__main__":
    by_row = {"value": "column units", "error": "column units"}
    run(
        draw,
        "Rates, currents and density along the chain",
        x="1",
        deviation_percent="1",
        deviation_percent_error="1",
        fitted="1",
        slope="1",
        slope_error="1",
        chi_square="1",
        **by_row,
    )
