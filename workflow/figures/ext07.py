"""Ext. 7: ageing. Energies against the logarithm of time; what moves with the relaxation time.

Of the quantities that depend on the relaxation time those are drawn whose trend is resolved; the table has all.
"""

from collections.abc import Callable, Sequence
from string import ascii_lowercase
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import CHAIN, ERRORS, GAS, goodness, listed, number, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import Line, fit_line, with_error
from workflow.lib.load import Result

RESOLVED = 3  # standard errors of a trend that is not chance

# Program, quantity, label, what it is for an infinite chain at equilibrium, and name.
AGED: list[tuple[str, str, str, Callable[[float], float], str]] = [
    ("persistence", "mu", r"persistence $\mu$", lambda sigma: np.arccos(sigma) / np.pi, "μ"),
    ("waiting_time", "exponent", r"exponent of $\Psi$", lambda _: -2, "the exponent of Ψ"),
    ("displacement", "alpha", r"exponent $\alpha$, zero total momentum", lambda _: 1, "α"),
]


def plot_energies(axes: Axes, result: Result) -> list[pd.DataFrame]:
    """Mean energies, of a scatterer over windows of time, of a particle at their ends."""
    tables = []
    looks = {
        "scatterer_energy_mean": ("o", style.BLUE, style.BLUE, "scatterer"),
        "particle_energy": ("s", style.VERMILLION, "white", "particle"),
    }
    for name, (marker, color, face, label) in looks.items():
        energy = result[name]
        (time,) = energy.axes.values()
        look = {"marker": marker, "color": color, "markerfacecolor": face, **style.POINTS}
        axes.errorbar(time, energy.mean, energy.error, label=label, **look)
        columns = {"quantity": name, "time": time, "value": energy.mean}
        tables.append(pd.DataFrame({**columns, "error": energy.error, "units": energy.units}))
    axes.set(xscale="log", ylabel=f"mean energy ({style.UNITS})", ylim=(0, None))
    axes.legend(loc="upper left")
    return tables


def plot_slopes(axes: Axes, result: Result, **look: Any) -> pd.DataFrame:
    """Of the scatterers' energy against ln t, by decade."""
    slope, contents = result["decade_slope"], result.parameters["particles-per-cell"]
    middle = slope.axes["decade"] * np.sqrt(10)
    axes.errorbar(middle, slope.mean, slope.error, label=f"$n = {contents}$", **look, **style.POINTS)
    axes.set(xlabel="time from the start", ylabel=r"$dE/d\ln t$ of a scatterer", ylim=(0, None))
    columns = {"quantity": f"decade_slope, n = {contents}", "time": slope.axes["decade"], "value": slope.mean}
    return pd.DataFrame({**columns, "error": slope.error, "units": slope.units})


def aged(results: Sequence[Result], program: str, name: str) -> tuple[pd.DataFrame, Line]:
    """A quantity by relaxation time, and its trend with the logarithm of it."""
    runs = [result for result in results if result.provenance["program"] == program]
    runs.sort(key=lambda result: result.parameters["relaxation-time"])
    time = [result.parameters["relaxation-time"] for result in runs]
    table = pd.DataFrame({"quantity": name, "time": time})
    table["value"] = [float(result[name].mean) for result in runs]
    table["error"] = [float(result[name].error) for result in runs]
    trend = fit_line(np.log(time), table["value"], table.error)
    return table.assign(units=runs[0][name].units, fitted=trend.at(np.log(time))), trend


def resolved(trend: Line) -> bool:
    return abs(trend.slope) > RESOLVED * trend.error


def plot_aged(axes: Axes, table: pd.DataFrame, label: str, expected: float) -> None:
    axes.errorbar(table.time, table["value"], table.error, marker="o", color=style.BLUE, **style.POINTS)
    axes.plot(table.time, table.fitted, color=style.BLACK, linestyle="dotted")
    axes.axhline(expected, **style.GUIDE)
    axes.set(xscale="log", xlabel="relaxation time", ylabel=label)


def caption(longest: Result, trends: dict[str, Line], results: Sequence[Result]) -> str:
    moving = [name for name, trend in trends.items() if resolved(trend)]
    (until,) = {
        result.parameters["observation-time"]
        for result in results
        if result.provenance["program"] == "displacement"
    }
    shown = [f"({letter}) {name}" for letter, name in zip(ascii_lowercase[2:], moving, strict=False)]
    first, last = (style.with_error(longest["decade_slope"], k) for k in (0, -1))
    said = [
        f"{with_error(trend.slope, trend.error)} of {name} ({goodness(trend.chi_square, trend.freedom)}){'' if resolved(trend) else ', which is not resolved'}"
        for name, trend in trends.items()
    ]
    return f"""
        Ageing of a closed chain, {parameters([longest], *CHAIN, *GAS)}, {replicas(results)}, that starts with scatterers at rest, to which the particles lose their energy. (a) Mean
        kinetic energy of a scatterer (circles) and of a particle (squares) against the time from the start; (b) slope of the scatterers'
        energy against ln t, decade by decade: {first} in the first and {last} in the last. The paper has a logarithmic growth that
        saturates; the slope falls, the earlier the fewer particles n there are, and is not zero at the end. {f"{listed(shown)} against the relaxation time, with a line fitted in its logarithm (dotted) and the value expected at equilibrium (dashed)." if shown else ""} Change per unit of
        the logarithm of the relaxation time: {"; ".join(said)}. α is fitted up to t = {number(until)} here, earlier than in fig. 7 and ext. 1, and
        falls with the time of the fit where the chain ages. {ERRORS}; a trend is resolved beyond {RESOLVED} of them."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    ageing = [result for result in results if result.provenance["program"] == "ageing"]
    few = min(ageing, key=lambda result: result.parameters["particles-per-cell"])
    longest = max(
        ageing,
        key=lambda result: (result.parameters["particles-per-cell"], result.parameters["observation-time"]),
    )
    found = {name: aged(results, program, name) for program, name, *_ in AGED}
    shown = [entry for entry in AGED if resolved(found[entry[1]][1])]
    figure = plt.figure(figsize=((1 + 0.9 * len(shown)) * style.COLUMN, 1.5 * style.HEIGHT))
    grid = figure.add_gridspec(2, 1 + len(shown), height_ratios=[1.7, 1])
    above = figure.add_subplot(grid[0, 0])
    below = figure.add_subplot(grid[1, 0], sharex=above)
    others = [figure.add_subplot(grid[:, 1 + k]) for k in range(len(shown))]
    tables = [*plot_energies(above, longest), plot_slopes(below, longest, marker="o", color=style.BLUE)]
    if few.parameters["particles-per-cell"] < longest.parameters["particles-per-cell"]:
        tables.append(plot_slopes(below, few, marker="^", color=style.ORANGE))
        below.legend(loc="upper right")
    for axes, (_, name, label, expected, _) in zip(others, shown, strict=True):
        plot_aged(axes, found[name][0], label, expected(longest.parameters["sigma"]))
    tables += [table for table, _ in found.values()]
    style.letter(above, below, *others)
    trends = {spoken: found[name][1] for _, name, *_, spoken in AGED}
    return figure, pd.concat(tables), caption(longest, trends, results)


if __name__ == "__main__":
    run(draw, "Ageing of the closed chain", value="column units", error="column units", fitted="1")
