"""Ageing: energies against the logarithm of time, with the quasi-stationary estimate, and the influence of the relaxation
time.

With few particles the energy saturates. Several quantities depend on the relaxation time. The exponent of the
spreading is plotted; the table has all of them.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, GAS, parameters
from workflow.lib.figure import Parts, main, plots
from workflow.lib.fit import format_with_error
from workflow.lib.load import Result
from workflow.physics.closed import quasi_stationary

AGED = {"persistence": "mu", "waiting_time": "exponent", "displacement": "alpha"}  # quantities by program
ENERGIES: dict[str, style.Look] = {
    "scatterer_energy_mean": style.points("o", style.BLUE, label="scatterer"),
    "particle_energy": style.points("s", style.VERMILLION, "white", label="particle"),
}
SLOPES = [style.points("o", style.BLUE), style.points("D", style.GREEN, "white")]

FLIGHTS = 10  # first time of the quasi-stationary estimate in units of λ/√T at the start: all but slow particles have scattered often


def contents(results: Sequence[Result]) -> list[Result]:
    """The longest run for each number of particles, in descending order: the first has the paper's number, which is the largest."""
    longest: dict[int, Result] = {}
    ageing = [result for result in results if result.provenance["program"] == "ageing"]
    for result in sorted(ageing, key=lambda result: result.parameters["observation-time"]):
        longest[result.parameters["particles-per-cell"]] = result
    return [longest[particles] for particles in sorted(longest, reverse=True)]


def estimate(result: Result, time: np.ndarray) -> dict[str, np.ndarray]:
    """Quasi-stationary mean energies at the given times: T/2 of a scatterer and T/(2Λ) of a particle. NaN at early times."""
    particles, start, length = (
        float(result.parameters[name]) for name in ("particles-per-cell", "temperature", "cell-length")
    )
    temperature, slow = quasi_stationary(particles, start, length, time)
    late = np.where(time > FLIGHTS * length / np.sqrt(start), 1, np.nan)
    return dict(zip(ENERGIES, (late * temperature / 2, late * temperature / (2 * slow)), strict=True))


def plot_energies(axes: Axes, result: Result) -> list[pd.DataFrame]:
    """Plots mean energies: of a scatterer, averaged over windows of time; of a particle, at the ends of the windows."""
    tables = []
    for name, look in ENERGIES.items():
        energy = result[name]
        (time,) = energy.axes.values()
        axes.errorbar(time, energy.mean, energy.error, **look)
        expected = estimate(result, time)[name]
        axes.plot(time, expected, color=style.BLACK, zorder=3)
        columns = {"quantity": name, "time": time, "value": energy.mean, "estimate": expected}
        tables.append(pd.DataFrame({**columns, "error": energy.error, "units": energy.units}))
    axes.set(xscale="log", ylabel=f"mean energy ({style.UNITS})", ylim=(0, None))
    axes.legend(loc="upper left")
    return tables


def plot_slopes(axes: Axes, results: Sequence[Result]) -> list[pd.DataFrame]:
    """Plots the slope of the scatterers' energy against ln t, by decade of time."""
    tables = []
    for result, look in zip(results, SLOPES, strict=False):
        slope, particles = result["decade_slope"], result.parameters["particles-per-cell"]
        time = slope.axes["decade"]
        label = f"$n = {particles}$"
        axes.errorbar(np.sqrt(10) * time, slope.mean, slope.error, label=label, **look)
        ends = [estimate(result, factor * time)["scatterer_energy_mean"] for factor in (1, 10)]
        expected = (ends[1] - ends[0]) / np.log(10)
        axes.plot(np.sqrt(10) * time, expected, color=style.BLACK, zorder=3)
        columns = {"quantity": "decade_slope", "time": time, "value": slope.mean, "error": slope.error}
        table = pd.DataFrame({**columns, "estimate": expected})
        tables.append(table.assign(units=slope.units, particles_per_cell=particles))
    axes.axhline(0, **style.GUIDE)
    axes.set(xscale="log", xlabel="time from the start", ylabel=r"$dE/d\ln t$ of a scatterer")
    axes.legend(loc="upper right", handletextpad=0.2)
    return tables


def aged(results: Sequence[Result], program: str) -> pd.DataFrame:
    """Table of the quantity of a program against the relaxation time."""
    name = AGED[program]
    runs = [result for result in results if result.provenance["program"] == program]
    runs.sort(key=lambda result: result.parameters["relaxation-time"])
    time = [result.parameters["relaxation-time"] for result in runs]
    table = pd.DataFrame({"quantity": name, "time": time})
    table["value"] = [float(result[name].mean) for result in runs]
    table["error"] = [float(result[name].error) for result in runs]
    return table.assign(units=runs[0][name].units)


def plot_spreading(axes: Axes, table: pd.DataFrame) -> None:
    axes.errorbar(table.time, table["value"], table.error, **style.points("o", style.BLUE))
    axes.axhline(1, **style.GUIDE)
    axes.set(xscale="log", xlabel="relaxation time", ylabel=r"exponent $\alpha$, zero total momentum")


def caption(ageing: Sequence[Result], slopes: pd.DataFrame, spreading: pd.DataFrame) -> str:
    paper = ageing[0].parameters["particles-per-cell"]
    last = slopes[slopes.particles_per_cell == paper].iloc[-1]
    ratio = format_with_error(last.value / last.estimate, last.error / last.estimate)
    growth = format_with_error(last.value, last.error)
    end = spreading.iloc[-1]
    return f"""
        A chain whose scatterers start at rest approaches equilibrium slowly ({parameters(ageing[:1], "cells", "sigma", *GAS)}): in the last decade of time
        their energy grows by {growth} per unit of ln t. (a) Lines are a quasi-stationary estimate without fit. (b) The last slope at n = {paper} is
        {ratio} of this. (c) The exponent α ends at {format_with_error(end.value, end.error)}. {ERRORS}"""


@plots("energy long few persistence waiting spreading")
def draw(results: Sequence[Result]) -> Parts:
    ageing = contents(results)
    figure, panels = plt.subplot_mosaic(
        [["energies", "spreading"], ["slopes", "spreading"]],
        figsize=(2 * style.COLUMN, 1.4 * style.HEIGHT),
        height_ratios=[1.5, 1],
    )
    panels["energies"].sharex(panels["slopes"])
    by_program = {program: aged(results, program) for program in AGED}
    slopes = pd.concat(plot_slopes(panels["slopes"], ageing))
    tables = [*plot_energies(panels["energies"], ageing[0]), slopes, *by_program.values()]
    plot_spreading(panels["spreading"], by_program["displacement"])
    style.letter(*(panels[name] for name in ("energies", "slopes", "spreading")))
    return figure, pd.concat(tables), caption(ageing, slopes, by_program["displacement"])


if __name__ == "__main__":
    main(
        draw,
        "Ageing of the closed chain",
        value="column units",
        error="column units",
        estimate="column units",
    )
