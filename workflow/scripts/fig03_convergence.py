"""Convergence of the kinetic solver: error of the currents against the number of momentum points."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.scripts import style
from workflow.scripts.figure import run
from workflow.scripts.load import Result

PAPER_POINTS = 4200
CURRENTS = ("particle_current", "energy_current", "momentum_flux")


def distance_from_finest(table: pd.DataFrame) -> pd.Series:
    """Largest relative difference of the three currents from those of the last row of the same gamma."""
    finest = table.groupby("gamma")[list(CURRENTS)].transform("last")
    return (table[list(CURRENTS)] / finest - 1).abs().max(axis=1)


def draw_errors(axes: Axes, table: pd.DataFrame, abscissa: str) -> None:
    """The program's own estimate as lines, the distance from the finest as points."""
    looks = [("o", style.BLUE), ("s", style.VERMILLION)]
    for (gamma, part), (marker, color) in zip(table.groupby("gamma"), looks, strict=True):
        label = rf"$\gamma = {gamma:g}$"
        axes.plot(part[abscissa], part.estimate, color=color, label=f"{label}, estimate")
        seen = part[part.distance > 0]
        axes.plot(
            seen[abscissa], seen.distance, marker, color=color, label=f"{label}, distance from the finest"
        )
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


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    table = tabulate(results)
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    draw_errors(axes, table, "points")
    axes.axvline(PAPER_POINTS, **style.GUIDE)
    axes.text(PAPER_POINTS, 1e-8, "points in the paper ", rotation=90, ha="right", va="center", size=7)
    axes.set(xlabel="points in momentum", xlim=(None, 1.3 * PAPER_POINTS))
    axes.legend(loc="upper center", fontsize=7)
    return figure, table


if __name__ == "__main__":
    run(draw, "Convergence of the kinetic solver", points="1", estimate="1", distance="1")
