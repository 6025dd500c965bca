"""Convergence of the kinetic solver: error of the currents against the number of momentum points."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.convergence import CURRENTS, distance_from_finest, draw_errors
from workflow.lib.figure import run
from workflow.lib.load import Result

PAPER_POINTS = 4200


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
