"""Accuracy against CPU time: what it costs, and which errors more time does not reduce.

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
from workflow.lib.caption import fill
from workflow.lib.figure import NoValueError, Parts
from workflow.lib.identity import panel_of
from workflow.lib.load import FormatError, Result, cost_file, cpu_seconds
from workflow.lib.text import format_number, format_with_error, listed
from workflow.physics import run_parameters

TITLE = "Accuracy against time"
LABELLED = True  # labels have the parameters
UNITS = {"cpu_seconds": "second", "cost_of_1_percent": "second", "cost_without_control_variates": "second"}
UNITS |= dict.fromkeys(("error", "deviation"), "1")

STARTS = ("cold", "warm")  # series that relax too briefly
OWN = (*STARTS, "reference", "kinetic")  # others are those of the panels used
NAMES = {
    "alpha": r"$\langle x^2 \rangle$",
    "crossings": "$F(p)$",
    "damping_exponent": "damping of a pulse",
    "exponent": r"exponent of $\Psi$",
    "log_slope": r"$dn/d\ln t$",
    "mu": r"$\mu$",
    "temperature_scatterer": "$T$ profile",
}
COLUMNS = [
    *("panel", "series", "program", "quantity", "gamma", "cells", "relaxation_time", "cpu_seconds", "error"),
    *("cost_of_1_percent", "cost_without_control_variates", "deviation", "deviation_error"),
]
GREY = "0.45"
PERCENT = 0.01
LARGEST = 0.5  # errors above it are those of targets next to 0


def seconds(result: Result) -> float:
    """CPU time of a run. Raises FormatError if the file of its cost is missing."""
    time = cpu_seconds(result.path)
    if time is None:
        raise FormatError(
            f"{cost_file(result.path)} is missing or damaged: remove {result.path} and make it again"
        )
    return time


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run with the relative error of its target quantity; of sampling programs the CPU time for
    an error of 1 %, as an error falls with the square root of the number of replicas; of short relaxations
    the deviation of kappa from the reference."""
    rows = []
    reference = next((result["kappa"] for result in results if result.series == "reference"), None)
    for result in results:
        origin, time = result.provenance, seconds(result)
        row = {"panel": panel_of(result.path), "series": result.series, "program": origin["program"]}
        row |= {"quantity": origin["target_quantity"], "gamma": run_parameters.gamma(result)}
        row |= {name: result.parameters.get(name) for name in ("cells", "relaxation_time")}
        row |= {"cpu_seconds": time, "error": origin["achieved_error"]}
        if row["program"] != "boltzmann":
            plain = origin["error_without_control_variates"]
            row["cost_of_1_percent"] = time * (row["error"] / PERCENT) ** 2
            row["cost_without_control_variates"] = time * (plain / PERCENT) ** 2
        if reference and result.series in STARTS:
            kappa = result["kappa"]
            row["deviation"] = float(kappa.mean / reference.mean) - 1
            row["deviation_error"] = float(np.hypot(kappa.error, reference.error) / reference.mean)
        rows.append(row)
    return pd.DataFrame(rows, columns=COLUMNS)


def typical(sampled: pd.DataFrame) -> pd.DataFrame:
    """Runs with a line: kappa of the smallest chain of 16 cells or more, of one between, and of the largest;
    of any other quantity the one of median cost, of two the costlier."""
    kappa = sampled[sampled.quantity == "kappa"]
    kappa = kappa[kappa.gamma == max(kappa.gamma, default="")].sort_values("cells")  # N is after any digit
    kappa = kappa[kappa.cells >= min(16, kappa.cells.max())].drop_duplicates("cells")
    kappa = kappa[kappa.cells.isin(kappa.cells.quantile([0, 0.5, 1], interpolation="higher"))]
    others = sampled[sampled.quantity != "kappa"].sort_values("cost_of_1_percent").groupby("quantity")
    chosen = [part.iloc[[len(part) // 2]] for _, part in others]
    return pd.concat([*chosen, kappa])


def floors(table: pd.DataFrame) -> pd.DataFrame:
    """Short relaxations with a significant deviation."""
    return table[table.deviation.abs() > 2 * table.deviation_error]


def draw_errors(axes: Axes, table: pd.DataFrame, lines: pd.DataFrame) -> None:
    """Plots what errors cost: a line through each of these runs, Boltzmann equations, and the deviations that
    no number of replicas reduces."""
    kinetic, biased = table[table.series == "kinetic"], floors(table)
    shown = pd.concat([lines, kinetic])
    if shown.empty:
        raise NoValueError(f"no relative error is below {LARGEST}: raise the number of replicas")
    longest = shown[["cpu_seconds", "cost_of_1_percent"]].max().max()
    frame = np.array([shown.cpu_seconds.min() / 3, 3 * longest])
    axes.set(xscale="log", yscale="log", xlabel="CPU time / s", ylabel="relative error", xlim=frame)
    ends = []
    for run in lines.itertuples():
        name, color, width = NAMES.get(run.quantity, run.quantity.replace("_", " ")), GREY, 0.6
        if run.quantity == "kappa":
            name, color, width = rf"$\kappa$, $N = {run.cells:g}$", style.BLUE, 1.8
        errors = run.error * np.sqrt(run.cpu_seconds / frame)
        axes.plot(frame, errors, color=color, linewidth=width, zorder=0)
        axes.plot(run.cpu_seconds, run.error, "o", color=color)
        ends.append((name, frame[1], errors[1], color))
    for run in biased.itertuples():
        percent = format_with_error(100 * run.deviation, 100 * run.deviation_error)
        name = f"{run.series} start, relaxed for {format_number(run.relaxation_time)}: {percent} %"
        axes.axhline(abs(run.deviation), color=style.BLACK, linestyle="dashed", zorder=0)
        ends.append((name, frame[1], abs(run.deviation), style.BLACK))
    heights = [*shown.error, *(y for _, _, y, _ in ends)]
    axes.set_ylim(min(heights) / 3, 2 * max(heights))
    style.name_ends(axes, ends)
    ends = []
    courses = kinetic.sort_values("error", ascending=False).groupby("gamma")  # in the order of the targets
    for (gamma, part), marker in zip(courses, cycle("sD^v"), strict=False):
        axes.plot(part.cpu_seconds, part.error, marker=marker, color=style.ORANGE)
        last = (part.cpu_seconds.iloc[-1], part.error.iloc[-1], style.ORANGE)
        ends.append((rf"Boltzmann equation, $\gamma = {gamma}$", *last))
    style.name_ends(axes, ends)


def draw_costs(axes: Axes, kappa: pd.DataFrame) -> None:
    """Plots the cost of 1 % against N, if there are such runs."""
    if kappa.empty:
        axes.set_visible(False)
        return
    looks = style.by_gamma(kappa.gamma)
    for gamma, part in kappa.sort_values("cells").groupby("gamma"):
        marker, color = looks[gamma]
        axes.plot(
            part.cells, part.cost_of_1_percent, marker=marker, color=color, label=rf"$\gamma = {gamma}$"
        )
        axes.plot(part.cells, part.cost_without_control_variates, ":", color=color)
    axes.plot([], [], ":", color="grey", label="without control variates")
    axes.set(yscale="log", ylabel=r"CPU seconds for 1 % of $\kappa$")
    style.against_size(axes, kappa.cells)
    axes.legend()


def caption(table: pd.DataFrame, lines: pd.DataFrame) -> str:
    sizes = floors(table).cells.unique()
    kappa = lines[lines.quantity == "kappa"]
    costs = (f"{float(f'{cost:.2g}'):g}" for cost in kappa.cost_of_1_percent)
    at = [f"{cost} s at N = {cells:g}" for cost, cells in zip(costs, kappa.cells, strict=True)]
    ends = listed(dict.fromkeys([at[0], at[-1]])) if at else None
    text = """(a) Relative errors and CPU times of simulations (circles), extrapolated as 1/√(CPU time),
        and of the Boltzmann equation. Dashed (N = {biased}): bias of chains that relax for too short a
        time, which no number of replicas reduces. (b) At γ = {gamma} an error of 1 % of κ costs {cost}."""
    biased = listed(f"{size:g}" for size in sizes) if len(sizes) else None
    return fill(text, biased=biased, cost=ends, gamma=kappa.gamma.iloc[0] if at else None)


def draw(results: Sequence[Result]) -> Parts:
    table = tabulate(results)
    sampled = table[~table.series.isin(OWN) & (table.error < LARGEST)].dropna(subset="cost_of_1_percent")
    lines = typical(sampled)
    size = (2 * style.COLUMN, 2 * style.HEIGHT)
    figure, panels = plt.subplots(2, 1, figsize=size, height_ratios=(3, 2))
    draw_errors(panels[0], table, lines)
    draw_costs(panels[1], sampled[sampled.quantity == "kappa"])
    style.letter(*panels)
    return figure, table, caption(table, lines)
