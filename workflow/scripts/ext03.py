"""Ext. 3: the pulse rescaled, moving peaks in (x - x_p)/t^xi and centre in x/t^xi, with the best xi of each."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.scripts import style
from workflow.scripts.fig09 import gaussian_start
from workflow.scripts.figure import run
from workflow.scripts.load import Result


def fold(profile: np.ndarray) -> np.ndarray:
    """Mean of both sides, by distance from the centre."""
    centre = len(profile) // 2
    return 0.5 * (profile[centre:] + profile[centre::-1])


def collapse(axes: Axes, result: Result, moving: bool) -> pd.DataFrame:
    difference = result["energy_difference"]
    xi = result["peak_collapse" if moving else "centre_collapse"]
    times, exponent = difference.axes["time"], float(xi.mean)
    stretch = (times / times[-1]) ** exponent
    reach = 0.25 * result["peak_position"].mean[-1]
    parts = []
    for k, color, dashes in zip(
        np.linspace(1, len(times) - 1, 5).round().astype(int), style.SEQUENCE, style.DASHES, strict=True
    ):
        profile = fold(difference.mean[k])
        place = result["peak_position"].mean[k] if moving else 0
        x = (np.arange(len(profile)) - place) / stretch[k]
        y = profile * stretch[k]
        near = np.abs(x) <= (2 if moving else 1) * reach
        axes.plot(x[near], y[near] / 1e3, color=color, linestyle=dashes, label=f"$t = {times[k]:g}$")
        parts.append(pd.DataFrame({"moving": moving, "time": times[k], "x": x[near], "y": y[near]}))
    axes.axhline(0, **style.GUIDE)
    if not moving:
        share = style.with_error(result["centre_share"], -1, 100)
        note = f"central five cells at $t = {times[-1]:g}$:\n{share} % of the energy"
        axes.text(0.97, 0.95, note, transform=axes.transAxes, ha="right", va="top", fontsize=8)
    place = "(x - x_p)" if moving else "x"
    axes.set(
        xlabel=rf"${place}\,(t_1/t)^\xi / \lambda$",
        title=rf"$\gamma = {style.gamma(result)}$, $\xi = {style.with_error(xi)}$",
    )
    table = pd.concat(parts)
    table.insert(0, "gamma", style.gamma(result))
    return table.assign(xi=exponent, xi_error=float(xi.standard_error))


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    figure, rows = plt.subplots(2, 2, figsize=(1.9 * style.COLUMN, 1.8 * style.HEIGHT))
    tables = []
    for column, gamma in enumerate(("N", 1)):
        result = gaussian_start([one for one in results if one.parameters["gamma"] == gamma])
        for axes, moving in zip(rows[:, column], (True, False), strict=True):
            tables.append(collapse(axes, result, moving))
        rows[0, column].legend(loc="lower center", fontsize=7)
    rows[0, 0].set(ylabel=rf"moving peak: $(t/t_1)^\xi\,\Delta E\,/\,10^3$ ({style.UNITS})")
    rows[1, 0].set(ylabel=r"centre: $(t/t_1)^\xi\,\Delta E\,/\,10^3$")
    return figure, pd.concat(tables)


if __name__ == "__main__":
    run(draw, "Collapse of the energy pulse", x="1", y="energy", xi="1", xi_error="1")
