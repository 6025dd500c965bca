"""Gain of each method: the ratio of error^2 x CPU seconds without it and with it.

The engine is compared with the reference simulator, control variates with the plain estimate of the same run.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from workflow.plan import Run
from workflow.tradeoff.measure import Done, execute, planned, simulate

Row = dict[str, object]


class Estimate(NamedTuple):
    value: np.ndarray
    error: np.ndarray
    replicas: int
    seconds: float


def stored(done: Done, name: str, index: Any = ()) -> Estimate:
    quantity = done.result[name]
    return Estimate(quantity.mean[index], quantity.error[index], int(quantity.replicas.max()), done.seconds)


def averaged(sample: np.ndarray, seconds: float) -> Estimate:
    """Mean over replicas (the first dimension)."""
    error = sample.std(axis=0, ddof=1) / np.sqrt(len(sample))
    return Estimate(sample.mean(axis=0), error, len(sample), seconds)


def compared(method: str, quantity: str, plain: Estimate, better: Estimate) -> Row:
    """factor: median gain over the values, with its error from the numbers of replicas. z: largest difference in combined
    errors."""
    usable = (plain.error > 0) & (better.error > 0)
    factor = np.median((plain.error[usable] / better.error[usable]) ** 2) * plain.seconds / better.seconds
    relative = np.sqrt(2 / (plain.replicas - 1) + 2 / (better.replicas - 1))
    z = np.abs(plain.value - better.value)[usable] / np.hypot(plain.error, better.error)[usable]
    row = {"method": method, "quantity": quantity, "factor": factor, "factor_error": factor * relative}
    return row | {"z": z.max(), "values": len(z)}


def conductivity(
    run: Run, cells: int, times: tuple[float, float], replicas: tuple[int, int]
) -> Iterator[Row]:
    """Gains for the conductivity, from an empty start. times: relaxation, and a short window, as the reference simulator is slow;
    replicas: of the reference simulator and of the program."""
    options, label = run.options, f"N = {cells}, gamma = {run.options['gamma']}"
    relaxation, observation = times
    changes = {"start": "empty", "relaxation-time": relaxation, "observation-time": observation}
    done = execute(run, cells=cells, replicas=replicas[1], **changes)
    gamma = cells if options["gamma"] == "N" else options["gamma"]
    baths = {name: options[name] for name in ("nu-left", "nu-right", "temperature-left", "temperature-right")}
    chain = {"cells": cells, "cell_length": 1 / cells, "sigma": options["sigma"], "gamma": gamma, **baths}
    durations = {"relaxation_time": relaxation, "observation_time": observation}
    effort = {"momentum_bins": 2, "momentum_max": 1, "replicas": replicas[0], "seed": 1}  # bins are not used
    rows, seconds = simulate("open_chain", **chain, **durations, **effort)
    # Five values per cell and the particle currents of N + 1 bonds precede the energy currents.
    plain = averaged(rows.astype(float)[:, [6 * cells + 1, 7 * cells + 1]].mean(axis=1), seconds)
    engine, both = stored(done, "energy_current_plain"), stored(done, "energy_current")
    yield compared("engine", f"energy_current, {label}", plain, engine)
    yield compared("control variates", f"energy_current, {label}", engine, both)
    yield compared("both", f"energy_current, {label}", plain, both)
    yield compared("control variates", f"kappa, {label}", stored(done, "kappa_plain"), stored(done, "kappa"))


def spreading(panel: str, name: str, label: str) -> Iterator[Row]:
    """Gains for <x^2> at the last time: all particles against one, and the total momentum as control variate."""
    done = execute(planned(panel, name), replicas=50)
    every, controlled = stored(done, "variance_plain", -1), stored(done, "variance", -1)
    spread = np.sqrt(done.result["fourth_moment"].mean[-1] - controlled.value**2)
    yield compared("all particles", label, every._replace(error=spread / np.sqrt(every.replicas)), every)
    yield compared("known total momentum", label, every, controlled)


def pulse(run: Run, replicas: tuple[int, int]) -> Iterator[Row]:
    """Gains for the energies at the last time in the cells that the pulse has reached; gamma = N."""
    names = ("cells", "particles-per-cell", "sigma", "energy", "pulse-energy", "pairs-per-replica", "times")
    options = {name: run.options[name] for name in names} | {"gamma": run.options["cells"]}
    done = execute(run, replicas=replicas[1])
    last = stored(done, "energy_difference", -1)
    reached = last.value > 5 * last.error
    engine, plain = stored(done, "energy_difference", (-1, reached)), []
    for start in ("independent", "shared"):
        rows, seconds = simulate("pulse", **options, start=start, replicas=replicas[0], seed=1)
        last_energies = rows.astype(float)[:, -options["cells"] :]
        plain.append(averaged(last_energies[:, reached], seconds))
    yield compared("one start for both", "energies", *plain)
    yield compared("engine", "energies", plain[1], engine)
    yield compared("both", "energies", plain[0], engine)


def measure() -> pd.DataFrame:
    rows = [*conductivity(planned("fig08", "deterministic_cells=4"), 256, (12.8, 25), (32, 100))]
    rows += conductivity(planned("fig08", "rare_cells=32"), 64, (3.2, 80), (32, 100))
    rows += spreading("fig07_inset", "all_sigma=0.45", "<x^2>, random total momentum")
    rows += spreading("ext07", "spreading_relaxation-time=10", "<x^2>, no total momentum")
    return pd.DataFrame([*rows, *pulse(planned("fig09a", "gaussian"), (50, 60))])
