"""The standard error equals the standard deviation of results from independent seeds."""

from pathlib import Path

import numpy as np
import pytest
from scipy.stats import chi2

from tests.python.conftest import Measure, Program
from workflow.lib.described import with_option
from workflow.lib.load import load

SEEDS = 50
REPLICAS = 24
LEAST = 64  # replicas of a run with a target error


def chi_square(values: np.ndarray, errors: np.ndarray) -> float:
    """Chi-square about the weighted mean; SEEDS - 1 degrees of freedom."""
    weights = errors**-2
    return float(np.sum(weights * (values - np.average(values, weights=weights)) ** 2))


def accepted(statistic: float, replicas: int = REPLICAS) -> bool:
    """Errors estimated from R replicas make the sum of squared Student variables: each has mean
    (R-1)/(R-3), not 1, which the bounds allow for."""
    stretch = (replicas - 1) / (replicas - 3)
    low, high = chi2.ppf([5e-4, 1 - 5e-4], SEEDS - 1)
    return bool(low < statistic < stretch * high)


EQUILIBRIUM = {"cells": 30, "observation_time": 64, "times": "1,2,4,8", "fit_from": 2}
SOUND = {"cells": 101, "observation_time": 64, "times": "4,8,16"}
OPEN = {"cells": 4, "relaxation_time": 0.5, "observation_time": 4}


PULSE = {"cells": 7, "particles_per_cell": 20, "times": "0.02,0.04", "pairs_per_replica": 2}
CASES: dict[str, list[tuple[str, dict]]] = {
    "persistence": [("mu", {"sigma": -0.8})],
    "waiting_time": [("exponent", {"sigma": 0.5, "observation_time": 50})],
    "displacement": [
        ("alpha", {"sigma": 0.5, "decades": 2, "observation_time": 20}),
        ("alpha", {"sigma": -0.5, "decades": 2, "zero_total_momentum": True}),
    ],
    "ageing": [("log_slope", {"sigma": 0.5, "decades": 2, "relaxation_time": 0})],
    "heat_current": [("amplitude", EQUILIBRIUM)],
    "correlation": [("peak", SOUND)],
    "steady_profile": [("temperature_difference", OPEN), ("density_excess", OPEN | {"gamma": 1})],
    "momentum_flux": [("square", OPEN), ("jump", OPEN | {"gamma": 0.3})],
    "particle_count": [("log_slope", {"cells": 4, "times": "1,2,4"})],
    "conductivity": [("energy_current", OPEN)],
    "energy_pulse": [("energy_difference", PULSE)],
}


@pytest.mark.parametrize("name", with_option("replicas"))
def test_standard_error_over_seeds(measure: Measure, name: str) -> None:
    """Of an array the last element is tested."""
    for quantity, options in CASES[name]:
        check_standard_error(measure, name, quantity, options)


def check_standard_error(measure: Measure, name: str, quantity: str, options: dict) -> None:
    estimates = []
    for seed in range(SEEDS):
        result = measure(name, (0, 4), seed=seed, replicas=REPLICAS, **options)[quantity]
        estimates.append((result.mean.flat[-1], result.standard_error.flat[-1]))
    values, errors = np.array(estimates).T
    assert accepted(chi_square(values, errors))
    # Detected mistakes: the standard deviation of one replica instead of the mean; errors that are wrong by a factor of two.
    for factor in (np.sqrt(REPLICAS), 2, 0.5):
        assert not accepted(chi_square(values, factor * errors))


@pytest.mark.parametrize(
    ("name", "quantity", "options"),
    [
        ("persistence", "mu", {"sigma": 0.5, "target_error": 0.004}),
        (
            "conductivity",
            "kappa",
            {"cells": 8, "relaxation_time": 0.4, "observation_time": 5, "target_error": 0.05},
        ),
    ],
)
def test_standard_error_over_seeds_where_a_target_ends_the_run(
    program: Program, tmp_path: Path, name: str, quantity: str, options: dict
) -> None:
    """Runs with the smallest batches that have an error. tests/cpp/program/stopping_rule_test.cpp measures the effect of the
    rule on means and errors; this test covers programs, with control variates where they have some."""
    estimates = []
    for seed in range(SEEDS):
        done = program(name, seed=seed, replicas=2, progress="log", **options)
        assert done.returncode == 0
        result = load(tmp_path / "out.h5")[quantity]
        estimates.append((float(result.mean), float(result.standard_error), int(result.count)))
    values, errors, counts = np.array(estimates).T
    assert (errors <= options["target_error"] * abs(values)).all()
    assert counts.min() >= LEAST
    assert counts.max() > counts.min()  # the end depends on the data
    assert accepted(chi_square(values, errors), LEAST)
    for factor in (2, 0.5):
        assert not accepted(chi_square(values, factor * errors), LEAST)
