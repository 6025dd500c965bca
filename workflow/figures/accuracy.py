"""Accuracy against time: relative error of the target quantity of four programs, with several numbers of replicas, and of the kinetic
solver at several resolutions, against CPU time.

The time is that of each run on the machine that made it, from the file of its cost (docs/format.md), so that this panel alone differs
between machines. Control variates are used by programs where they can; the same runs also have the estimates without them.
"""

import json
from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import listed
from workflow.lib.figure import Parts, main, plots
from workflow.lib.load import FormatError, Result

LOOKS = {
    "persistence": ("o", style.BLACK, "μ"),
    "displacement": ("s", style.BLUE, "α"),
    "conductivity": ("^", style.VERMILLION, "κ"),
    "heat_current": ("v", style.GREEN, "A"),
}  # marker, colour and symbol of the target quantity
PLAIN = "_plain"  # suffix of estimates without control variates
GAMMAS = [("o", style.BLUE, "solid"), ("s", style.VERMILLION, "dashed")]
PAPER_POINTS = 4200


def seconds(result: Result) -> float:
    """CPU time of a run. Raises FormatError if the file of its cost is missing."""
    path = result.path.with_suffix(".cost.json")
    try:
        return float(json.loads(path.read_text())["cpu_seconds"])
    except OSError as error:
        raise FormatError(f"{path} is missing: remove {result.path} and make it again") from error


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run and estimate: with control variates, where the program uses them, and without. `replicas` and the uncertainty of
    the error, relative to it, are those of sampling programs, `points` of the kinetic solver."""
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
        for quantity in (name, f"{name}{PLAIN}"):
            if quantity in result.quantities:
                estimate, count = result[quantity], result.replicas
                error = abs(float(estimate.error / estimate.mean))
                sampled = {"replicas": count, "error_error": error / np.sqrt(2 * (count - 1))}
                rows.append(row | {"quantity": quantity, "error": error} | sampled)
    return pd.DataFrame(rows)


def draw_sampled(axes: Axes, table: pd.DataFrame) -> None:
    """Plots errors with control variates, or of programs without any, as full symbols, and without control variates as open ones. Lines:
    1/sqrt(time) through the mean of the logarithms."""
    for (program, quantity), part in table.groupby(["program", "quantity"], sort=False):
        marker, color, symbol = LOOKS[program]
        plain = quantity.endswith(PLAIN)
        look = style.points(
            marker, color, "white" if plain else None, label=None if plain else f"{symbol}, {program}"
        )
        axes.errorbar(part.cpu_seconds, part.error, part.error_error, **look)
        law = np.exp(np.average(np.log(part.error * np.sqrt(part.cpu_seconds)), weights=part.replicas))
        dashes = "dotted" if plain else "solid"
        axes.plot(
            part.cpu_seconds,
            law / np.sqrt(part.cpu_seconds),
            color=color,
            linestyle=dashes,
            linewidth=0.8,
            zorder=1,
        )
    axes.plot(
        [],
        [],
        color="grey",
        linestyle="dotted",
        marker="o",
        markerfacecolor="white",
        label="without control variates",
    )
    axes.set(xscale="log", yscale="log", xlabel="CPU time / s", ylabel="relative error")
    style.label_within_decades(axes.xaxis)
    known = table.error.notna().any()  # not with one replica
    axes.set_ylim(*(None, 30 * table.error.max()) if known else (0.01, 1))  # space for the legend
    axes.legend(loc="upper right", handlelength=1.8)


def draw_kinetic(axes: Axes, table: pd.DataFrame) -> None:
    resolutions = table.drop_duplicates(["gamma", "points"]).sort_values("points")
    for (gamma, part), (marker, color, dashes) in zip(resolutions.groupby("gamma"), GAMMAS, strict=False):
        axes.plot(
            part.cpu_seconds,
            part.error,
            marker=marker,
            color=color,
            linestyle=dashes,
            label=rf"$\gamma = {gamma:g}$",
        )
        for row in part.itertuples():
            axes.annotate(
                f"{row.points:.0f}",
                (row.cpu_seconds, row.error),
                (4, 3),
                textcoords="offset points",
                size=7,
                color=color,
            )
    axes.set(xscale="log", yscale="log", xlabel="CPU time / s", ylabel="relative error of the currents")
    axes.margins(0.12)
    style.label_within_decades(axes.xaxis)
    axes.legend(loc="lower left")


def gain(table: pd.DataFrame, program: str) -> float:
    """Ratio of the times to one error without and with control variates, from the runs with the most replicas."""
    rows = table[table.program == program]
    most = rows[rows.replicas == rows.replicas.max()]
    plain = most.quantity.str.endswith(PLAIN)
    return float((most.error[plain].mean() / most.error[~plain].mean()) ** 2)


@plots("conductivity spreading persistence heat kinetic")
def draw(results: Sequence[Result]) -> Parts:
    table = tabulate(results)
    sampled, kinetic = (part for _, part in table.groupby(table.program == "boltzmann"))
    figure, (left, right) = plt.subplots(1, 2, figsize=(2 * style.COLUMN, style.HEIGHT))
    draw_sampled(left, sampled)
    draw_kinetic(right, kinetic)
    style.letter(left, right)
    gains = [
        f"{gain(sampled, program):.2g} for {LOOKS[program][2]}"
        for program in LOOKS
        if sampled[sampled.program == program].quantity.nunique() > 1
    ]
    caption = f"""
        Relative error against CPU time of one core. (a) Four programs with several numbers of replicas; lines: 1/√t. Control variates save
        factors of {listed(gains)}. (b) Solver of the kinetic equation, estimated from a coarser solution, with its numbers of momentum
        points; the paper uses {PAPER_POINTS} and states no error. Bars: uncertainty of the errors."""
    return figure, table, caption


if __name__ == "__main__":
    pure = dict.fromkeys(("error", "points"), "1")
    main(draw, "Accuracy against time", cpu_seconds="second", **pure)
