"""Convergence of the kinetic solver: error of the currents against the number of momentum points."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import baths, listed, parameters, scientific
from workflow.lib.figure import Drawn, run
from workflow.lib.load import Result

PAPER_POINTS = 4200
CURRENTS = ("particle_current", "energy_current", "momentum_flux")


def distance_from_finest(table: pd.DataFrame) -> pd.Series:
    """Largest relative difference of the three currents from those of the last row of the same gamma."""
    finest = table.groupby("gamma")[list(CURRENTS)].transform("last")
    return (table[list(CURRENTS)] / finest - 1).abs().max(axis=1)


def draw_errors(axes: Axes, table: pd.DataFrame) -> None:
    """The program's own estimate as lines, the distance from the finest as points."""
    looks = [("o", style.BLUE, "solid"), ("s", style.VERMILLION, "dashed")]
    for (gamma, part), (marker, color, dashes) in zip(table.groupby("gamma"), looks, strict=True):
        label = rf"$\gamma = {gamma:g}$"
        axes.plot(part.points, part.estimate, color=color, linestyle=dashes, label=f"{label}, estimate")
        seen = part[part.distance > 0]
        axes.plot(seen.points, seen.distance, marker, color=color, label=f"{label}, distance from the finest")
    axes.set(xscale="log", yscale="log", ylabel="relative error of the currents")


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run: points, the program's own estimate, and the distance from the finest run."""
    rows = []
    for result in results:
        row = {"gamma": result.parameters["gamma"], "points": int(result["momentum_points"].mean)}
        row["estimate"] = result.provenance["achieved_error"]
        rows.append(row | {name: float(result[name].mean) for name in CURRENTS})
    table = pd.DataFrame(rows).drop_duplicates(["gamma", "points"]).sort_values(["gamma", "points"])
    table["distance"] = distance_from_finest(table)
    return table


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    finest = [
        f"{scientific(part.estimate.iloc[-1], 1)} with {part.points.iloc[-1]} points at γ = {gamma:g}"
        for gamma, part in table.groupby("gamma")
    ]
    return f"""
        Relative error of the kinetic solver against its number of momentum points, {parameters(results, "gamma", "sigma")},
        {baths(results[0])}: the largest of the currents of particles, energy and momentum. Lines: the solver's own estimate, from a coarser
        solution; points: distance from the finest solution of the same γ. The estimate is an upper bound, and both fall faster than a power of
        the number of points, down to {listed(finest)}. The paper uses {PAPER_POINTS} points and states no error."""


def draw(results: Sequence[Result]) -> Drawn:
    table = tabulate(results)
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    draw_errors(axes, table)
    axes.set_xticks(table.points.unique(), [f"{points}" for points in table.points.unique()])
    axes.set_xticks([], minor=True)
    axes.set(xlabel="points in momentum")
    axes.legend(loc="lower left")
    return figure, table, caption(table, results)


if __name__ == "__main__":
    run(draw, "Convergence of the kinetic solver", points="1", estimate="1", distance="1")
