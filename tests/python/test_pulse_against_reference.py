"""Profiles of the energy pulse against the reference simulator, which shares no code with the program.
test_pulse_peak.py tests what follows from them."""

from functools import cache

import numpy as np
import pytest
from scipy.stats import chi2

from tests.python.conftest import Measure, simulate
from workflow.lib.load import Result

CELLS, PARTICLES, SIGMA, ENERGY, PULSE_ENERGY = 41, 20, 0.5, 5000, 50000
PAIRS = {"N": 90, 1: 150}  # enough to detect the mistake below
TIMES = {"N": (0.02, 0.03, 0.045, 0.06), 1: (0.008, 0.01, 0.015, 0.02)}


@cache
def reference(gamma: float, times: tuple[float, ...], *, replicas: int, pairs: int) -> np.ndarray:
    """Energy differences [replica, time, cell]."""
    chain = {"cells": CELLS, "particles_per_cell": PARTICLES, "sigma": SIGMA, "gamma": gamma}
    pulse = {"energy": ENERGY, "pulse_energy": PULSE_ENERGY, "times": ",".join(map(str, times))}
    effort = {"pairs_per_replica": pairs, "replicas": replicas, "seed": 1}
    rows = simulate("pulse", **chain, **pulse, **effort)
    return rows.reshape(replicas, len(times), CELLS)


def scores(result: Result, gamma: float, times: tuple[float, ...], pairs: int) -> np.ndarray:
    """z-scores of every cell reached by the pulse, at every time."""
    samples = reference(gamma, times, replicas=40, pairs=pairs)
    mean, error = samples.mean(axis=0), samples.std(axis=0, ddof=1) / np.sqrt(len(samples))
    difference = result["energy_difference"]
    reached = np.abs(difference.mean) > 5 * difference.standard_error
    combined = np.hypot(difference.standard_error, error)
    return np.asarray((difference.mean - mean)[reached] / combined[reached])


def accepted(z: np.ndarray) -> bool:
    """Whether the largest score is below a bound that is valid although energy conservation makes cells
    anticorrelated."""
    return bool(np.abs(z).max() < 4 and np.sum(z**2) < chi2.ppf(1 - 1e-4, len(z)))


@pytest.mark.parametrize("gamma", ["N", 1])
def test_pulse_profiles_against_the_reference_simulator(measure: Measure, gamma: str | int) -> None:
    times, pairs = TIMES[gamma], PAIRS[gamma]

    def pulse(**options: object) -> Result:
        physics = {"cells": CELLS, "particles_per_cell": PARTICLES, "sigma": SIGMA, "gamma": gamma}
        effort = {"times": ",".join(map(str, times)), "pairs_per_replica": pairs, "replicas": 40}
        return measure("energy_pulse", **physics | effort | options)

    visited = CELLS if gamma == "N" else gamma
    z = scores(pulse(), visited, times, pairs)
    assert len(z) > 60
    assert accepted(z)
    # Detected mistake: lighter scatterers.
    assert not accepted(scores(pulse(sigma=0.4 if gamma == "N" else 0.3), visited, times, pairs))
