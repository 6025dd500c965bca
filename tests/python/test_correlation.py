"""Correlations of a closed chain in the stationary state: particles that fly freely against the exact result, a chain that
scatters against the reference simulator, which shares no code with the program, and peaks against mode coupling."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import chi2

from tests.python.conftest import Measure, simulate
from workflow.lib.load import Quantity, Result
from workflow.lib.mode_coupling import Chain

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


def overlap(shift: float, distance: int) -> float:
    """Probability that a particle with a uniform position in a cell, which moves by `shift` cells, ends in the cell at `distance`."""
    turns = distance + CELLS * np.arange(-3, 4)
    return float(np.maximum(0, 1 - np.abs(shift - turns)).sum())


def free_flight(power: int, distance: int, time: float) -> float:
    """Mean of |p|^power, summed over the particles of a cell that are at +-distance after the time."""

    def integrand(shift: float) -> float:
        p = shift / time
        arrives = overlap(shift, distance) + overlap(-shift, distance)
        return float(ZETA * p ** (power - 1) * np.exp(-(p**2) / (2 * T)) * arrives / time)

    edges = [SLOWEST * time, *np.arange(0.5, 8 * np.sqrt(T) * time + 0.5, 0.5)]
    return float(sum(quad(integrand, *ends)[0] for ends in pairwise(edges)))


def of_free_flight(time: float) -> dict[str, np.ndarray]:
    """Exact correlations by field for scatterers without mass: their energies stay constant, their momenta vanish."""
    distances = range(CELLS // 2 + 1)
    momentum = np.array([free_flight(2, r, time) for r in distances])
    heat = np.array([free_flight(4, r, time) for r in distances]) / 4 / (2 * ZETA) ** 2
    heat[0] += T**2 / 2
    return {"momentum": momentum, "heat": heat}


def scores(
    result: Result, index: int, expected: dict[str, np.ndarray], errors: dict[str, np.ndarray] | None = None
) -> dict[str, np.ndarray]:
    """z-scores of every field up to half the ring; the other half is equal by symmetry."""
    half = CELLS // 2 + 1
    by_field = {}
    for name in FIELDS:
        quantity = result[f"{name}_correlation"]
        error = quantity.standard_error[index, CELLS // 2 :]
        if errors:
            error = np.hypot(error, errors[name][:half])
        by_field[name] = (quantity.mean[index, CELLS // 2 :] - expected[name][:half]) / error
    return by_field


def accepted(z: np.ndarray) -> bool:
    """Whether the scores agree with 0. As distances may be correlated, only their maximum and, with a wide margin, their sum are tested."""
    return bool(np.abs(z).max() < 4.2 and np.sum(z**2) < 2 * chi2.ppf(1 - 1e-4, len(z)))


def test_free_flight(correlation: Measure) -> None:
    """The correlations of massless scatterers are exact. Detected mistake: they are measured at another time."""
    result = correlation(sigma=-1, observation_time=OBSERVED, times="0.5,2", replicas=400)
    for index, time in enumerate((0.5, 2.0)):
        for name, z in scores(result, index, of_free_flight(time)).items():
            assert accepted(z), (name, time, z)
    assert not accepted(scores(result, 1, of_free_flight(1.6))["momentum"])


def reference(lag: float, replicas: int) -> dict[str, np.ndarray]:
    """Correlations of the reference simulator by field [replica, distance]."""
    gas = {"cells": CELLS, "fugacity": ZETA, "sigma": SIGMA, "temperature": T, "slowest": SLOWEST}
    rows = simulate("correlation", **gas, lag=lag, replicas=replicas, seed=1)
    sample = rows.reshape(replicas, len(FIELDS), CELLS)
    # The expectation does not depend on the sign of r.
    sample = 0.5 * (sample + np.roll(sample[:, :, ::-1], 1, axis=2))
    return {name: sample[:, k] for k, name in enumerate(FIELDS)}


def test_against_the_reference(correlation: Measure) -> None:
    """The correlations agree with the reference simulator. Detected mistake: the scatterers are heavier."""
    sample = reference(3.0, 4000)
    expected = {name: values.mean(axis=0) for name, values in sample.items()}
    errors = {name: values.std(axis=0, ddof=1) / np.sqrt(len(values)) for name, values in sample.items()}
    run = {"observation_time": OBSERVED, "times": "1.5,3", "replicas": 1000}
    z = scores(correlation(**run), 1, expected, errors)
    assert all(accepted(score) for score in z.values()), z
    heavier = scores(correlation(**run, sigma=0.6), 1, expected, errors)
    assert not all(accepted(score) for score in heavier.values())


def test_the_sum_over_the_ring_is_known(correlation: Measure) -> None:
    """The variance of the total momentum over the number of cells, exact in every run."""
    result = correlation(observation_time=OBSERVED, times="1,2,4", replicas=3)
    sums = result["momentum_correlation"].mean.sum(axis=1)
    np.testing.assert_allclose(sums, VARIANCE, rtol=1e-4)  # the cut at small momenta changes it by 2e-5
    assert result["momentum_drift"].mean < 1e-12


def ratios(quantity: Quantity, index: int, expected: float) -> tuple[float, float]:
    """Relative deviation from a prediction, and its error."""
    return float(quantity.mean[index] / expected - 1), float(quantity.error[index] / expected)


def test_sound_has_the_speed_and_the_area_of_the_theory(correlation: Measure) -> None:
    """ζ = 0.8 and M = 1/3, where the peak approaches its asymptotic shape first. Allowed are 3 %, the predicted contribution of the tail,
    and four standard errors. Detected mistakes: heavier scatterers; fewer particles."""
    gas = {"sigma": -0.5, "fugacity": 0.8, "temperature": 1}
    ring = {"cells": 216, "observation_time": 512, "times": "16,32,64", "replicas": 300}
    result = correlation(**gas | ring)

    def off(chain: Chain) -> list[float]:
        """Deviations in units of the allowed ones."""
        found = [
            ratios(result["sound_speed"], 1, chain.sound_speed),
            ratios(result["peak_area"], 2, chain.peak_area),
        ]
        return [abs(deviation) / (0.03 + 4 * error) for deviation, error in found]

    assert max(off(Chain(0.8, 1 / 3))) < 1
    for mutant in (Chain(0.8, 0.75), Chain(0.5, 1 / 3)):
        assert min(off(mutant)) > 1
    height = float(result["peak"].mean[2]) / Chain(0.8, 1 / 3).sound_peak(
        64 * Chain(0.8, 1 / 3).sound_speed, 64
    )
    assert 0.9 < height < 1
