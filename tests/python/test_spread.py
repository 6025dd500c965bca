"""Short versions of every series of the standard figures over many seeds: the spread of the target quantity agrees with its errors.
test_error_bars.py has the errors of small chains of every program."""

import numpy as np
import pytest
from scipy.stats import chi2, f

from tests.python.simulators import call, shortened
from workflow.plan import Run, load_plan

pytestmark = pytest.mark.long

SEEDS = 32
MOST_REPLICAS = 64
FIRST_TIMES = 3  # number of times of a pulse; later peaks are below the noise of one pair per replica
FACTORS = {"particle_count": 2e-3}  # factor of all times by program
OTHERS = 5e-3  # factor for the other programs
IN_PLACE = {  # options that replace those of the plan, by program
    "energy_pulse": {"pairs-per-replica": 1, "relaxation-time": 0},
    "correlation": {"cells": 101, "observation-time": 256, "times": "4,8,16"},
    "heat_current": {"cells": 20, "observation-time": 8, "times": "1,2,4", "fit-from": 1},
}


def middle_runs() -> list[Run]:
    """Of every series the run in the middle of its replicated runs. Of runs that differ in the seed alone, the first."""
    by_series: dict[str, list[Run]] = {}
    known = set()
    for panel in load_plan("standard").values():
        for run in panel.runs:
            without_seed = (panel.name, run.program, str(sorted((run.options | {"seed": 0}).items())))
            if run.replicated and without_seed not in known:
                known.add(without_seed)
                by_series.setdefault(f"{panel.name}-{run.series}", []).append(run)
    return [runs[len(runs) // 2] for runs in by_series.values()]


def in_small(run: Run) -> dict[str, object]:
    factor = FACTORS.get(run.program, OTHERS)
    times = {name: shortened(run.options[name], factor) for name in run.options if name.endswith("-time")}
    if run.program == "particle_count":
        times["times"] = shortened(run.options["times"], factor)
    if run.program == "energy_pulse":
        times["times"] = ",".join(str(run.options["times"]).split(",")[:FIRST_TIMES])
    effort = {"replicas": replicas(run), "threads": 1, "progress": "none"}
    return run.options | times | IN_PLACE.get(run.program, {}) | effort


def replicas(run: Run) -> int:
    return min(run.options["replicas"], MOST_REPLICAS)


def spread_over_error(run: Run) -> float:
    """Ratio of the variance of the means to the mean square error, of the last element of the target quantity."""
    pairs = []
    for seed in range(SEEDS):
        result = call(run.program, **in_small(run) | {"seed": 1000 + seed})
        quantity = result[result.provenance["target_quantity"]]
        pairs.append((quantity.mean.flat[-1], quantity.standard_error.flat[-1]))
    mean, error = np.array(pairs).T
    return float(mean.var(ddof=1) / np.mean(error**2))


def test_seeds_scatter_as_their_errors_predict() -> None:
    runs = middle_runs()
    ratios = np.array([spread_over_error(run) for run in runs])
    freedom = SEEDS - 1, SEEDS * (np.array([*map(replicas, runs)]) - 1)

    def outliers(factor: float) -> list[str]:
        """Two-sided F test, valid for normal records, at one false alarm in 10^4 for all runs."""
        p = np.minimum(f.sf(factor * ratios, *freedom), f.cdf(factor * ratios, *freedom))
        return [run.series for run, tail in zip(runs, p, strict=True) if tail < 1e-4 / (2 * len(runs))]

    assert outliers(1) == []
    # Detected in most series: errors that are too small by a factor of two or too large by three.
    assert min(len(outliers(2**2)), len(outliers(1 / 3**2))) > 0.8 * len(runs)

    def plausible_together(factor: float) -> bool:
        total, number = factor * (SEEDS - 1) * ratios.sum(), (SEEDS - 1) * len(runs)
        return bool(chi2.isf(1 - 5e-5, number) < total < chi2.isf(5e-5, number))

    assert plausible_together(1)
    # Detected mistakes: all errors are 15 % too small or too large.
    assert not plausible_together(1.15**2)
    assert not plausible_together(1 / 1.15**2)
