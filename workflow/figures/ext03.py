"""Ext. 3: the moving peak of the pulse rescaled in (x - x_p)/t^xi, with the best xi; gamma = N and gamma = 1.

The centre does not scale, so no xi is given for it: its local exponent -d ln Delta E / d ln t is not constant.
In the central cell it rises from 0.2 at t = 0.01 to 2 at t = 0.06 for gamma = N, where it is lost in the noise soon
after, and from -0.8 at t = 0.005 to 1.1 at t = 0.05 for gamma = 1, where Delta E of the cells beside changes sign.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.figures.fig09 import gaussian_start
from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Result


def fold(profile: np.ndarray) -> np.ndarray:
    """Mean of both sides, by distance from the centre."""
    centre = len(profile) // 2
    return 0.5 * (profile[centre:] + profile[centre::-1])


def collapse(axes: Axes, result: Result) -> pd.DataFrame:
    difference, xi, positions = (
        result["energy_difference"],
        result["peak_collapse"],
        result["peak_position"].mean,
    )
    times, exponent = difference.axes["time"], float(xi.mean)
    stretch = (times / times[-1]) ** exponent
    known = np.flatnonzero(np.isfinite(positions))
    reach = 0.5 * positions[known[-1]] if len(known) else 0
    shown = (
        known[np.linspace(min(1, len(known) - 1), len(known) - 1, 5).round().astype(int)]
        if len(known)
        else []
    )
    parts = []
    for k, color, dashes in zip(shown, style.SEQUENCE, style.DASHES, strict=False):
        profile = fold(difference.mean[k])
        x = (np.arange(len(profile)) - positions[k]) / stretch[k]
        y = profile * stretch[k]
        near = np.abs(x) <= reach
        axes.plot(x[near], y[near] / 1e3, color=color, linestyle=dashes, label=f"$t = {times[k]:g}$")
        parts.append(pd.DataFrame({"time": times[k], "x": x[near], "y": y[near]}))
    axes.axhline(0, **style.GUIDE)
    axes.set(
        xlabel=r"$(x - x_p)\,(t_1/t)^\xi / \lambda$",
        title=rf"$\gamma = {style.gamma(result)}$, $\xi = {style.with_error(xi)}$",
    )
    table = pd.concat(parts) if parts else pd.DataFrame(columns=["time", "x", "y"])
    table.insert(0, "gamma", style.gamma(result))
    return table.assign(xi=exponent, xi_error=float(xi.standard_error))


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    figure, row = plt.subplots(1, 2, figsize=(1.9 * style.COLUMN, style.HEIGHT))
    tables = []
    for axes, gamma in zip(row, ("N", 1), strict=True):
        result = gaussian_start([one for one in results if one.parameters["gamma"] == gamma])
        tables.append(collapse(axes, result))
        axes.legend(loc="lower center", fontsize=7, **style.OPAQUE)
    row[0].set(ylabel=rf"moving peak: $(t/t_1)^\xi\,\Delta E\,/\,10^3$ ({style.UNITS})")
    return figure, pd.concat(tables)


if __name__ == "__main__":
    run(draw, "Collapse of the moving peak of an energy pulse", x="1", y="energy", xi="1", xi_error="1")
