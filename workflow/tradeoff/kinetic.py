"""Speed against accuracy of the kinetic solver: error of the currents against CPU seconds.

Its products hold measured times, so they change from run to run and do not belong to `make figures`.
"""

import json
import subprocess
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.scripts import style
from workflow.scripts.fig03_convergence import CURRENTS, distance_from_finest, draw_errors
from workflow.scripts.load import load
from workflow.tradeoff import frame

GAMMAS = (1, 50)
TARGETS = (1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
REPEATS = 5  # of which the median time counts


def solve(program: Path, gamma: float, target: float, folder: Path) -> dict[str, float]:
    """Currents, the program's own estimate of their error, points in momentum, CPU seconds of the process."""
    output = folder / "out.h5"
    command = [program, "--gamma", gamma, "--target-error", target, "--coarsening", 4]
    command += ["--output", output, "--progress", "none"]
    seconds = []
    for _ in range(REPEATS):
        status = subprocess.run([str(word) for word in command], check=False).returncode
        if status not in (0, 4):  # 4: the finest resolution does not reach the target
            raise RuntimeError(f"{program} failed with status {status}")
        seconds.append(json.loads(output.with_suffix(".cost.json").read_text())["cpu_seconds"])
    result = load(output)
    row = {"gamma": gamma, "target": target, "cpu_seconds": float(np.median(seconds))}
    row |= {"estimate": result.provenance["achieved_error"], "points": int(result["momentum_points"].mean)}
    return row | {name: float(result[name].mean) for name in CURRENTS}


def measure(programs: Path) -> pd.DataFrame:
    """One row per gamma and resolution reached."""
    with tempfile.TemporaryDirectory() as folder:
        rows = [
            solve(programs / "boltzmann", gamma, target, Path(folder))
            for gamma in GAMMAS
            for target in TARGETS
        ]
    table = pd.DataFrame(rows).drop_duplicates(["gamma", "points"])
    table["distance"] = distance_from_finest(table)
    return table


def draw(table: pd.DataFrame) -> Figure:
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    draw_errors(axes, table, "cpu_seconds")
    axes.set_xlabel("CPU seconds")
    style.label_within_decades(axes.xaxis)
    axes.legend(loc="upper right", fontsize=7)
    return figure


def summary(table: pd.DataFrame) -> str:
    return table[["gamma", "points", "cpu_seconds", "estimate", "distance"]].to_string(index=False)


if __name__ == "__main__":
    frame.run(measure, __doc__, draw, summary)
