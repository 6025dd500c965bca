"""Speed against accuracy of the kinetic solver: error of the currents against CPU seconds.

Its products hold measured times, so they change from run to run and do not belong to `make figures`.
"""

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.scripts import style
from workflow.scripts.fig03_convergence import CURRENTS
from workflow.scripts.load import load

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


def measure(program: Path) -> pd.DataFrame:
    """One row per gamma and resolution reached; `error` is the distance from the finest."""
    with tempfile.TemporaryDirectory() as folder:
        rows = [solve(program, gamma, target, Path(folder)) for gamma in GAMMAS for target in TARGETS]
    table = pd.DataFrame(rows).drop_duplicates(["gamma", "points"])
    finest = table.groupby("gamma")[list(CURRENTS)].transform("last")
    table["error"] = (table[list(CURRENTS)] / finest - 1).abs().max(axis=1)
    return table


def draw(table: pd.DataFrame) -> Figure:
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    looks = [("o", style.BLUE), ("s", style.VERMILLION)]
    for (gamma, part), (marker, color) in zip(table.groupby("gamma"), looks, strict=True):
        label = rf"$\gamma = {gamma}$"
        axes.plot(part.cpu_seconds, part.estimate, color=color, label=f"{label}, estimate")
        seen = part[part.error > 0]
        axes.plot(
            seen.cpu_seconds, seen.error, marker, color=color, label=f"{label}, distance from the finest"
        )
    axes.set(xscale="log", yscale="log", xlabel="CPU seconds", ylabel="relative error of the currents")
    style.label_within_decades(axes.xaxis)
    axes.legend(loc="upper right", fontsize=7)
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", type=Path, required=True, help="the executable boltzmann")
    parser.add_argument("--output", type=Path, required=True, help="path of the figure without suffix")
    options = parser.parse_args()
    style.apply()
    table = measure(options.program)
    options.output.parent.mkdir(parents=True, exist_ok=True)
    table.to_csv(options.output.with_suffix(".csv"), index=False)
    for kind in ("pdf", "png"):
        draw(table).savefig(options.output.with_suffix(f".{kind}"))
    print(table[["gamma", "points", "cpu_seconds", "estimate", "error"]].to_string(index=False))


if __name__ == "__main__":
    main()
