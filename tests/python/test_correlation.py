"""Correlations of a closed chain in the stationary state against the reference simulator, which shares no code with the program, and
peaks against mode coupling."""

import numpy as np
import pytest
from scipy.stats import chi2

from tests.python.conftest import Measure, simulate
from workflow.lib.load import Result
from workflow.physics.mode_coupling import Chain

FIELDS = ("momentum", "heat")
CELLS, ZETA, T, SIGMA = 25, 1.5, 4.0, 0.5
MASS = (1 + SIGMA) / (1 - SIGMA)
CHAIN = {"cells": CELLS, "fugacity": ZETA, "temperature": T, "sigma": SIGMA}
VARIANCE = T * (2 * ZETA + MASS)  # variance of the total momentum per cell
OBSERVED = 8  # observation time
SLOWEST = 0.01 / OBSERVED  # speed of the slowest particles at the start


@pytest.fixture
def correlation(measure: Measure) -> Measure:
    # The exit status is 4 if no moving peak is found.
    return lambda **options: measure("correlation", allowed=(0, 4), **CHAIN | options)


def scores(
    result: Result, index: int, expected: dict[str, np.ndarray], errors: dict[str, np.ndarray]
) -> dict[str, np.ndarray]:
    """z-scores of every field up to half the ring; the other half is equal by symmetry."""
    half = CELLS // 2 + 1
    by_field = {}
    for name in FIELDS:
        quantity = result[f"{name}_correlation"]
        error = np.hypot(quantity.standard_error[index, CELLS // 2 :], errors[name][:half])
        by_field[name] = (quantity.mean[index, CELLS // 2 :] - expected[name][:half]) / error
    return by_field


def accepted(z: np.ndarray) -> bool:
    """Whether the scores agree with 0. As distances may be correlated, only their maximum and, with a wide margin, their sum are tested."""
    return bool(np.abs(z).max() < 4.2 and np.sum(z**2) < 2 * chi2.ppf(1 - 1e-4, len(z)))


def reference(lag: float, replicas: int) -> dict[str, np.ndarray]:
    """Correlations of the reference simulator by field [replica, distance]."""
    gas = {"cells": CELLS, "fugacity": ZETA, "sigma": SIGMA, "temperature": T, "slowest": SLOWEST}
    rows = simulate("correlation", **gas, lag=lag, replicas=replicas, seed=1)
    sample = rows.reshape(replicas, len(FIELDS), CELLS)
    # The expectation does not depend on the sign of r.
    sample = 0.5 * (sample + np.roll(sample[:, :, ::-1], 1, axis=2))
    return {name: sample[:, k] for k, name in enumerate(FIELDS)}


def test_against_the_reference(correlation: Measure) -> None:
    """Detected mistakes: the scatterers are heavier; the correlations are those of another time."""
    sample = reference(3.0, 4000)
    expected = {name: values.mean(axis=0) for name, values in sample.items()}
    errors = {name: values.std(axis=0, ddof=1) / np.sqrt(len(values)) for name, values in sample.items()}
    run = {"observation_time": OBSERVED, "times": "1.5,3", "replicas": 1000}
    result, heavier = correlation(**run), correlation(**run, sigma=0.6)
    z = scores(result, 1, expected, errors)
    assert all(accepted(score) for score in z.values()), z
    assert not all(accepted(score) for score in scores(heavier, 1, expected, errors).values())
    assert not accepted(scores(result, 0, expected, errors)["momentum"])


def test_the_sum_over_the_ring_is_known(correlation: Measure) -> None:
    """The variance of the total momentum over the number of cells, exact in every run."""
    result = correlation(observation_time=OBSERVED, times="1,2,4", replicas=3)
    sums = result["momentum_correlation"].mean.sum(axis=1)
    np.testing.assert_allclose(sums, VARIANCE, rtol=1e-4)  # the cut at small momenta changes it by 2e-5
    assert result["momentum_drift"].mean < 1e-12


def test_sound_has_the_speed_and_the_area_of_the_theory(correlation: Measure) -> None:
    """ζ = 0.8 and M = 1/3, where the peak approaches its asymptotic shape first. Allowed are 3 %, the predicted contribution of the tail,
    and four standard errors. Detected mistakes: heavier scatterers; fewer particles."""
    gas = {"sigma": -0.5, "fugacity": 0.8, "temperature": 1}
    ring = {"cells": 216, "observation_time": 512, "times": "16,32,64", "replicas": 300}
    result = correlation(**gas | ring)

    def off(chain: Chain) -> list[float]:
        """Deviations in units of the allowed ones."""
        predicted = [("sound_speed", 1, chain.sound_speed), ("peak_area", 2, chain.peak_area)]
        return [
            abs(result[name].mean[k] - expected) / (0.03 * expected + 4 * result[name].error[k])
            for name, k, expected in predicted
        ]

    assert max(off(Chain(0.8, 1 / 3))) < 1
    for mutant in (Chain(0.8, 0.75), Chain(0.5, 1 / 3)):
        assert min(off(mutant)) > 1
    height = float(result["peak"].mean[2]) / Chain(0.8, 1 / 3).sound_peak(
        64 * Chain(0.8, 1 / 3).sound_speed, 64
    )
    assert 0.9 < height < 1
