"""Ext. 1: spreading with the paper's random total momentum and with none; ext. 4: with random directions.

Local slopes of <x^2>(t): 2 is ballistic, 1 diffusive, and t/ln t approaches 1 from below.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from workflow.scripts import style
from workflow.scripts.figure import run
from workflow.scripts.load import Result

COLORS = [style.BLUE, style.VERMILLION]  # by total momentum: free, zero
MARKERS = {20: "o", 80: "s"}
FILLS = ["full", "none"]  # by relaxation time: short, long


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run and time."""
    parts = []
    for result in results:
        slope = result["local_slope"]
        columns = {"time": slope.axes["time"], "slope": slope.mean, "slope_error": slope.standard_error}
        part = pd.DataFrame(columns)
        for name in ("sigma", "particles-per-cell", "relaxation-time", "zero-total-momentum"):
            part[name.replace("-", "_")] = result.parameters[name]
        part["alpha"] = float(result["alpha"].mean)
        part["alpha_error"] = float(result["alpha"].standard_error)
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    table = tabulate(results)
    sigmas = sorted(table.sigma.unique())
    relaxations = sorted(table.relaxation_time.unique())
    figure, rows = plt.subplots(
        1, len(sigmas), sharey=True, figsize=(style.COLUMN * (0.4 + 0.6 * len(sigmas)), style.HEIGHT)
    )
    runs = ["sigma", "particles_per_cell", "relaxation_time", "zero_total_momentum"]
    for (sigma, particles, relaxation, zero), run_table in table.groupby(runs):
        axes = rows[sigmas.index(sigma)]
        color = COLORS[int(zero)]
        look = {
            "marker": MARKERS[particles],
            "color": color,
            "fillstyle": FILLS[relaxations.index(relaxation)],
        }
        every = run_table.iloc[::3]
        axes.errorbar(
            every.time, every.slope, every.slope_error, **look, **{**style.POINTS, "linestyle": "-"}
        )
        axes.set(xscale="log", xlabel="time $t$", title=rf"$\sigma = {sigma:g}$")
    for axes in rows:
        for value in (1, 2):
            axes.axhline(value, **style.GUIDE)
    rows[0].set(ylabel=r"$d\ln\langle x^2\rangle/d\ln t$", ylim=(0, 2.6))
    plain = {"color": "grey", "linestyle": "none"}
    handles = [Line2D([], [], marker=MARKERS[n], label=f"$n = {n}$", **plain) for n in MARKERS]
    if len(relaxations) > 1:
        handles += [
            Line2D([], [], marker="o", fillstyle=fill, label=f"relaxed for {relaxation:g}", **plain)
            for fill, relaxation in zip(FILLS, relaxations, strict=True)
        ]
    if table.zero_total_momentum.nunique() > 1:
        names = ("random total momentum", "zero total momentum")
        handles += [
            Line2D([], [], color=color, label=name) for color, name in zip(COLORS, names, strict=True)
        ]
    figure.legend(handles=handles, loc="outside upper center", ncols=3)
    return figure, table


if __name__ == "__main__":
    run(draw, "Local exponent of the spreading of a tagged particle")
