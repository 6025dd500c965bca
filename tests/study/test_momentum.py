"""The panel `momentum`: chains and rings with and without conserved momentum."""

import numpy as np
import pytest

from tests.python.conftest import ROOT
from tests.python.plotted import CHAIN, RING, assert_points, draw, errors_of, result
from workflow.lib.load import Quantity, Result
from workflow.study.rings import gas, tabulate


def test_momentum() -> None:
    """κ of heat is 7 N; ⟨Q²⟩ is t^(1 + a), with another a for every rule and gas. Chains have T_1 = 90 and T_N = 110. The
    gas of N = 16 is observed in a ring of T = 4 and cells of length 3 for the time 5. Detected mistakes: the rings of
    fig. 8's own gas among the others; the first time in place of the last."""
    time, octaves = np.array([2.0, 4, 8]), np.sqrt([8, 32])
    ring = RING | {"cells": 100, "sigma": 0.5, "fugacity": 0.25, "temperature": 1.0, "cell_length": 1.0}

    def observed(series: str, a: float, **options: object) -> Result:
        exponent = ([1 + a, 1 + a], {"middle": octaves})
        heat = (time ** (1 + a), {"time": time})
        return result(series, ring | options, "heat_current", heat_variance=heat, local_exponent=exponent)

    runs = [
        observed("thin", 0.3, rule="elastic"),
        observed("thin-rotation", 0.2, rule="rotation", rotation_probability=0.1),
        observed("thin-reversal", 0.1, rule="reversal", reversal_probability=0.1),
        observed("dense", 0.25, rule="elastic", fugacity=2.0),
        result("gas-16", ring | {"fugacity": 1 / 3, "cell_length": 3.0, "temperature": 4.0, "rule": "elastic"},
               "heat_current", heat_variance=([60.0, 90.0], {"time": [2.0, 5.0]}),
               local_exponent=([1.4], {"middle": [3.0]})),
        *(result(f"deterministic_cells={n}", CHAIN | {"cells": n, "rule": "elastic"}, "conductivity", kappa_heat=7.0 * n,
                 temperature_first=90.0, temperature_last=110.0, stationary=1.0, stationarity_p_value=0.5)
          for n in (16, 32)),
    ]  # fmt: skip
    (sizes, noise, gases), table, caption = draw("momentum", runs, "study")
    # In units of the ring's λ and T the conductivity is 90/(2 · 5 · 3 · 4²·⁵), and κ is N √T times as large.
    green_kubo = 90 / (2 * 5 * 3 * 32) * 16 * 10
    heat = 7 * np.array([16, 32.0])
    error = errors_of(np.array([60.0, 90]))[-1] / 90
    assert_points(sizes, ((16, 32), heat, 0.01 * heat), ((16,), [green_kubo], [error * green_kubo]))
    variances = [time ** (1 + a) for a in (0.3, 0.1, 0.2)]
    assert_points(noise, *((time, y / 2 / time, errors_of(y) / 2 / time) for y in variances))
    betas = [np.array([1 + a, 1 + a]) for a in (0.3, 0.25)]
    assert_points(gases, *((octaves, y - 1, errors_of(y)) for y in betas))
    ratio = table.ratio.dropna().item()
    assert ratio == pytest.approx(green_kubo / 7 / 16)
    assert f"{ratio:.2f}" in caption
    assert len(table) == 2 + 4 * 3


def ring(
    times: list[float], error: float, power: float = 4 / 3, of_exponent: float = 1, **options: object
) -> Result:
    """A ring of ζ = 0.8 and M = 1/3 with ⟨Q²⟩ = t^power, with relative errors; of_exponent: factor of those of
    the exponents."""
    time = np.array(times)
    units = {"time": "time", "middle": "time"}

    def quantity(mean: np.ndarray, relative: float, **axes: np.ndarray) -> Quantity:
        count = np.full(mean.shape, 64)
        return Quantity(mean, relative * np.abs(mean), None, count, axes, "1", units, 0)

    middle = np.sqrt(time[1:] * time[:-1])
    parameters = {"temperature": 1.0, "cell_length": 1.0, "sigma": -0.5, "fugacity": 0.8, "cells": 100, "fit_from": 2.0,
                  "rule": "elastic", "replicas": 64}  # fmt: skip
    quantities = {
        "heat_variance": quantity(time**power, error, time=time),
        "local_exponent": quantity(np.full(len(middle), power), of_exponent * error, middle=middle),
    }
    return Result(ROOT, parameters | options, {}, quantities)


def test_a_gas_has_its_temperature_and_length() -> None:
    """Detected mistakes: rings at T = 1 and 3, or with λ = 1 and 0.5 at one ζ, are one gas."""
    gases = ({}, {"temperature": 3.0}, {"cell_length": 0.5, "fugacity": 1.6}, {"sigma": 0.3})
    table = tabulate([ring([1, 3, 7], 0.01, **changed) for changed in gases])
    assert len(table) == 4 * 3
    assert len({gas(ring([1, 3], 0.01, **changed)) for changed in gases}) == 4


def test_every_time_is_from_the_ring_with_the_smallest_error() -> None:
    """A short ring ends at t = 4, where the long one takes over its octave. That has the smaller absolute
    errors at all times, and the smaller error of the exponent from t = 2."""
    results = [ring([1, 2, 4], 0.01), ring([2, 4, 8], 0.0101, power=1.2, of_exponent=0.5)]
    results.append(ring([1, 2, 4, 8], 0.01, 1, rule="random-direction"))
    results.append(ring([1, 2, 4, 8], 0.001, 1.1, rule="rotation", rotation_probability=0.1))
    table = tabulate(results)
    rotated = table[table.epsilon == 0.1]
    table = table[table.epsilon == 0]
    np.testing.assert_allclose(rotated.heat_variance, rotated.time**1.1)
    sound, random = (table[table.rule == rule] for rule in ("elastic", "random-direction"))
    assert sound.time.tolist() == random.time.tolist() == [1, 2, 4, 8]
    np.testing.assert_allclose(sound.heat_variance, [1, 2 ** (4 / 3), 4 ** (4 / 3), 8**1.2])
    np.testing.assert_allclose(sound.local_exponent, [4 / 3, 1.2, 1.2, np.nan])
    np.testing.assert_allclose(sound.middle, [2**0.5, 8**0.5, 32**0.5, np.nan])
