"""What each method saves: the ratio of error^2 x CPU seconds without it and with it.

The plain estimate is that of the reference simulator or, where a program stores both, of the same run without the method.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from workflow.lib.configuration import at_size
from workflow.lib.plan import Run
from workflow.tradeoff.measure import Done, execute, planned, simulate

FRACTION = 1 / 8  # of the observation time of the panels: the reference simulator is slow
PULSE_REPLICAS = (50, 60)  # of the reference simulator and of the program

Row = dict[str, object]


@dataclass(frozen=True)
class Estimate:
    value: np.ndarray
    error: np.ndarray
    seconds: float
    replicas: int

    @classmethod
    def of(cls, done: Done, name: str, index: tuple[object, ...] = ()) -> "Estimate":
        found = done.result[name]
        return cls(found.mean[index], found.error[index], done.seconds, int(found.replicas.max()))

    @classmethod
    def of_sample(cls, sample: np.ndarray, seconds: float) -> "Estimate":
        """Mean over replicas, the first dimension."""
        return cls(sample.mean(axis=0), sample.std(axis=0, ddof=1) / len(sample) ** 0.5, seconds, len(sample))


def jackknife(statistic: Callable[[np.ndarray], float], rows: np.ndarray) -> tuple[float, float]:
    """Value and standard error of a function of the mean row."""
    rest = (rows.sum(axis=0) - rows) / (len(rows) - 1)
    left_out = np.array([statistic(row) for row in rest])
    return statistic(rows.mean(axis=0)), float(np.sqrt((len(rows) - 1) * np.var(left_out)))


def compared(method: str, quantity: str, plain: Estimate, better: Estimate) -> Row:
    """Factor: median over the values, with its error from the numbers of replicas. z: largest difference in units of
    the combined error."""
    known = (plain.error > 0) & (better.error > 0)
    ratios = plain.error**2 * plain.seconds / np.where(known, better.error**2 * better.seconds, np.nan)
    factor = float(np.nanmedian(ratios))
    relative = np.sqrt(2 / (plain.replicas - 1) + 2 / (better.replicas - 1))
    z = np.abs(plain.value - better.value)[known] / np.hypot(plain.error, better.error)[known]
    row = {"method": method, "quantity": quantity, "factor": factor, "factor_error": factor * relative}
    return row | {"z": float(z.max()), "values": int(known.sum())}


def conductivity(run: Run, cells: int, replicas: tuple[int, int]) -> Iterator[Row]:
    """Reference simulator and program, with the given replicas of each, from an empty start."""
    options = run.options
    relaxation = at_size(options["relaxation-time"], cells)
    observation = FRACTION * at_size(options["observation-time"], cells)
    done = execute(run, cells=cells, start="empty", replicas=replicas[1], relaxation_time=relaxation,
                   observation_time=observation)  # fmt: skip
    baths = [options[f"{name}-{side}"] for name in ("nu", "temperature") for side in ("left", "right")]
    gamma = cells if options["gamma"] == "N" else options["gamma"]
    bins, seed = (2, 1), 1  # the smallest histogram: bins, largest momentum
    lines, seconds = simulate("open_chain", cells, 1 / cells, options["sigma"], gamma, *baths, relaxation,
                              observation, *bins, replicas[0], seed)  # fmt: skip
    rows = np.array(lines, dtype=float)
    # Temperatures of the scatterers begin a row; behind four more values per cell and the particle currents of all
    # bonds there are the energy currents.
    first, last = rows[:, 0], rows[:, cells - 1]
    current = rows[:, [6 * cells + 1, 7 * cells + 1]].mean(axis=1)
    kappa, error = jackknife(lambda row: -row[0] * cells / (row[2] - row[1]),
                             np.stack([current, first, last], axis=1))  # fmt: skip
    plain = {
        "kappa": Estimate(np.array(kappa), np.array(error), seconds, len(rows)),
        "energy_current": Estimate.of_sample(current, seconds),
    }
    for name, reference in plain.items():
        label = f"{name}, N = {cells}, gamma = {options['gamma']}"
        engine, controlled = Estimate.of(done, f"{name}_plain"), Estimate.of(done, name)
        yield compared("engine", label, reference, engine)
        yield compared("control variates", label, engine, controlled)
        yield compared("both", label, reference, controlled)


def spreading(panel: str, name: str, label: str) -> Iterator[Row]:
    """<x^2> at the last time from one tagged particle, from all, and with the total momentum as control variate."""
    done = execute(planned(panel, name), replicas=50)
    every, controlled = (Estimate.of(done, quantity, (-1,)) for quantity in ("variance_plain", "variance"))
    spread = np.sqrt(done.result["fourth_moment"].mean[-1] - controlled.value**2)
    one = replace(every, error=spread / np.sqrt(every.replicas))
    yield compared("all particles", f"<x^2>, {label}", one, every)
    yield compared("known total momentum", f"<x^2>, {label}", every, controlled)


def pulse(run: Run) -> Iterator[Row]:
    """Energies in the cells that the pulse has reached, at the first time and the last."""
    slow, fast = PULSE_REPLICAS
    options, times = run.options, run.options["times"].split(",")
    gamma = options["cells"] if options["gamma"] == "N" else options["gamma"]
    names = ("energy", "pulse-energy", "pairs-per-replica")
    words = [
        options["cells"],
        options["particles-per-cell"],
        options["sigma"],
        gamma,
        *map(options.get, names),
    ]
    samples = {}
    for start in ("independent", "shared"):
        lines, seconds = simulate("pulse", *words, slow, 1, start, *times)
        samples[start] = np.array(lines, dtype=float).reshape(slow, len(times), -1), seconds
    shared, seconds = samples["shared"]
    samples["folded"] = (shared + shared[:, :, ::-1]) / 2, seconds
    done, separate = execute(run, replicas=fast), execute(run, replicas=fast, separate=True)
    found = done.result["energy_difference"]
    for k, time in ((0, "first"), (-1, "last")):
        label, reached = f"energies, {time} time", found.mean[k] > 5 * found.error[k]
        two_starts, one_start, both_sides = (Estimate.of_sample(sample[:, k, reached], seconds)
                                             for sample, seconds in samples.values())  # fmt: skip
        best = Estimate.of(done, "energy_difference", (k, reached))
        yield compared("one start for both", label, two_starts, one_start)
        yield compared("both sides", label, one_start, both_sides)
        yield compared("twice only where they differ", label, replace(best, seconds=separate.seconds), best)
        yield compared("engine", label, one_start, best)
        yield compared("all of these", label, two_starts, best)


def measure() -> pd.DataFrame:
    rows = [*conductivity(planned("fig08", "deterministic_cells=4"), 256, (32, 100))]
    rows += conductivity(planned("fig08", "rare_cells=32"), 64, (32, 100))
    rows += spreading("fig07_inset", "all_sigma=0.45", "random total momentum")
    rows += spreading("ext07", "spreading_relaxation-time=10", "no total momentum")
    return pd.DataFrame([*rows, *pulse(planned("fig09a", "gaussian"))])
