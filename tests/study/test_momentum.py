"""The panel `momentum`: chains and rings with and without conserved momentum."""

from collections.abc import Sequence

import numpy as np
import pytest

from tests.python.plotted import CHAIN, RING, assert_points, draw, errors_of, result
from workflow.lib.load import Result
from workflow.study.rings import chain, gas, tabulate

RING_OF_A_GAS = RING | {"cells": 100, "sigma": 0.5, "fugacity": 0.25, "temperature": 1.0}


def observed(series: str, times: Sequence[float], power: float, **options: object) -> Result:
    """A ring with ⟨Q²⟩ = t^power."""
    time = np.array(times)
    middle = np.sqrt(time[1:] * time[:-1])
    exponent = (np.full(len(middle), power), {"middle": middle})
    heat = (time**power, {"time": time})
    return result(
        series, RING_OF_A_GAS | options, "heat_current", mean_square_heat=heat, local_exponent=exponent
    )


def test_sound_must_not_come_around() -> None:
    """M = 3, ζ = 0.25, t = 10: c = (2/21)^(1/2) and λ_s = 10/21 · 3.5^(-1/2) [eqs. 52, 53], so that both
    peaks with their widths need 2 (3.086 + 0.7145 · 1.864) = 8.84 cells."""
    time = [5.0, 10.0]
    chain(observed("thin", time, 1.3, cells=9))
    with pytest.raises(ValueError, match=r"thin: .* at least 9 cells"):
        chain(observed("thin", time, 1.3, cells=8))


def test_momentum() -> None:
    """κ of heat is 7 N; ⟨Q²⟩ is t^(1 + a), with another a for every rule and gas. Chains have T_1 = 90 and
    T_N = 110. The gas of N = 16 is observed in a ring of T = 4 and cells of length 3 for the time 5.
    Detected mistakes: the rings of fig. 8's own gas among the others; the first time in place of the last."""
    time, octaves = np.array([2.0, 4, 8]), np.sqrt([8, 32])
    runs = [
        observed("thin", time, 1.3),
        observed("thin-rotation", time, 1.2, rule="rotation", rotation_probability=0.1),
        observed("thin-reversal", time, 1.1, rule="reversal", reversal_probability=0.1),
        observed("dense", time, 1.25, fugacity=2.0),
        result(
            "gas-16",
            RING_OF_A_GAS | {"fugacity": 1 / 3, "cell_length": 3.0, "temperature": 4.0},
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
    own = (3,), [1.4], errors_of(np.array([1.4]))
    for part, growth, more in ((noise, (0.3, 0.1, 0.2), []), (gases, (0.3, 0.25), [own])):
        betas = [np.array([1 + a, 1 + a]) for a in growth]
        assert_points(part, *((octaves, y, errors_of(y)) for y in betas), *more)
    ratio = table.ratio.dropna().item()
    assert ratio == pytest.approx(green_kubo / 7 / 16)
    assert f"{ratio:.2f}" in caption
    assert len(table) == 2 + 4 * 3


def test_a_gas_has_its_temperature_and_length() -> None:
    """Detected mistakes: rings at T = 1 and 3, or with λ = 1 and 0.5 at one ζ, are one gas."""
    gases = ({}, {"temperature": 3.0}, {"cell_length": 0.5, "fugacity": 0.5}, {"sigma": 0.3})
    rings = [observed("thin", [1, 3, 7], 4 / 3, **changed) for changed in gases]
    assert len(tabulate(rings)) == 4 * 3
    assert len({*map(gas, rings)}) == 4


def test_an_exponent_is_in_the_row_of_the_time_at_which_its_octave_begins() -> None:
    """A long ring begins where a short one ends. Detected mistake: the last octave of a ring in the row of
    its end."""
    table = tabulate([observed("thin", [4, 8], 1.2), observed("thin", [1, 2, 4], 4 / 3)])
    assert table.time.tolist() == [1, 2, 4, 4, 8]
    known = table.dropna(subset="middle")
    np.testing.assert_allclose(known.middle, known.time * 2**0.5)
    np.testing.assert_allclose(known.local_exponent, [4 / 3, 4 / 3, 1.2])
