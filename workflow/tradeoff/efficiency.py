"""What each device saves: error^2 x CPU seconds with it and without, and whether both find the same.

The plain estimator is that of the reference simulator or, where a program stores both, the one without the
device in the same run. Its products hold measured times, so they do not belong to `make figures`.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from workflow.lib.configuration import at_size
from workflow.lib.load import Result
from workflow.lib.plan import Run
from workflow.tradeoff import frame, reference
from workflow.tradeoff.measure import execute, planned, shortened

SHARE = 1 / 8  # of the panels' windows: the reference simulator is slow
UNITS = dict.fromkeys(("factor", "factor_error", "z", "values"), "1") | {
    f"{kind}_{name}": units
    for kind in ("plain", "better")
    for name, units in (("value", "column units"), ("error", "column units"), ("seconds", "second"))
}


@dataclass(frozen=True)
class Estimate:
    """A number or an array, its standard error, CPU seconds, replicas, and units of the first two."""

    value: np.ndarray
    error: np.ndarray
    seconds: float
    replicas: int
    units: str

    @classmethod
    def of(cls, result: Result, name: str, seconds: float) -> "Estimate":
        quantity = result[name]
        return cls(quantity.mean, quantity.error, seconds, int(np.max(quantity.replicas)), quantity.units)


def jackknife(statistic: Callable[[np.ndarray], float], rows: np.ndarray) -> tuple[float, float]:
    """Value and standard error of a function of the mean row."""
    rest = (rows.sum(axis=0) - rows) / (len(rows) - 1)
    left_out = np.array([statistic(row) for row in rest])
    return statistic(rows.mean(axis=0)), float(np.sqrt((len(rows) - 1) * np.var(left_out)))


def of_sample(sample: np.ndarray, seconds: float, units: str) -> Estimate:
    """Mean over replicas, the first dimension."""
    error = sample.std(axis=0, ddof=1) / np.sqrt(len(sample))
    return Estimate(sample.mean(axis=0), error, seconds, len(sample), units)


def compared(device: str, quantity: str, plain: Estimate, better: Estimate) -> dict[str, object]:
    """Factor: median, over the values, of the ratio of error^2 x CPU seconds, with its own error from the
    numbers of replicas. z: largest difference in units of the combined error."""
    merits = [one.error**2 * one.seconds for one in (plain, better)]
    seen = (plain.error > 0) & (better.error > 0)
    factor = float(np.median((merits[0] / merits[1])[seen]))
    relative = np.sqrt(sum(2 / (one.replicas - 1) for one in (plain, better)))
    z = np.abs(plain.value - better.value)[seen] / np.hypot(plain.error, better.error)[seen]
    row = {"device": device, "quantity": quantity, "factor": factor, "factor_error": factor * relative}
    row |= {"z": float(np.max(z)), "values": int(np.sum(seen)), "units": plain.units}
    for name, one in (("plain", plain), ("better", better)):
        row |= {f"{name}_value": float(one.value) if one.value.ndim == 0 else np.nan}
        row |= {f"{name}_error": float(np.median(one.error[seen])), f"{name}_seconds": one.seconds}
    return row


def conductivity(programs: Path, run: Run, cells: int, replicas: tuple[int, int]) -> Iterator[dict[str, Any]]:
    """Engine and reference simulator, both from an empty start, with so many cells."""
    times = [shortened(run.options[name], SHARE if name.startswith("obs") else 1)
             for name in ("relaxation-time", "observation-time")]  # fmt: skip
    relaxation, observation = (str(at_size(time, cells)) for time in times)
    sample, slow = reference.open_chain(programs, run.options, cells, (relaxation, observation), replicas[0])
    result, fast = execute(programs, run, cells=cells, start="empty", replicas=replicas[1],
                           relaxation_time=relaxation, observation_time=observation)  # fmt: skip
    current = sample["energy_current"][:, [0, -1]].mean(axis=1)
    rows = np.stack([current, *sample["temperature_scatterer"][:, [0, -1]].T], axis=1)
    kappa, error = (np.array(x) for x in jackknife(lambda row: -row[0] * cells / (row[2] - row[1]), rows))
    label = f"N = {cells}, gamma = {run.options['gamma']}"
    plain = {
        "kappa": Estimate(kappa, error, slow, len(rows), result["kappa"].units),
        "energy_current": of_sample(current, slow, result["energy_current"].units),
    }
    for name, estimate in plain.items():
        yield compared("engine", f"{name}, {label}", estimate, Estimate.of(result, f"{name}_plain", fast))
        yield compared("control variates", f"{name}, {label}", Estimate.of(result, f"{name}_plain", fast),
                       Estimate.of(result, name, fast))  # fmt: skip
        yield compared("both", f"{name}, {label}", estimate, Estimate.of(result, name, fast))


def spreading(programs: Path, panel: str, name: str, label: str) -> Iterator[dict[str, Any]]:
    """<x^2> from one tagged particle, from all, and with the total momentum as a control variate."""
    result, seconds = execute(programs, planned(panel, name), replicas=50)
    every, better = (
        Estimate(quantity.mean[-1], quantity.error[-1], seconds, int(quantity.replicas[-1]), quantity.units)
        for quantity in (result["variance_plain"], result["variance"])
    )
    spread = np.sqrt(result["fourth_moment"].mean[-1] - better.value**2)
    one = replace(every, error=spread / np.sqrt(every.replicas))
    yield compared("all particles, not one", f"<x^2>, {label}", one, every)
    yield compared("known total momentum", f"<x^2>, {label}", every, better)


def pulse(programs: Path) -> Iterator[dict[str, Any]]:
    """Energies in the cells that the pulse has reached, at the first time and the last."""
    run = planned("fig09a", "gaussian")
    shared, cost = reference.pulse(programs, run.options, 50, "shared")
    own, cost_of_own = reference.pulse(programs, run.options, 50, "independent")
    folded = (shared + shared[:, :, ::-1]) / 2
    result, seconds = execute(programs, run, replicas=60)
    _, twice = execute(programs, run, replicas=60, separate=True)
    quantity = result["energy_difference"]
    for k, label in ((0, "energies, first time"), (-1, "energies, last time")):
        reached = quantity.mean[k] > 5 * quantity.error[k]
        plain, one_start, both_sides = (of_sample(sample[:, k, reached], spent, quantity.units) for sample, spent in
                                        ((own, cost_of_own), (shared, cost), (folded, cost)))  # fmt: skip
        found = Estimate(quantity.mean[k][reached], quantity.error[k][reached], seconds, 60, quantity.units)
        yield compared("one start for both", label, plain, one_start)
        yield compared("both sides", label, one_start, both_sides)
        yield compared("twice only where it differs", label, replace(found, seconds=twice), found)
        yield compared("engine", label, one_start, found)
        yield compared("start, twice and engine", label, plain, found)


def measure(programs: Path) -> pd.DataFrame:
    rows = [*conductivity(programs, planned("fig08", "deterministic_cells=4"), 256, (32, 100))]
    rows += conductivity(programs, planned("fig08", "rare_cells=32"), 64, (32, 100))
    rows += spreading(programs, "fig07_inset", "all_sigma=0.45", "random total momentum")
    rows += spreading(programs, "ext07", "spreading_relaxation-time=10", "no total momentum")
    return pd.DataFrame([*rows, *pulse(programs)])


if __name__ == "__main__":
    frame.run(measure, __doc__, UNITS, show=partial(pd.DataFrame.to_string, index=False, float_format="%.3g"))
