"""Error against CPU seconds of every sampling program, and how well the cost of a target error is predicted."""

import re

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.plan import Run
from workflow.tradeoff.measure import execute, planned, shortened

REPLICAS = (10, 32, 110, 360, 1300)
FIRST_LOOK, BATCH = (
    64,
    16,
)  # replicas before a program first compares its error with the target; added per batch
REDUCTION = 4  # the target, as a fraction of the error at the first look, is its inverse
PREDICTION = re.compile(r"the run ends after (\d+) to (\d+)")  # replicas, in the log of a program
SETTINGS = {  # a cheap run of every program, and the fraction of its times that is simulated
    "persistence": ("fig05", "paper_sigma=0.5", 0.5),
    "waiting_time": ("fig06", "all_sigma=0.5", 0.5),
    "displacement": ("ext07", "spreading_relaxation-time=1", 0.5),
    "ageing": ("ext07", "energy", 0.01),
    "energy_pulse": ("fig09a", "gaussian", 1),
    "conductivity": ("fig08", "deterministic_cells=4", 0.1),
    "momentum_flux": ("fig04a", "rare", 0.1),
    "steady_profile": ("fig02_upper", "rare", 0.1),
    "particle_count": ("fig01", "short", 0.005),
}
UNITS = {"cpu_seconds": "second", "mean": "column units"}
PREDICTION_UNITS = dict.fromkeys(("seconds_least", "seconds_most", "seconds"), "second")


def short_run(program: str) -> Run:
    panel, name, fraction = SETTINGS[program]
    run = planned(panel, name)
    times = [key for key in ("relaxation-time", "observation-time", "times") if key in run.options]
    changes = {key: shortened(run.options[key], fraction) for key in times}
    pairs = {"pairs-per-replica": 2} if "pairs-per-replica" in run.options else {}
    return Run(name, program, run.options | changes | pairs)


def amplitude(seconds: np.ndarray, errors: np.ndarray, replicas: np.ndarray) -> float:
    """Error after one second by the law 1/sqrt(t): mean of ln(error sqrt(t)), weighted by its precision."""
    return float(np.exp(np.average(np.log(errors * np.sqrt(seconds)), weights=replicas - 1)))


def uncertainty(errors: np.ndarray, replicas: np.ndarray) -> np.ndarray:
    """Standard deviation of a standard error that was estimated from a number of replicas."""
    deviation: np.ndarray = errors / np.sqrt(2 * (replicas - 1))
    return deviation


def sampled(program: str) -> pd.DataFrame:
    """A row per number of replicas; errors are relative to the most precise mean."""
    rows = []
    for replicas in REPLICAS:
        done = execute(short_run(program), replicas=replicas)
        name = done.result.provenance["target_quantity"]
        found = done.result[name]
        rows.append(
            (program, name, replicas, done.seconds, float(found.mean), float(found.error), found.units)
        )
    columns = ["program", "quantity", "replicas", "cpu_seconds", "mean", "error", "units"]
    table = pd.DataFrame(rows, columns=columns)
    table["error"] /= abs(table["mean"].iloc[-1])
    table["uncertainty"] = uncertainty(table.error, table.replicas)
    return table.dropna()  # few replicas may not suffice for an error


def measure() -> pd.DataFrame:
    return pd.concat([sampled(program) for program in SETTINGS], ignore_index=True)


def draw_program(axes: Axes, table: pd.DataFrame) -> None:
    law = amplitude(*(table[name].to_numpy() for name in ("cpu_seconds", "error", "replicas")))
    axes.errorbar(
        table.cpu_seconds, table.error, table.uncertainty, fmt="o", color=style.BLUE, **style.POINTS
    )
    axes.plot(table.cpu_seconds, law / np.sqrt(table.cpu_seconds), **style.GUIDE)
    axes.text(0.95, 0.93, f"1 s: {100 * law:.2g} %", transform=axes.transAxes, size=7, ha="right", va="top")
    axes.set(xscale="log", yscale="log", ylim=(2e-5, 0.5))
    axes.set_title(f"{table.program.iloc[0]}:\n{table.quantity.iloc[0]}", size=8)
    axes.minorticks_off()


def draw(table: pd.DataFrame) -> Figure:
    size = (2 * style.COLUMN, 2 * style.HEIGHT)
    figure, axes = plt.subplots(3, 3, figsize=size, sharex=True, sharey=True)
    for one, (_, part) in zip(axes.flat, table.groupby("program", sort=False), strict=True):
        draw_program(one, part)
    figure.supxlabel("CPU seconds", size=9)
    figure.supylabel("relative error", size=9)
    return figure


def predicted(program: str) -> dict[str, object]:
    """Replicas and CPU seconds by the prediction at the first look at the error, and those needed."""
    run = short_run(program)
    first = execute(run, replicas=FIRST_LOOK)
    target = first.result.provenance["achieved_error"] / REDUCTION
    whole = execute(run, replicas=BATCH, target_error=target)
    found = PREDICTION.search(whole.log)
    if not found:
        raise ValueError(f"{program} predicts no number of replicas")
    replicas = {"least": int(found[1]), "most": int(found[2])}
    row: dict[str, object] = {"program": program, "target": target}
    row |= {f"replicas_{bound}": count for bound, count in replicas.items()}
    row["replicas"] = int(whole.result[whole.result.provenance["target_quantity"]].replicas)
    row |= {f"seconds_{bound}": first.seconds * count / FIRST_LOOK for bound, count in replicas.items()}
    return row | {"seconds": whole.seconds}


def predictions() -> pd.DataFrame:
    return pd.DataFrame([predicted(program) for program in SETTINGS])
