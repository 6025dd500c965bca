"""The panel `momentum`: chains and rings with and without conserved momentum."""

import numpy as np

from tests.python.conftest import ROOT
from tests.python.plotted import CHAIN, RING, assert_points, draw, errors_of, result
from workflow.lib.load import Quantity, Result
from workflow.study import momentum
from workflow.study.rings import gas, tabulate


def test_momentum() -> None:
    """κ is 7 N^a with another a for every case, also without noise, from fig. 8, at more sizes; ⟨Q²⟩ is t^(1 + a)."""
    sizes, time = (16, 32, 64), np.array([2.0, 4, 8])
    cases = {
        "elastic": (0.3, {}),
        "rotation": (0.2, {"rotation_probability": 0.1}),
        "reversal": (0.05, {"reversal_probability": 0.1}),
    }
    runs = []
    ring = {"cells": 100, "sigma": 0.5, "fugacity": 1.0, "temperature": 1.0, "cell_length": 1.0}
    for name, (a, options) in cases.items():
        own = options | {"rule": name}
        series = {"elastic": "light"}.get(name, name)
        runs += [result(series, RING | ring | own, "heat_current",
                        mean_square_heat=(time ** (1 + a), {"time": time}), local_exponent=([1 + a, 1 + a], {"middle": np.sqrt([8, 32])}))]  # fmt: skip
        chain = {"elastic": "deterministic"}.get(name, f"chain-{name}")
        runs += [result(f"{chain}_cells={n}", CHAIN | {"cells": n} | own, "conductivity", kappa=7 * n**a, stationary=1.0,
                        stationarity_p_value=0.5) for n in (*sizes, *([128] if name == "elastic" else []))]  # fmt: skip
    runs.append(result("dense-longest", RING | ring | {"rule": "elastic", "fugacity": 2.0}, "heat_current",
                       mean_square_heat=(time**1.25, {"time": time}), local_exponent=([1.25, 1.25], {"middle": np.sqrt([8, 32])})))  # fmt: skip
    (chains, rings, gases), table, caption = draw("momentum", runs, "study")
    powers = [a for a, _ in cases.values()]
    assert_points(chains, *((sizes, (kappa := 7 * np.array(sizes) ** a), 0.01 * kappa) for a in powers))
    variances = [time ** (1 + a) for a in powers]
    assert_points(rings, *((time, y / 2 / time, errors_of(y) / 2 / time) for y in variances))
    octaves = np.sqrt([8, 32])  # their middles
    assert_points(gases, *((octaves, [a, a], errors_of(np.array([1 + a, 1 + a]))) for a in (0.3, 0.25)))
    assert "by 1.516(21) without noise, by 1.072(15) if 10 % break momentum" in caption
    assert len(table) == 9 + 12


def test_more_cases_than_looks_are_all_plotted() -> None:
    cases = [
        momentum.Case(rule, 0.1 * size) for rule in ("rotation", "reversal", "mine") for size in range(9)
    ]
    assert {*momentum.looks(cases)} == {*cases}


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
        "mean_square_heat": quantity(time**power, error, time=time),
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
    np.testing.assert_allclose(rotated.mean_square_heat, rotated.time**1.1)
    sound, random = (table[table.rule == rule] for rule in ("elastic", "random-direction"))
    assert sound.time.tolist() == random.time.tolist() == [1, 2, 4, 8]
    np.testing.assert_allclose(sound.mean_square_heat, [1, 2 ** (4 / 3), 4 ** (4 / 3), 8**1.2])
    np.testing.assert_allclose(sound.local_exponent, [4 / 3, 1.2, 1.2, np.nan])
    np.testing.assert_allclose(sound.middle, [2**0.5, 8**0.5, 32**0.5, np.nan])
