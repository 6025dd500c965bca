"""Error against CPU seconds of every program."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.described import with_option
from workflow.tradeoff.measure import Done, execute, planned, shortened

REPLICAS = (10, 32, 110, 360, 1300)
TARGETS = (1e-2, 1e-4, 1e-6, 1e-8)  # target errors of the kinetic equation, which has no replicas
SETTINGS = {  # a cheap run of every program with an error, and the simulated fraction of its times
    "persistence": ("fig05", "paper_sigma=0.5", 0.5),
    "waiting_time": ("fig06", "all_sigma=0.5", 0.5),
    "displacement": ("ext07", "spreading_relaxation-time=1", 0.5),
    "ageing": ("ext07", "energy", 0.01),
    "energy_pulse": ("fig09a", "gaussian", 1),
    "conductivity": ("fig08", "deterministic_cells=4", 0.1),
    "momentum_flux": ("fig04a", "rare", 0.1),
    "steady_profile": ("fig02_upper", "rare", 0.1),
    "particle_count": ("fig01", "short", 0.005),
    "correlation": ("ext03", "light", 1),
    "heat_current": ("ext13", "light", 1),
    "boltzmann": ("fig03_convergence", "resolution_gamma=50_target-error=1e-05", 1),
}


def execute_briefly(program: str, **changes: object) -> Done:
    panel, name, fraction = SETTINGS[program]
    run = planned(panel, name)
    times = [key for key in ("relaxation-time", "observation-time", "times") if key in run.options]
    options: dict[str, object] = {key: shortened(run.options[key], fraction) for key in times}
    if "pairs-per-replica" in run.options:
        options["pairs-per-replica"] = 2
    return execute(run, **options, **changes)


def amplitude(seconds: np.ndarray, errors: np.ndarray, replicas: np.ndarray) -> float:
    """Error after one second, from the precision-weighted mean of ln(error sqrt(t))."""
    return float(np.exp(np.average(np.log(errors * np.sqrt(seconds)), weights=replicas - 1)))


def uncertainty(errors: np.ndarray, replicas: np.ndarray) -> np.ndarray:
    """Standard deviation of a standard error that is estimated from replicas."""
    return errors / np.sqrt(2 * (replicas - 1))


def errors(program: str) -> pd.DataFrame:
    """Relative errors of the target quantity, per number of replicas or per target error."""
    option, values = ("target-error", TARGETS) if program == "boltzmann" else ("replicas", REPLICAS)
    rows = []
    for value in values:
        done = execute_briefly(program, **{option: value})
        provenance = done.result.provenance
        row = {"program": program, "quantity": provenance["target_quantity"], option: value}
        rows.append(row | {"cpu_seconds": done.seconds, "error": provenance["achieved_error"]})
    return pd.DataFrame(rows).dropna()  # drops rows without an error, which too few replicas give


def measure() -> pd.DataFrame:
    table = pd.concat(map(errors, with_option("target-error")), ignore_index=True)
    return table.assign(uncertainty=uncertainty(table.error, table.replicas))


def draw(table: pd.DataFrame) -> Figure:
    sampled = table.dropna(subset="replicas").groupby(["program", "quantity"], sort=False)
    size = (2 * style.COLUMN, 8 / 3 * style.HEIGHT)
    figure, axes = plt.subplots(-(-len(sampled) // 3), 3, figsize=size, sharex=True, sharey=True)
    for empty in axes.flat[len(sampled) :]:
        empty.set_axis_off()
    for panel, ((program, quantity), rows) in zip(axes.flat, sampled, strict=False):
        seconds, error, replicas = rows[["cpu_seconds", "error", "replicas"]].to_numpy().T
        law = amplitude(seconds, error, replicas)
        panel.errorbar(seconds, error, rows.uncertainty, marker="o", color=style.BLUE, **style.POINTS)
        panel.plot(seconds, law / np.sqrt(seconds), **style.GUIDE)
        panel.set(xscale="log", yscale="log", title=f"{program}: {quantity}\n{100 * law:.2g} % in 1 s")
    figure.supxlabel("CPU seconds", size=9)
    figure.supylabel("relative error", size=9)
    return figure
