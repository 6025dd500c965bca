"""Ext. 7: ageing. Energies against the logarithm of time; what moves with the relaxation time."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Result

AGED = [
    ("persistence", "mu", r"persistence $\mu$", lambda sigma: np.arccos(sigma) / np.pi),
    ("waiting_time", "exponent", r"exponent of $\Psi$", lambda _: -2),
    ("displacement", "alpha", r"exponent $\alpha$, zero momentum", lambda _: 1),
]


def plot_energies(axes: Axes, result: Result) -> list[pd.DataFrame]:
    """Mean energies, of a scatterer over windows of time, of a particle at their ends; the slopes of each decade."""
    tables = []
    looks = {
        "scatterer_energy_mean": ("o", style.BLUE, "scatterer"),
        "particle_energy": ("s", style.VERMILLION, "particle"),
    }
    for name, (marker, color, label) in looks.items():
        energy = result[name]
        (time,) = energy.axes.values()
        look = {"marker": marker, "color": color, "label": label, **style.POINTS}
        axes.errorbar(time, energy.mean, energy.standard_error, **look)
        columns = {"quantity": name, "time": time, "value": energy.mean}
        tables.append(pd.DataFrame({**columns, "error": energy.standard_error, "units": energy.units}))
    slope = result["decade_slope"]
    height = result["scatterer_energy_mean"].mean.max()
    for k, first in enumerate(slope.axes["decade"]):
        place = (first * np.sqrt(10), 1.12 * height)
        axes.text(*place, style.with_error(slope, k), ha="center", fontsize=7)
    columns = {"quantity": "decade_slope", "time": slope.axes["decade"], "value": slope.mean}
    tables.append(pd.DataFrame({**columns, "error": slope.standard_error, "units": slope.units}))
    axes.set(xscale="log", xlabel="time from the start", ylabel=f"mean energy ({style.UNITS})")
    axes.set(ylim=(0, 1.25 * height), title="slope of the scatterers' against $\\ln t$, by decade:")
    axes.title.set_fontsize(8)
    axes.legend(loc="center left")
    return tables


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    figure, rows = plt.subplots(2, 2, figsize=(1.9 * style.COLUMN, 1.7 * style.HEIGHT))
    ageing = [result for result in results if result.provenance["program"] == "ageing"]
    longest = max(ageing, key=lambda result: result.parameters["observation-time"])
    tables = plot_energies(rows[0, 0], longest)
    for axes, (program, name, label, expected) in zip(rows.flat[1:], AGED, strict=True):
        runs = [result for result in results if result.provenance["program"] == program]
        runs.sort(key=lambda result: result.parameters["relaxation-time"])
        time = [result.parameters["relaxation-time"] for result in runs]
        value = [float(result[name].mean) for result in runs]
        error = [float(result[name].standard_error) for result in runs]
        axes.errorbar(time, value, error, marker="o", color=style.BLUE, **style.POINTS)
        axes.axhline(expected(runs[0].parameters["sigma"]), **style.GUIDE)
        axes.set(xscale="log", xlabel="relaxation time", ylabel=label)
        columns = {"quantity": name, "time": time, "value": value, "error": error}
        tables.append(pd.DataFrame({**columns, "units": runs[0][name].units}))
    return figure, pd.concat(tables)


if __name__ == "__main__":
    run(draw, "Ageing of the closed chain", value="column units", error="column units")
