"""Short versions of every series of the standard figures, with as many replicas, at most 64, over many seeds: the spread over seeds
agrees with the errors for that number of replicas. test_error_bars.py has the errors of small chains of every program."""

import numpy as np
import pytest
from scipy.stats import chi2, f

from workflow.lib.described import with_option
from workflow.plan import Run, load_plan
from workflow.tradeoff.measure import call, shortened

pytestmark = pytest.mark.long  # four minutes

SEEDS = 32
MOST_REPLICAS = 64
FIRST_TIMES = 3  # number of times of a pulse; later peaks are below the noise of one pair per replica
# Errors that are wrong by these factors are detected with this number of seeds: too small or too large for one quantity, and either for
# all quantities together.
TOO_SMALL, TOO_LARGE, TOGETHER = 2, 3, 1.15
FACTORS = {"particle_count": 2e-3}  # factor of all times by program
OTHERS = 5e-3  # factor for the other programs
IN_PLACE = {  # options that replace those of the plan, by program
    "energy_pulse": {"pairs-per-replica": 1, "relaxation-time": 0},
    "correlation": {"cells": 101, "observation-time": 256, "times": "4,8,16"},
    "heat_current": {"cells": 20, "observation-time": 8, "times": "1,2,4", "fit-from": 1},
}

# The quantities of a program on which figures and claims rely; of an array, the last element.
NUMBERS = {
    "persistence": ("mu", "particle_energy"),
    "waiting_time": ("exponent",),
    "displacement": ("variance", "alpha"),
    "ageing": ("scatterer_energy_mean", "log_slope"),
    "heat_current": ("heat_variance", "local_exponent"),
    "correlation": ("heat_correlation", "momentum_correlation", "peak"),
    "conductivity": ("energy_current", "temperature_first", "temperature_last"),
    "steady_profile": ("energy_current_mean", "density", "temperature_difference"),
    "momentum_flux": ("crossings", "square", "jump"),
    "particle_count": ("log_slope", "total_number"),
    "energy_pulse": ("injected_energy", "peak"),
}


def middle_runs() -> dict[str, Run]:
    """By panel and series: the run in the middle of the list of replicated runs. Of runs that differ in the seed alone, the first."""
    by_series: dict[str, list[Run]] = {}
    known = set()
    for panel in load_plan("standard").values():
        for run in panel.runs:
            without_seed = (panel.name, run.program, str(sorted((run.options | {"seed": 0}).items())))
            if run.replicated and without_seed not in known:
                known.add(without_seed)
                by_series.setdefault(f"{panel.name}-{run.series}", []).append(run)
    return {name: runs[len(runs) // 2] for name, runs in by_series.items()}


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


def values(run: Run) -> dict[str, np.ndarray]:
    """Every quantity of a series as an array [seed, (mean, error)]."""
    found: dict[str, list] = {name: [] for name in NUMBERS[run.program]}
    for seed in range(SEEDS):
        result = call(run.program, **in_small(run) | {"seed": 1000 + seed}).result
        for name, pairs in found.items():
            quantity = result[name]
            pairs.append((quantity.mean.flat[-1], quantity.standard_error.flat[-1]))
    return {name: np.array(pairs) for name, pairs in found.items()}


def spread_over_error(pairs: np.ndarray) -> float:
    """Ratio of the variance of the means to the mean square error."""
    mean, error = pairs.T
    return float(mean.var(ddof=1) / np.mean(error**2))


def plausible(ratio: float, replicas: int, trials: int) -> bool:
    """Two-sided F test of the ratio, valid for normal records, at one false alarm in 10^4 for all trials."""
    tail = 1e-4 / (2 * trials)
    freedom = (SEEDS - 1, SEEDS * (replicas - 1))
    return f.isf(1 - tail, *freedom) < ratio < f.isf(tail, *freedom)


Ratios = dict[
    str, tuple[float, int]
]  # spread_over_error() and the number of replicas, by quantity of a series


@pytest.fixture(scope="module")
def ratios() -> Ratios:
    return {
        f"{name} {number}": (spread_over_error(pairs), replicas(run))
        for name, run in middle_runs().items()
        for number, pairs in values(run).items()
    }


@pytest.mark.parametrize("program", with_option("replicas"))
def test_every_program_with_replicas_is_here(program: str) -> None:
    assert NUMBERS[program]
    assert program in {run.program for run in middle_runs().values()}


def test_no_error_comes_from_fewer_than_32_replicas() -> None:
    assert min(run.options["replicas"] for run in middle_runs().values()) >= 32


def test_seeds_scatter_as_their_errors_predict(ratios: Ratios) -> None:
    def outliers(factor: float) -> list[str]:
        return [
            name
            for name, (ratio, replicas) in ratios.items()
            if not plausible(factor * ratio, replicas, len(ratios))
        ]

    assert outliers(1) == []
    # Errors that are too small by a factor of two or too large by three are detected in most quantities.
    assert len(outliers(TOO_SMALL**2)) > 0.8 * len(ratios)
    assert len(outliers(1 / TOO_LARGE**2)) > 0.8 * len(ratios)


def test_errors_are_right_on_the_whole(ratios: Ratios) -> None:
    """Joint test with one quantity of every series, because quantities of one series are correlated."""
    firsts = {name.split()[0]: ratio for name, (ratio, _) in reversed(ratios.items())}
    freedom = (SEEDS - 1) * len(firsts)

    def plausible_sum(factor: float) -> bool:
        total = factor * (SEEDS - 1) * sum(firsts.values())
        return bool(chi2.isf(1 - 5e-5, freedom) < total < chi2.isf(5e-5, freedom))

    assert plausible_sum(1)
    # Errors that are 15 % too small or too large are detected; the normalisation n instead of n - 1 is not.
    assert not plausible_sum(TOGETHER**2)
    assert not plausible_sum(1 / TOGETHER**2)
