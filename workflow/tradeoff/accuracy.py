"""What a second buys: error of every program's target quantity against CPU seconds on one core.

Its products hold measured times, so they change from run to run and do not belong to `make figures`.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.plan import Run
from workflow.tradeoff import frame
from workflow.tradeoff.measure import execute, planned, shortened

REPLICAS = (10, 32, 110, 360, 1300)
PAIRS = 2  # of a replica of the pulse
TARGETS = (1e-2, 1e-4, 1e-6, 1e-8)  # of what is computed, not sampled
# A cheap run of every program, and the part of its window that is watched here.
SETTINGS = {
    "persistence": ("fig05", "paper_sigma=0.5", 0.5),
    "waiting_time": ("fig06", "all_sigma=0.5", 0.5),
    "displacement": ("ext07", "spreading_relaxation-time=1", 0.5),
    "ageing": ("ext07", "energy", 0.01),
    "energy_pulse": ("fig09a", "gaussian", 1),
    "conductivity": ("fig08", "deterministic_cells=4", 0.1),
    "momentum_flux": ("fig04a", "rare", 0.1),
    "steady_profile": ("fig02_upper", "rare", 0.1),
    "particle_count": ("fig01", "short", 0.005),
    "boltzmann": ("fig03_convergence", "resolution_gamma=50_target-error=1e-05", 1),
}
NAMES = {
    "mu": r"$\mu$",
    "exponent": r"exponent of $\Psi(\tau)$",
    "alpha": r"exponent of $\langle x^2\rangle$",
    "log_slope": r"slope against $\ln t$",
    "damping_exponent": "exponent of damping",
    "kappa": r"$\kappa(N)$",
    "crossings": "crossings of a bond",
    "energy_current_mean": "$J_U$",
    "currents": "currents",
}
UNITS = {"cpu_seconds": "second", "mean": "column units"}
UNITS |= dict.fromkeys(("replicas", "error", "uncertainty"), "1")
ERRORS = (2e-5, 0.5)  # one axis for all that is sampled


def amplitude(seconds: np.ndarray, errors: np.ndarray, replicas: np.ndarray) -> float:
    """Error after one second by the law 1/sqrt(t): mean of ln(error sqrt(t)), weighted by its precision."""
    return float(np.exp(np.average(np.log(errors * np.sqrt(seconds)), weights=replicas - 1)))


def uncertainty(errors: np.ndarray, replicas: np.ndarray) -> np.ndarray:
    """Standard deviation of a standard error that was estimated from so many replicas."""
    deviation: np.ndarray = errors / np.sqrt(2 * (replicas - 1))
    return deviation


def window(run: Run, share: float) -> dict[str, object]:
    """Options that shorten a run: a part of its times, the smallest replicas."""
    times = ("relaxation-time", "observation-time", "times")
    changes = {key: shortened(run.options[key], share) for key in times if key in run.options}
    return changes | ({"pairs-per-replica": PAIRS} if "pairs-per-replica" in run.options else {})


def sample(programs: Path, program: str) -> pd.DataFrame:
    """One row per number of replicas; errors relative to the most precise mean."""
    panel, name, share = SETTINGS[program]
    run = planned(panel, name)
    changes = window(run, share)
    rows = []
    for replicas in REPLICAS:
        result, seconds = execute(programs, run, **changes, replicas=replicas)
        target = result.provenance["target_quantity"]
        found = result[target]
        rows.append((program, target, replicas, seconds, found.mean, found.error, found.units))
    columns = ["program", "quantity", "replicas", "cpu_seconds", "mean", "error", "units"]
    table = pd.DataFrame(rows, columns=columns)
    table["error"] = (table.error / abs(table["mean"].iloc[-1])).astype(float)
    table["uncertainty"] = uncertainty(table.error, table.replicas)
    return table.dropna()  # too few replicas may leave no error


def solve(programs: Path) -> pd.DataFrame:
    """The kinetic equation: error by the program's own estimate, against the resolution that it needs."""
    panel, name, _ = SETTINGS["boltzmann"]
    rows = []
    for target in TARGETS:
        result, seconds = execute(programs, planned(panel, name), target_error=target)
        rows.append(("boltzmann", "currents", seconds, result.provenance["achieved_error"], "1"))
    return pd.DataFrame(rows, columns=["program", "quantity", "cpu_seconds", "error", "units"])


def draw_program(axes: Axes, table: pd.DataFrame) -> None:
    axes.errorbar(
        table.cpu_seconds, table.error, table.uncertainty, marker="o", color=style.BLUE, **style.POINTS
    )
    axes.set(xscale="log", yscale="log")
    axes.set_title(f"{table.program.iloc[0]}:\n{NAMES[table.quantity.iloc[0]]}", size=8)
    axes.minorticks_off()
    if table.replicas.notna().all():
        law = amplitude(*(table[name].to_numpy() for name in ("cpu_seconds", "error", "replicas")))
        axes.plot(table.cpu_seconds, law / np.sqrt(table.cpu_seconds), **style.GUIDE)
        axes.text(
            0.95, 0.93, f"1 s: {100 * law:.2g} %", transform=axes.transAxes, size=7, ha="right", va="top"
        )
        axes.set_ylim(*ERRORS)


def draw(table: pd.DataFrame) -> Figure:
    figure, axes = plt.subplots(2, 5, figsize=(2.1 * style.COLUMN, 1.3 * style.HEIGHT), sharex=True)
    for one, program in zip(axes.flat, SETTINGS, strict=True):
        draw_program(one, table[table.program == program])
    for one in (*axes[0, 1:], *axes[1, 1:-1]):
        one.tick_params(labelleft=False)
    figure.supxlabel("CPU seconds", size=9)
    figure.supylabel("relative error", size=9)
    return figure


def measure(programs: Path) -> pd.DataFrame:
    sampled = [sample(programs, program) for program in SETTINGS if program != "boltzmann"]
    return pd.concat([*sampled, solve(programs)], ignore_index=True)


if __name__ == "__main__":
    frame.run(measure, __doc__, UNITS, draw)
