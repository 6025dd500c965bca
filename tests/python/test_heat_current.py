"""Integrated heat current in equilibrium against exact results: short times with rotations, and a gas in
which every collision draws the direction and keeps the speed."""

from functools import partial

import numpy as np
import pytest

from tests.python.conftest import Measure, Program
from workflow.lib.load import Quantity
from workflow.physics.sound import Chain

T, LENGTH, FUGACITY = 3.7, 0.6, 2.5
ZETA = FUGACITY * LENGTH
GAS = {"temperature": T, "cell_length": LENGTH, "fugacity": FUGACITY, "cells": 20}
LONGER = {"times": "0.05,0.1,0.2,0.4,0.8", "fit_from": 0.1, "observation_time": 3.2, "replicas": 2000}
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
    times = {"times": "5e-4,1e-3", "fit_from": 5e-4, "observation_time": 1e-3}
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


def test_growth_is_the_weighted_fit(heat_current: Measure) -> None:
    """The fit is y/t = 4.5 A t^(1/3) + 2D with weights 1/(y² t)·t² in units of T and λ."""
    result = heat_current(**LONGER, sigma=0.5)
    heat = result["mean_square_heat"]
    seen = heat.axes["time"] >= 0.1
    time, y = heat.axes["time"][seen] * np.sqrt(T) / LENGTH, heat.mean[seen] / (T * LENGTH) ** 2

    def fitted(weight: np.ndarray) -> np.ndarray:
        basis = np.stack([4.5 * np.cbrt(time), np.full_like(time, 2)], axis=1)
        coefficients: np.ndarray = np.linalg.lstsq(basis * weight[:, None], y / time * weight)[0]
        return coefficients

    stored = [float(result[name].mean) for name in ("amplitude", "diffusion")]
    np.testing.assert_allclose(stored, fitted(np.sqrt(time) / y), rtol=1e-9)
    slopes = np.diff(np.log(heat.mean)) / np.diff(np.log(heat.axes["time"]))
    np.testing.assert_allclose(result["local_exponent"].mean, slopes, rtol=1e-9)
    # Detected mistake: a fit without weights.
    assert not np.allclose(stored, fitted(np.ones_like(time)), rtol=1e-3)


def test_sound_must_not_come_around(program: Program) -> None:
    """The ring must be longer than twice the distance of a peak plus twice its root-mean-square width [eq.
    57]."""
    chain, time = Chain(zeta=1.6, mass=3), 20.0
    reach = chain.sound_speed * time + np.sqrt(0.510523) * (chain.self_coupling * time) ** (2 / 3)
    ring = {"fugacity": 1.6, "sigma": 0.5, "temperature": 1, "times": "10,20", "fit_from": 10,
                   "observation_time": 20, "replicas": 2}  # fmt: skip
    run = partial(program, "heat_current", **ring)
    refused = run(cells=int(2 * reach))
    assert refused.returncode == 2
    assert (
        "--cells: sound travels around the ring within the last of --times. "
        f"Choose at least {int(2 * reach) + 1} cells" in refused.stderr
    )
    assert run(cells=int(2 * reach) + 1).returncode == 0
    assert run(cells=int(2 * reach), rule="random-direction").returncode == 0
