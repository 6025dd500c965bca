"""Accuracy against CPU time: what 1 % costs, which parameter to raise, and what a target error achieves.

The time is that of each run on the machine that made it, from the file of its cost (docs/format.md), so that
this panel alone differs between machines.
"""

from collections.abc import Sequence
from itertools import cycle

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, format_number
from workflow.lib.figure import Parts
from workflow.lib.identity import panel_of
from workflow.lib.load import FormatError, Result, cost_file, cpu_seconds
from workflow.physics import run_parameters

TITLE = "Accuracy against time"
UNITS = {"cpu_seconds": "second", "cost_of_1_percent": "second", "cost_without_control_variates": "second"}
UNITS |= dict.fromkeys(("error", "deviation"), "1")

OWN = (
    "relaxation",
    "window",
    "reference",
    "target",
    "kinetic",
)  # series; others are those of the panels used
STARTS = {"warm": ("o", style.BLACK), "cold": ("s", style.BLUE), "empty": ("^", style.VERMILLION)}
PROGRAMS = {
    "conductivity": ("o", style.BLUE),
    "displacement": ("s", style.BLACK),
    "energy_pulse": ("v", style.GREEN),
    "momentum_flux": ("<", style.ORANGE),
    "particle_count": (">", style.SKY),
    "persistence": ("^", style.VERMILLION),
    "steady_profile": ("D", style.ORANGE),
    "waiting_time": ("P", style.BLACK),
}
PERCENT = 0.01


def seconds(result: Result) -> float:
    """CPU time of a run. Raises FormatError if the file of its cost is missing."""
    time = cpu_seconds(result.path)
    if time is None:
        raise FormatError(
            f"{cost_file(result.path)} is missing or damaged: remove {result.path} and make it again"
        )
    return time


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run with the relative error of its target quantity, and for sampling programs the CPU time
    for an error of 1 %, as an error falls with the square root of the number of replicas."""
    rows = []
    for result in results:
        origin, time = result.provenance, seconds(result)
        row = {"panel": panel_of(result.path), "series": result.series, "program": origin["program"]}
        row |= {"cells": result.parameters.get("cells"), "gamma": run_parameters.gamma(result)}
        row |= {
            name: result.parameters.get(name) for name in ("start", "relaxation_time", "observation_time")
        }
        row |= {
            "target_error": origin["target_error"],
            "cpu_seconds": time,
            "error": origin["achieved_error"],
        }
        if row["program"] != "boltzmann":
            plain = origin["error_without_control_variates"]
            row["cost_of_1_percent"] = time * (row["error"] / PERCENT) ** 2
            row["cost_without_control_variates"] = time * (plain / PERCENT) ** 2
            if row["series"] in OWN:
                row |= result.columns("kappa") | {"usable": result.usable}
        rows.append(row)
    table = pd.DataFrame(rows)
    exact = table[table.series == "reference"].iloc[0]
    table["deviation"] = table.kappa / exact.kappa - 1
    table["deviation_error"] = np.hypot(table.kappa_error, exact.kappa_error) / exact.kappa
    return table


def draw_costs(axes: Axes, table: pd.DataFrame) -> None:
    """Plots the cost of 1 % against N; of runs of one program and size, the geometric mean. Open: gamma < N;
    dotted: without control variates."""
    costs = ["cost_of_1_percent", "cost_without_control_variates"]
    for (program, gamma), part in table.groupby(["program", "gamma"]):
        marker, color = PROGRAMS.get(program, ("X", style.SKY))
        every = gamma in ("N", "none")
        label = f"{program.replace('_', ' ')}" + rf", $\gamma = {gamma}$" * (not every)
        mean = np.exp(np.log(part.set_index("cells")[costs]).groupby(level=0).mean())
        line = "-" if len(mean) > 2 else "none"
        face = color if every else "white"
        look: style.Look = {"marker": marker, "color": color, "linewidth": 0.6, "zorder": 2 + every}
        axes.plot(mean.index, mean[costs[0]], linestyle=line, markerfacecolor=face, label=label, **look)
        if line != "none":
            axes.plot(mean.index, mean[costs[1]], linestyle=(0, (1, 1)), marker="", color=color)
    axes.set(xscale="log", yscale="log", xlabel="number of cells $N$", ylabel="CPU seconds for 1 %")
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), fontsize="small")


def draw_bias(axes: Axes, table: pd.DataFrame, name: str, symbol: str) -> None:
    """Plots the distance of kappa from the reference, and its standard error as a line, against the CPU time,
    which rises with the parameter `name`. Where points exceed the line, more replicas do not help."""
    for start, (marker, color) in STARTS.items():
        part = table[table.start == start].sort_values(name)
        axes.errorbar(
            part.cpu_seconds,
            part.deviation.abs(),
            part.deviation_error,
            **style.points(marker, color, label=start),
        )
        axes.plot(part.cpu_seconds, part.deviation_error, color=color, linestyle="dotted", zorder=1)
        style.cross_out(
            axes, part.cpu_seconds.to_numpy(), part.deviation.abs().to_numpy(), ~part.usable.astype(bool)
        )
    ends = [format_number(value) for value in (table[name].min(), table[name].max())]
    axes.set(xscale="log", yscale="log", ylabel=r"$|\Delta\kappa|/\kappa$")
    style.label_within_decades(axes.xaxis)
    axes.set_xlabel(f"CPU time / s, {symbol} from {ends[0]} to {ends[1]}")


def draw_targets(axes: Axes, table: pd.DataFrame) -> None:
    """Plots the distance of kappa from the reference over the target error."""
    part = table[table.series == "target"]
    axes.axhspan(-1, 1, **style.WINDOW)
    axes.axhline(0, **style.GUIDE)
    for (target, runs), (marker, _) in zip(part.groupby("target_error"), cycle(style.LOOKS), strict=False):
        look = style.points(marker, style.BLUE, "white", label=f"{100 * target:g} %")
        axes.errorbar(runs.cpu_seconds, runs.deviation / target, runs.error / target, **look)
    axes.set(xscale="log", xlabel="CPU time / s", ylabel="deviation / target error")
    style.label_within_decades(axes.xaxis)
    axes.legend(loc="upper left", title="target", ncols=3)
    axes.margins(y=0.35)  # room for the legend


def draw_kinetic(axes: Axes, table: pd.DataFrame) -> None:
    kinetic = table[table.series == "kinetic"].drop_duplicates(["gamma", "error"]).sort_values("cpu_seconds")
    looks = zip(cycle(style.LOOKS), cycle(style.DASHES), strict=False)
    for (gamma, part), ((marker, color), dashes) in zip(kinetic.groupby("gamma"), looks, strict=False):
        label = rf"$\gamma = {format_number(float(gamma))}$"
        axes.plot(part.cpu_seconds, part.error, marker=marker, color=color, linestyle=dashes, label=label)
    axes.set(xscale="log", yscale="log", xlabel="CPU time / s", ylabel="error of F and currents")
    axes.legend(loc="lower left")


def rms_over_target(table: pd.DataFrame) -> str:
    """Root of the mean square of deviation over target, largest over the targets."""
    part = table[table.series == "target"]
    squares = (part.deviation / part.target_error) ** 2
    return f"{float(np.sqrt(squares.groupby(part.target_error).mean().max())):.2f}"


def cost_at(table: pd.DataFrame, gamma: str, largest: bool) -> str:
    """N and CPU seconds for 1 % of kappa in chains of 16 cells or more."""
    part = table[~table.series.isin(OWN) & (table.program == "conductivity") & (table.gamma == gamma)]
    part = part[part.cells >= 16].sort_values("cells")
    row = part.iloc[-1 if largest else 0]
    cost = float(f"{row.cost_of_1_percent:.2g}")
    return f"{cost:g} s at N = {row.cells:g}"


def caption(table: pd.DataFrame) -> str:
    return f"""
        (a) 1 % of κ costs {cost_at(table, "N", False)}, {cost_at(table, "N", True)} (γ = N; dotted: without control variates). (b), (c) Deviation of κ from a long run
        (dotted: its error; crosses: not stationary): a longer relaxation lowers it, a longer window both. (d) Deviation over target:
        {rms_over_target(table)} at most (root mean square). (e) Kinetic equation. {ERRORS}"""


def draw(results: Sequence[Result]) -> Parts:
    table = tabulate(results)
    sampled = table[~table.series.isin(OWN) & (table.error < 0.5)]  # of targets other than 0
    sampled = sampled.dropna(subset="cost_of_1_percent")
    figure, axes = plt.subplot_mosaic("aab;cde", figsize=(3 * style.COLUMN, 2 * style.HEIGHT))
    draw_costs(axes["a"], sampled)
    draw_bias(axes["b"], table[table.series == "relaxation"], "relaxation_time", "relaxation time")
    draw_bias(axes["c"], table[table.series == "window"], "observation_time", "window")
    axes["b"].legend(loc="best", title="start")
    draw_targets(axes["d"], table)
    draw_kinetic(axes["e"], table)
    style.letter(*axes.values())
    return figure, table, caption(table)
