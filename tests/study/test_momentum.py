"""The panel `momentum`: chains and rings with and without conserved momentum."""

import numpy as np
import pytest

from tests.python.conftest import ROOT
from tests.python.plotted import CHAIN, RING, assert_points, draw, errors_of, result
from workflow.lib.load import Quantity, Result
from workflow.study.rings import gas, tabulate


def test_momentum() -> None:
    """κ of heat is 7 N; ⟨Q²⟩ is t^(1 + a), with another a for every rule and gas. Chains have T_1 = 90 and
    T_N = 110. The gas of N = 16 is observed in a ring of T = 4 and cells of length 3 for the time 5.
    Detected mistakes: the rings of fig. 8's own gas among the others; the first time in place of the last."""
    time, octaves = np.array([2.0, 4, 8]), np.sqrt([8, 32])
    ring = RING | {"cells": 100, "sigma": 0.5, "fugacity": 0.25, "temperature": 1.0, "cell_length": 1.0}

    def observed(series: str, a: float, **options: object) -> Result:
        exponent = ([1 + a, 1 + a], {"middle": octaves})
        heat = (time ** (1 + a), {"time": time})
        return result(series, ring | options, "heat_current", mean_square_heat=heat, local_exponent=exponent)

    runs = [
        observed("thin", 0.3, rule="elastic"),
        observed("thin-rotation", 0.2, rule="rotation", rotation_probability=0.1),
        observed("thin-reversal", 0.1, rule="reversal", reversal_probability=0.1),
        observed("dense", 0.25, rule="elastic", fugacity=2.0),
        result(
            "gas-16",
            ring | {"fugacity": 1 / 3, "cell_length": 3.0, "temperature": 4.0, "rule": "elastic"},
            "heat_current",
            mean_square_heat=([60.0, 90.0], {"time": [2.0, 5.0]}),
            local_exponent=([1.4], {"middle": [3.0]}),
        ),
        *(
            result(
                f"deterministic_cells={n}",
                CHAIN | {"cells": n, "rule": "elastic"},
                "conductivity",
                kappa_heat=7.0 * n,
                temperature_first=90.0,
                temperature_last=110.0,
                stationary=1.0,
                stationarity_p_value=0.5,
            )
            for n in (16, 32)
        ),
    ]
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


def ring(times: list[float], error: float, power: float = 4 / 3, **options: object) -> Result:
    """A ring of ζ = 0.8 and M = 1/3 with ⟨Q²⟩ = t^power, with relative errors."""
    time = np.array(times)
    units = {"time": "time", "middle": "time"}

    def quantity(mean: np.ndarray, relative: float, **axes: np.ndarray) -> Quantity:
        count = np.full(mean.shape, 64)
        return Quantity(mean, relative * np.abs(mean), None, count, axes, "1", units, 0)

    middle = np.sqrt(time[1:] * time[:-1])
    parameters = {
        "temperature": 1.0,
        "cell_length": 1.0,
        "sigma": -0.5,
        "fugacity": 0.8,
        "cells": 100,
        "fit_from": 2.0,
        "rule": "elastic",
        "replicas": 64,
    }
    quantities = {
        "mean_square_heat": quantity(time**power, error, time=time),
        "local_exponent": quantity(np.full(len(middle), power), error, middle=middle),
    }
    return Result(ROOT, parameters | options, {}, quantities)


def test_a_gas_has_its_temperature_and_length() -> None:
    """Detected mistakes: rings at T = 1 and 3, or with λ = 1 and 0.5 at one ζ, are one gas."""
    gases = ({}, {"temperature": 3.0}, {"cell_length": 0.5, "fugacity": 1.6}, {"sigma": 0.3})
    table = tabulate([ring([1, 3, 7], 0.01, **changed) for changed in gases])
    assert len(table) == 4 * 3
    assert len({gas(ring([1, 3], 0.01, **changed)) for changed in gases}) == 4


def test_an_exponent_is_in_the_row_of_the_time_at_which_its_octave_begins() -> None:
    """A long ring begins where a short one ends. Detected mistake: the last octave of a ring in the row of
    its end."""
    table = tabulate([ring([4, 8], 0.01, power=1.2), ring([1, 2, 4], 0.01)])
    assert table.time.tolist() == [1, 2, 4, 4, 8]
    known = table.dropna(subset="middle")
    np.testing.assert_allclose(known.middle, known.time * 2**0.5)
    np.testing.assert_allclose(known.local_exponent, [4 / 3, 4 / 3, 1.2])
