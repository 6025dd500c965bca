"""Convergence of the kinetic solver: error of the currents against the number of momentum points."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.scripts import style
from workflow.scripts.figure import run
from workflow.scripts.load import Result

PAPER_POINTS = 4200
CURRENTS = ("particle_current", "energy_current", "momentum_flux")


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run: points, the program's own estimate, and the distance from the finest run."""
    rows = []
    for result in results:
        row = {"gamma": result.parameters["gamma"], "points": int(result["momentum_points"].mean)}
        row["estimate"] = result.provenance["achieved_error"]
        rows.append(row | {name: float(result[name].mean) for name in CURRENTS})
    table = pd.DataFrame(rows).drop_duplicates(["gamma", "points"]).sort_values(["gamma", "points"])
    for gamma, part in table.groupby("gamma"):
        finest = part.iloc[-1]
        distance = sum(np.abs(part[name] / finest[name] - 1) for name in CURRENTS)
        table.loc[table.gamma == gamma, "distance"] = distance
    return table


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    table = tabulate(results)
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    looks = [("o", style.BLUE), ("s", style.VERMILLION)]
    for (gamma, part), (marker, color) in zip(table.groupby("gamma"), looks, strict=True):
        label = rf"$\gamma = {gamma:g}$"
        axes.plot(part.points, part.estimate, color=color, label=f"{label}, estimate")
        seen = part[part.distance > 0]
        axes.plot(
            seen.points,
            seen.distance,
            color=color,
            marker=marker,
            linestyle="none",
            label=f"{label}, distance",
        )
    axes.axvline(PAPER_POINTS, **style.GUIDE)
    axes.text(PAPER_POINTS, 1e-8, "points in the paper ", rotation=90, ha="right", va="center", size=7)
    axes.set(xscale="log", yscale="log", xlabel="points in momentum", ylabel="relative error of the currents")
    axes.set_xlim(right=1.3 * PAPER_POINTS)
    axes.legend(loc="upper center", fontsize=7)
    return figure, table


if __name__ == "__main__":
    run(draw, "Convergence of the kinetic solver")
