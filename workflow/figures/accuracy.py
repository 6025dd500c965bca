"""Accuracy against time: errors of four programs with several numbers of replicas, and of the kinetic solver
at several resolutions, against CPU time; distances from a reference; bias against cost of the relaxation time
and of the first time of a fit.

The time is that of each run on the machine that made it, from the file of its cost (docs/format.md), so that
this panel alone differs between machines.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.figure import Parts, plots
from workflow.lib.load import FormatError, Result, cpu_seconds

TITLE = "Accuracy against time"
UNITS = {"cpu_seconds": "second", "error": "1", "points": "1"}

OCTAVE = "local_exponent"  # of the heat in rings; its last octave has the largest error
STARTS = {"warm": ("o", style.BLACK), "cold": ("s", style.BLUE), "empty": ("^", style.VERMILLION)}
LOOKS = {
    "mu": ("o", style.BLACK, r"$\mu$"),
    "alpha": ("s", style.BLUE, r"$\alpha$"),
    "kappa": ("^", style.VERMILLION, r"$\kappa$"),
    "amplitude": ("v", style.GREEN, "$A$"),
    OCTAVE: ("D", style.ORANGE, r"$\beta$, last octave"),
}  # marker, colour and symbol by quantity
GAMMAS = [("o", style.BLUE, "solid"), ("s", style.VERMILLION, "dashed")]
PAPER_POINTS = 4200


def seconds(result: Result) -> float:
    """CPU time of a run. Raises FormatError if the file of its cost is missing."""
    time = cpu_seconds(result.path)
    if time is None:
        path = result.path.with_suffix(".cost.json")
        raise FormatError(f"{path} is missing or damaged: remove {result.path} and make it again")
    return time


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run and estimate. `replicas` and the uncertainty of the error, relative to it, are those
    of sampling programs, `points` of the kinetic solver."""
    rows = []
    for result in results:
        provenance = result.provenance
        row = {"program": provenance["program"], "cpu_seconds": seconds(result)}
        if row["program"] == "boltzmann":
            row |= {
                "quantity": "currents",
                "gamma": result.parameters["gamma"],
                "error": provenance["achieved_error"],
            }
            rows.append(row | {"points": int(result["momentum_points"].mean)})
            continue
        name = str(provenance["target_quantity"])
        for quantity in (name, OCTAVE):
            if quantity in result.quantities:
                estimate, count = result[quantity], result.replicas
                value, absolute = float(estimate.mean.flat[-1]), float(estimate.error.flat[-1])
                error = abs(absolute / value)
                sampled = {"replicas": count, "value": value, "error_error": error / np.sqrt(2 * (count - 1))}
                rows.append(row | {"quantity": quantity, "error": error} | sampled)
    return pd.DataFrame(rows)


def draw_sampled(axes: Axes, table: pd.DataFrame) -> None:
    """Plots errors. Lines: 1/sqrt(time) through the mean of the logarithms."""
    for quantity, part in table.groupby("quantity", sort=False):
        marker, color, symbol = LOOKS[quantity]
        axes.errorbar(
            part.cpu_seconds, part.error, part.error_error, **style.points(marker, color, label=symbol)
        )
        law = np.exp(np.average(np.log(part.error * np.sqrt(part.cpu_seconds)), weights=part.replicas))
        axes.plot(part.cpu_seconds, law / np.sqrt(part.cpu_seconds), color=color, linewidth=0.8, zorder=1)
    axes.set(xlabel="CPU time / s", ylabel="relative error")
    if table.error.notna().any():  # matplotlib has no logarithmic axis without points
        axes.set(xscale="log", yscale="log")
        axes.set_ylim(top=30 * table.error.max())  # space for the legend
    axes.legend(loc="upper right", ncols=2, handlelength=1.8)


def draw_distances(axes: Axes, table: pd.DataFrame) -> None:
    """Plots the distance of every estimate from that with the most replicas, over the errors of both."""
    for quantity, part in table.groupby("quantity", sort=False):
        marker, color, _ = LOOKS[quantity]
        reference = part.loc[part.replicas.idxmax()]
        others = part.drop(reference.name)
        error = np.hypot(others.error * others.value, reference.error * reference.value)
        axes.errorbar(
            others.replicas, (others.value - reference.value) / error, **style.points(marker, color)
        )
    axes.axhspan(-2, 2, **style.WINDOW)
    axes.axhline(0, **style.GUIDE)
    axes.set(ylim=(-4, 4), xlabel="replicas", ylabel="distance from reference / error")
    if table.error.notna().any():
        axes.set_xscale("log")
        style.label_within_decades(axes.xaxis)


def draw_kinetic(axes: Axes, table: pd.DataFrame) -> None:
    resolutions = table.drop_duplicates(["gamma", "points"]).sort_values("points")
    for (gamma, part), (marker, color, dashes) in zip(resolutions.groupby("gamma"), GAMMAS, strict=False):
        look: style.Look = {
            "marker": marker,
            "color": color,
            "linestyle": dashes,
            "label": rf"$\gamma = {gamma:g}$",
        }
        axes.plot(part.points, part.error, **look)
    axes.set(xscale="log", yscale="log", xlabel="points in momentum", ylabel="relative error of the currents")
    style.label_within_decades(axes.xaxis)
    axes.legend(loc="upper right")


def draw_relaxation(axes: Axes, results: Sequence[Result]) -> None:
    """Plots the conductivity against the relaxation time, by the start."""
    for start, (marker, color) in STARTS.items():
        runs = [result for result in results if result.parameters["start"] == start]
        table = pd.DataFrame(
            [{"time": run.parameters["relaxation-time"]} | run.columns("kappa") for run in runs]
        )
        axes.errorbar(table.time, table.kappa, table.kappa_error, **style.points(marker, color, label=start))
        moving = np.array([not run.usable for run in runs])
        style.cross_out(axes, table.time.to_numpy(), table.kappa.to_numpy(), moving)
    axes.set(xscale="log", xlabel="relaxation time", ylabel=rf"conductivity $\kappa$ ({style.UNITS})")
    axes.legend(loc="best", title="start")


def draw_first_times(axes: Axes, results: Sequence[Result]) -> None:
    """Plots the fitted amplitude of the heat in rings against the first time of the fit."""
    table = pd.DataFrame(
        [{"time": run.parameters["fit-from"]} | run.columns("amplitude") for run in results]
    ).sort_values("time")
    marker, color, _ = LOOKS["amplitude"]
    axes.errorbar(table.time, table.amplitude, table.amplitude_error, **style.points(marker, color))
    axes.set(xscale="log", xlabel="first time of the fit", ylabel="amplitude $A$")
    style.label_within_decades(axes.xaxis)


@plots("conductivity spreading persistence heat kinetic relaxation first-time")
def draw(results: Sequence[Result]) -> Parts:
    series = {
        name: [result for result in results if result.series == name] for name in ("relaxation", "first-time")
    }
    table = tabulate([result for result in results if result.series not in series])
    sampled, kinetic = (part for _, part in table.groupby(table.program == "boltzmann"))
    figure, axes = plt.subplot_mosaic("aab;cde", figsize=(3 * style.COLUMN, 2 * style.HEIGHT))
    draw_sampled(axes["a"], sampled)
    draw_distances(axes["b"], sampled)
    draw_relaxation(axes["c"], series["relaxation"])
    draw_first_times(axes["d"], series["first-time"])
    draw_kinetic(axes["e"], kinetic)
    style.letter(*axes.values())
    caption = f"""
        Errors fall with the number of replicas. (a) Lines show 1/√t. (b) Distances from
        the most precise estimates are divided by their errors; grey: two errors. (c) Crosses: short relaxations, whose test of stationarity fails.
        (d) A depends on the first time of the fit. (e) For the kinetic equation the paper has {PAPER_POINTS} points."""
    return figure, table.drop(columns="value"), caption
