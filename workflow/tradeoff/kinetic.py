"""Error of the currents of the kinetic equation against CPU seconds."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.convergence import CURRENTS, distance_from_finest, draw_errors
from workflow.tradeoff.measure import call

GAMMAS = (1, 50)
TARGETS = (1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
REPEATS = 5  # the median time counts
UNITS = {"cpu_seconds": "second", "particle_current": "1/time", "energy_current": "energy/time"}
UNITS |= {"momentum_flux": "momentum/time"}


def solve(gamma: float, target: float) -> dict[str, float]:
    """Currents, the program's estimate of their relative error, nodes in momentum, CPU seconds."""
    done = [call("boltzmann", gamma=gamma, target_error=target, coarsening=4, progress="none")
            for _ in range(REPEATS)]  # fmt: skip
    result = done[0].result
    row = {"gamma": gamma, "target": target, "cpu_seconds": float(np.median([one.seconds for one in done]))}
    row |= {"estimate": result.provenance["achieved_error"], "points": int(result["momentum_points"].mean)}
    return row | {name: float(result[name].mean) for name in CURRENTS}


def measure() -> pd.DataFrame:
    """A row per gamma and resolution."""
    rows = [solve(gamma, target) for gamma in GAMMAS for target in TARGETS]
    table = pd.DataFrame(rows).drop_duplicates(["gamma", "points"])
    return table.assign(distance=distance_from_finest(table))


def draw(table: pd.DataFrame) -> Figure:
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    draw_errors(axes, table, "cpu_seconds")
    axes.set_xlabel("CPU seconds")
    style.label_within_decades(axes.xaxis)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=2, fontsize=6.5)
    return figure
