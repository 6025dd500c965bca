"""Numbers that panels derive from results, for known laws: local slopes, extrapolations and the quasi-stationary estimate."""

import numpy as np
import pandas as pd
import pytest
from scipy.stats import kstest

from tests.python.conftest import ROOT
from workflow.figures import ext07, ext09, ext13, fig01_inset, fig03_inset, fig09
from workflow.lib.fit import fit_power
from workflow.lib.load import Result
from workflow.physics.closed import quasi_stationary


def test_the_slope_against_the_cube_root_is_constant_for_one_law_only() -> None:
    """Detected mistakes: another power of N; the slope of another law; slopes in wrong rows of the table."""
    size = np.array([16.0, 32, 64, 128])
    table = pd.DataFrame(
        {"cells": size, "kappa": 5 + 7 * np.cbrt(size), "kappa_error": 0.1}, index=[3, 4, 6, 9]
    )
    slopes = ext09.slopes(table)
    assert [*slopes.index] == [3, 4, 6]
    np.testing.assert_allclose(slopes.slope, 7)
    np.testing.assert_allclose(slopes["slope_N^(1/3)"], 7)
    np.testing.assert_allclose(slopes.slope_error, 0.1 * np.sqrt(2) / np.diff(np.cbrt(size)))
    assert (np.diff(slopes.slope_logarithm) < 0).all()
    assert 0 < slopes.slope_constant.iloc[-1] < slopes.slope_logarithm.iloc[-1]


SIZES = np.array([16, 32, 64, 128, 256, 512, 1024, 2048], dtype=float)
TRUTH = {
    "N^(1/3)": 60 + 40 * np.cbrt(SIZES),
    "logarithm": 50 + 40 * np.log(SIZES),
    "constant": 300 - 200 * SIZES ** (-1 / 3),
}


@pytest.mark.parametrize("law", TRUTH)
def test_the_law_is_found_and_its_p_value_is_uniform(law: str) -> None:
    values, p_values = TRUTH[law], []
    for seed in range(200):
        noise = 0.005 * np.random.default_rng(seed).standard_normal(len(values))
        table = pd.DataFrame({"cells": SIZES, "kappa": values * (1 + noise), "kappa_error": 0.005 * values})
        found = ext09.laws(table).set_index("law")
        assert {*found.index} == {*ext09.LAWS}
        p_values.append(found.p_value[law])
        if seed < 20:
            assert found.chi_square.idxmin() == law
    assert kstest(p_values, "uniform").pvalue > 1e-3


def test_slopes_of_a_logarithm_are_its_factor() -> None:
    time = np.geomspace(1, 100, 11)
    table = pd.DataFrame({"time": time, "number": 3 + 8 * np.log(time), "number_error": 0.5})
    slopes = fig01_inset.slopes(table)
    assert [*slopes.dropna().index] == [1, 4, 7]  # the last step ends at the last time
    np.testing.assert_allclose(slopes.slope.dropna(), 8)
    step = 0.3 * np.log(100)
    np.testing.assert_allclose(slopes.slope_error.dropna(), 0.5 * np.sqrt(2) / step)
    np.testing.assert_allclose(slopes.slope_time.dropna(), np.sqrt(time[[1, 4, 7]] * time[[4, 7, 10]]))


@pytest.mark.parametrize("particles", [2, 20])
def test_the_estimate_conserves_energy_and_is_used_at_late_times(particles: int) -> None:
    """Detected mistakes: a factor of 2 or Λ is missing; the iteration has not converged."""
    options = {"particles-per-cell": particles, "temperature": 500.0, "cell-length": 1.0}
    chain = Result(ROOT, options, {}, {})
    time = np.array([0.1, 1.0, 1e3, 1e40])
    scatterer, particle = ext07.estimate(chain, time).values()
    assert np.isnan([scatterer[0], particle[0]]).all()
    np.testing.assert_allclose(particles * particle[1:] + scatterer[1:], particles * 250)
    np.testing.assert_allclose(scatterer[-1], particles * 250, rtol=particles / 80)  # the energy saturates
    a = 1 / (time[2] * np.sqrt(2 * scatterer[2]))
    logarithm = np.log(np.sqrt(2) / a) - np.euler_gamma / 2 + 1  # eq. 13 at late times
    np.testing.assert_allclose(scatterer[2] / particle[2], logarithm, rtol=1e-6)


def test_the_deviation_at_p_0_is_extrapolated_from_both_sides() -> None:
    momentum = np.array([-3.0, -1, 1, 3])
    table = pd.DataFrame({"momentum": momentum, "cells": 4, "kind": fig03_inset.MEAN_FIELD})
    table["deviation"] = np.where(momentum < 0, 5 + momentum, -7 + 0.5 * momentum)
    assert fig03_inset.at_centre(table).to_dict() == {4: 7.0}


def test_diffusion_is_compared_at_equal_scaled_times() -> None:
    """D = ε^-0.4 f(εt), in units in which √T/λ is 2. The ring of ε = 0.001 ends too early. Detected mistake: D at equal times."""
    time = 2.0 ** np.arange(10)
    parts = []
    for epsilon in (0, 0.001, 0.01, 0.1, 0.3):
        scaled = max(epsilon, 1e-9) * 2 * time
        heat = 2 * time * max(epsilon, 1e-9) ** -0.4 * scaled**0.2
        parts.append(pd.DataFrame({"epsilon": epsilon, "time": time, "heat_variance": heat}))
    table = pd.concat(parts).assign(heat_variance_error=lambda rows: 0.02 * rows.heat_variance)
    found = ext13.diffusion(table, 2)
    assert [*found.epsilon] == [0.01, 0.1, 0.3]
    np.testing.assert_allclose(found.diffusion_error / found.diffusion, 0.02)
    law = fit_power(found.epsilon, found.diffusion, found.diffusion_error)
    assert law.exponent == pytest.approx(-0.4)
    assert fit_power(*table[table.time == 64].iloc[1:, [0, 2, 3]].to_numpy().T).exponent != pytest.approx(
        -0.4
    )


def test_the_speed_of_sound_before_the_pulse() -> None:
    """ζ = n/2Λ, and T conserves the energy [eqs. 13, 14, M11], in cells of length 2."""
    options = {
        "particles-per-cell": 50,
        "energy": 5000,
        "cell-length": 2.0,
        "sigma": 0.5,
        "relaxation-time": 1,
    }
    temperature, slow = (values.item() for values in quasi_stationary(50, 1e4, 2, 1))
    assert 50 * temperature / slow + temperature == pytest.approx(50 * 1e4)
    zeta = 50 / (2 * slow)
    speed = np.sqrt(8 * zeta**2 * temperature / ((2 * zeta + 3) * (2 * zeta + 1))) / 2
    assert fig09.sound_speed(Result(ROOT, options, {}, {})) == pytest.approx(speed)
