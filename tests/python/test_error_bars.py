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


@pytest.mark.parametrize("sigma", [-0.8, 0.5])
def test_standard_error_over_seeds(persistence: Program, tmp_path: Path, sigma: float) -> None:
    estimates = []
    for seed in range(SEEDS):
        persistence(sigma=sigma, seed=seed, replicas=REPLICAS, output=f"{seed}.h5")
        mu = load(tmp_path / f"{seed}.h5")["mu"]
        estimates.append((float(mu.mean), float(mu.standard_error)))
    values, errors = np.array(estimates).T
    assert accepted(chi_square(values, errors))
    # Mutants: the spread of one replica instead of the mean's error, and a factor two either way.
    for factor in (np.sqrt(REPLICAS), 2, 0.5):
        assert not accepted(chi_square(values, factor * errors))
