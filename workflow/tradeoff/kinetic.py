"""Speed against accuracy of the kinetic solver: error of the currents against CPU seconds.

Its products hold measured times, so they change from run to run and do not belong to `make figures`.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.convergence import CURRENTS, distance_from_finest, draw_errors
from workflow.tradeoff import frame
from workflow.tradeoff.measure import call

GAMMAS = (1, 50)
TARGETS = (1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
UNITS = dict.fromkeys(("gamma", "target", "estimate", "points", "distance"), "1")
UNITS |= {"cpu_seconds": "second", "particle_current": "1/time", "energy_current": "energy/time"}
UNITS |= {"momentum_flux": "momentum/time"}
REPEATS = 5  # of which the median time counts


def solve(programs: Path, gamma: float, target: float) -> dict[str, float]:
    """Currents, the program's own estimate of their error, points in momentum, CPU seconds of the process."""
    options = {"gamma": gamma, "target_error": target, "coarsening": 4, "progress": "none"}
    done = [call(programs / "boltzmann", **options) for _ in range(REPEATS)]
    result = done[0].result
    row = {"gamma": gamma, "target": target, "cpu_seconds": float(np.median([one.seconds for one in done]))}
    row |= {"estimate": result.provenance["achieved_error"], "points": int(result["momentum_points"].mean)}
    return row | {name: float(result[name].mean) for name in CURRENTS}


def measure(programs: Path) -> pd.DataFrame:
    """One row per gamma and resolution reached."""
    rows = [solve(programs, gamma, target) for gamma in GAMMAS for target in TARGETS]
    table = pd.DataFrame(rows).drop_duplicates(["gamma", "points"])
    table["distance"] = distance_from_finest(table)
    return table


def draw(table: pd.DataFrame) -> Figure:
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    draw_errors(axes, table, "cpu_seconds")
    axes.set_xlabel("CPU seconds")
    style.label_within_decades(axes.xaxis)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=2, fontsize=6.5)
    return figure


def summary(table: pd.DataFrame) -> str:
    return frame.whole(table[["gamma", "points", "cpu_seconds", "estimate", "distance"]])


if __name__ == "__main__":
    frame.run(measure, __doc__, UNITS, draw, summary)
