"""Integrated heat current in equilibrium against exact results: short times with rotations, and a gas in
which every collision draws the direction and keeps the speed."""

import numpy as np
import pytest

from tests.python.conftest import Measure
from workflow.lib.load import Quantity

T, LENGTH, FUGACITY = 3.7, 0.6, 2.5
ZETA = FUGACITY * LENGTH
GAS = {"temperature": T, "cell_length": LENGTH, "fugacity": FUGACITY, "cells": 20}
LONGER = {"times": "0.05,0.1,0.2,0.4,0.8", "observation_time": 3.2, "replicas": 2000}
SLOWEST = 0.01 * LENGTH / 3.2  # speed of the slowest particles at the start


@pytest.fixture
def heat_current(measure: Measure) -> Measure:
    return lambda **options: measure("heat_current", **GAS | options)


def scores(quantity: Quantity, expected: np.ndarray | float) -> np.ndarray:
    found: np.ndarray = (quantity.mean - expected) / quantity.error
    return found


def test_short_times_with_rotations_have_the_variance_of_the_energy_that_they_carry(
    heat_current: Measure,
) -> None:
    """Every collision, of which a scatterer has z sqrt(2πT) per unit time, carries an energy over one cell.
    All three velocities are independent and Gaussian, before and after it. The neighbour's has the
    correlation ρ = a + (1 - a) cos θ with itself, where a = M/(1 + 2M) is the square of its direction cosine
    with the conserved momentum, so that the energy has the mean square T² (1 - mean of ρ²)."""
    times = {"times": "5e-4,1e-3", "observation_time": 1e-3}
    rule = {"rule": "rotation", "rotation_probability": 1, "sigma": 0.5}
    result = heat_current(**times, **rule, cells=100, replicas=40000)
    mass = (1 + 0.5) / (1 - 0.5)
    a = mass / (1 + 2 * mass)
    carried = T**2 * (1 - a**2 - (1 - a) ** 2 / 2)
    time = result["mean_square_heat"].axes["time"]
    expected = FUGACITY * np.sqrt(2 * np.pi * T) * LENGTH**2 * carried * time + 2 * ZETA * T**3 * time**2
    assert (result["mean_square_heat"].error / expected).max() < 0.02
    assert np.abs(scores(result["mean_square_heat"], expected)).max() < 4


def of_walkers(time: float, scattered: float) -> float:
    """<Q²> per cell of independent walkers that every scatterer scatters with this probability, which
    draws the direction. The correlation of a velocity is u² times the probability that no scattering took
    place yet."""
    ages = np.linspace(0, time, 4001)

    def of_speed(u: float) -> float:
        passed, part = np.divmod(u * ages / LENGTH, 1)
        free = (1 - scattered) ** passed * (1 - part * scattered)
        square = 2 * u**2 * np.trapezoid((time - ages) * free, ages)
        return float(2 * ZETA / u * np.exp(-(u**2) / (2 * T)) * (u**2 / 2 - T) ** 2 * square)

    speeds = np.geomspace(SLOWEST, 40, 801)
    return float(np.trapezoid([u * of_speed(u) for u in speeds], np.log(speeds)))


def test_mean_square_heat_with_random_directions_is_that_of_walkers(heat_current: Measure) -> None:
    result = heat_current(**LONGER | {"cells": 5, "replicas": 20000, "sigma": -1, "rule": "random-direction"})
    times = result["mean_square_heat"].axes["time"]
    expected = np.array([of_walkers(time, 1) for time in times])
    assert np.abs(scores(result["mean_square_heat"], expected)).max() < 4
    # Detected mistakes: windows that are 5 % longer; a probability that is 25 % smaller.
    longer = np.array([of_walkers(1.05 * time, 1) for time in times])
    rarer = np.array([of_walkers(time, 0.75) for time in times])
    assert np.abs(scores(result["mean_square_heat"], longer)).max() > 6
    assert np.abs(scores(result["mean_square_heat"], rarer)).max() > 6


def test_local_exponents_are_slopes_between_times(heat_current: Measure) -> None:
    heat = (result := heat_current(**LONGER, sigma=0.5))["mean_square_heat"]
    slopes = np.diff(np.log(heat.mean)) / np.diff(np.log(heat.axes["time"]))
    np.testing.assert_allclose(result["local_exponent"].mean, slopes, rtol=1e-9)
