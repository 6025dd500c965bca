"""Ext. 1: spreading with the paper's random total momentum and with none; ext. 4: with random directions.

Above, local slopes of <x^2>(t): 2 is ballistic, 1 diffusive, and t/ln t approaches 1 from below. Below, what
decides between the laws for the runs that have no drift of all particles: alpha of t^alpha, and the power b of
t ln(t/tau)^b, which is 0 for t and -1 for t/ln t.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Result

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
        for name in (
            "sigma",
            "particles-per-cell",
            "relaxation-time",
            "zero-total-momentum",
            "random-direction",
        ):
            part[name.replace("-", "_")] = result.parameters[name]
        for name in ("alpha", "logarithmic_power", "momentum_drift"):
            if name not in result.quantities or np.isnan(result[name].mean):
                continue  # no logarithmic power where the chain drifts, no momentum where directions are drawn
            part[name] = float(result[name].mean)
            part[f"{name}_error"] = float(result[name].standard_error)
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def verdict(axes: Axes, table: pd.DataFrame, relaxations: list[float]) -> None:
    """alpha - 1 and b of every run without drift, one row per run: what decides between t, t/ln t, t^alpha."""
    free_of_drift = table[table.zero_total_momentum | table.random_direction]
    runs = free_of_drift.drop_duplicates(["particles_per_cell", "relaxation_time"])
    for row, run_row in enumerate(runs.itertuples()):
        look = {
            "marker": MARKERS[run_row.particles_per_cell],
            "fillstyle": FILLS[relaxations.index(run_row.relaxation_time)],
            **style.POINTS,
        }
        axes.errorbar(run_row.alpha - 1, row, xerr=run_row.alpha_error, color=style.BLACK, **look)
        error = run_row.logarithmic_power_error
        axes.errorbar(run_row.logarithmic_power, row, xerr=error, color=style.GREEN, **look)
    for value, law in ((0, "$t$"), (-1, r"$t/\ln t$")):
        axes.axvline(value, **style.GUIDE)
        axes.text(value, 1.02, law, transform=axes.get_xaxis_transform(), ha="center", va="bottom", size=8)
    axes.set(xlim=(-1.6, 1.1), ylim=(-0.7, len(runs) - 0.3), yticks=[])
    axes.set_xlabel(r"$\alpha - 1$ (black), $b$ (green)")


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    table = tabulate(results)
    sigmas = sorted(table.sigma.unique())
    relaxations = sorted(table.relaxation_time.unique())
    figure, (rows, verdicts) = plt.subplots(
        2,
        len(sigmas),
        sharey="row",
        figsize=(style.COLUMN * (0.4 + 0.6 * len(sigmas)), 1.45 * style.HEIGHT),
        height_ratios=[2, 1],
    )
    runs = ["sigma", "particles_per_cell", "relaxation_time", "zero_total_momentum"]
    for (sigma, particles, relaxation, zero), run_table in table.groupby(runs):
        axes = rows[sigmas.index(sigma)]
        look = {
            "marker": MARKERS[particles],
            "color": COLORS[int(zero)],
            "fillstyle": FILLS[relaxations.index(relaxation)],
        }
        every = run_table.iloc[::3]
        axes.errorbar(
            every.time, every.slope, every.slope_error, **look, **{**style.POINTS, "linestyle": "-"}
        )
        axes.set(xscale="log", xlabel="time $t$", title=rf"$\sigma = {sigma:g}$")
    for sigma, axes in zip(sigmas, verdicts, strict=True):
        verdict(axes, table[table.sigma == sigma], relaxations)
    rows[0].set_xlabel(f"time $t$ ({style.UNITS})")
    for axes in rows:
        for value in (1, 2):
            axes.axhline(value, **style.GUIDE)
    rows[0].set(ylabel=r"$d\ln\langle x^2\rangle/d\ln t$", ylim=(0, 2.6))
    verdicts[0].set_ylabel("runs without drift")
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
    run(draw, "Local exponent of the spreading of a tagged particle", slope="1", slope_error="1")
