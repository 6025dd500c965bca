"""The standard error says how far results from independent seeds lie apart."""

from pathlib import Path

import numpy as np
import pytest
from scipy.stats import chi2

from tests.python.conftest import Program
from workflow.scripts.load import load

SEEDS = 50
REPLICAS = 24


def chi_square(values: np.ndarray, errors: np.ndarray) -> float:
    """About the weighted mean; SEEDS - 1 degrees of freedom."""
    weights = errors**-2
    return float(np.sum(weights * (values - np.average(values, weights=weights)) ** 2))


def accepted(statistic: float) -> bool:
    """Errors estimated from R replicas make the sum of squared Student variables: each has mean
    (R-1)/(R-3), not 1, which the bounds allow for."""
    stretch = (REPLICAS - 1) / (REPLICAS - 3)
    low, high = chi2.ppf([5e-4, 1 - 5e-4], SEEDS - 1)
    return bool(low < statistic < stretch * high)


PULSE = {"cells": 31, "particles_per_cell": 20, "relaxation_time": 0, "observation_time": None, "members": 8}


@pytest.mark.parametrize(
    ("name", "quantity", "options"),
    [
        ("persistence", "mu", {"sigma": -0.8}),
        ("persistence", "mu", {"sigma": 0.5}),
        ("waiting_time", "exponent", {"sigma": 0.5, "observation_time": 50}),
        ("displacement", "alpha", {"sigma": 0.5, "decades": 2, "observation_time": 20}),
        ("displacement", "alpha", {"sigma": -0.5, "decades": 2, "zero_total_momentum": True}),
        ("ageing", "log_slope", {"sigma": 0.5, "decades": 2, "relaxation_time": 0}),
        ("energy_pulse", "damping_exponent", {**PULSE, "times": "0.008,0.01,0.014,0.02"}),
        ("energy_pulse", "peak_collapse", {**PULSE, "times": "0.008,0.01,0.014,0.02"}),
    ],
)
def test_standard_error_over_seeds(
    program: Program, tmp_path: Path, name: str, quantity: str, options: dict
) -> None:
    estimates = []
    for seed in range(SEEDS):
        program(name, seed=seed, replicas=REPLICAS, **options)
        result = load(tmp_path / "out.h5")[quantity]
        estimates.append((float(result.mean), float(result.standard_error)))
    values, errors = np.array(estimates).T
    assert accepted(chi_square(values, errors))
    # Mutants: the spread of one replica instead of the mean's error, and a factor two either way.
    for factor in (np.sqrt(REPLICAS), 2, 0.5):
        assert not accepted(chi_square(values, factor * errors))
