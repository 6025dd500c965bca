"""The program that solves the kinetic equation: axes, consistency of its quantities, coverage of its
errors."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest

from tests.python.conftest import Measure, Program
from workflow.lib.load import load


@pytest.fixture
def solve(measure: Measure) -> Measure:
    return partial(measure, "boltzmann")


def test_kinetic_solution_is_at_bonds_scatterers_or_given_positions(solve: Measure) -> None:
    """Bonds and scatterers of a chain; in the continuum all quantities are at the positions given."""
    chain = solve(cells=7)
    np.testing.assert_allclose(chain["flux"].axes["x"], np.arange(8) / 7, rtol=1e-15)
    np.testing.assert_allclose(chain["temperature_scatterer"].axes["x"], (np.arange(7) + 0.5) / 7)
    assert chain["current_spread"].mean < 1e-12
    rise = np.diff(chain["temperature_scatterer"].mean[[0, -1]]).item()
    assert chain["kappa"].mean == pytest.approx(-7 * float(chain["energy_current"].mean) / rise)
    continuum = solve(positions="0.25,0.5", momentum_bins=10)
    assert np.isnan(continuum["kappa"].mean)
    assert continuum["flux"].mean.shape == (2, 10)
    for name in ("flux", "temperature_scatterer"):
        np.testing.assert_array_equal(continuum[name].axes["x"], [0.25, 0.5])
    assert continuum.converged == "reached"


def test_kinetic_currents_and_rates_are_sums_of_the_flux(solve: Measure) -> None:
    result = solve(momentum_bins=400, momentum_max=150)
    flux, p = result["flux"].mean, result["flux"].axes["momentum"]
    width = p[1] - p[0]
    current = float(result["particle_current"].mean)
    np.testing.assert_allclose(flux @ np.sign(p) * width, current, rtol=1e-10)
    np.testing.assert_allclose(result["rate_right"].mean - result["rate_left"].mean, current, rtol=1e-12)
    np.testing.assert_allclose(result["rate_right"].mean[0], 220, rtol=1e-12)
    np.testing.assert_allclose(result["rate_left"].mean[-1], 180, rtol=1e-12)
    # The mean over a bin differs from the value at its middle by width^2 F''/24.
    density = result["flux_density"].mean
    inner = slice(1, 199)
    curvature = (density[:, 2:200] - 2 * density[:, inner] + density[:, 0:198]) / 24
    np.testing.assert_allclose(flux[:, inner] - density[:, inner], curvature, atol=1e-5)

    g = result["scatterer_density"]
    root_mass = np.sqrt(3)
    np.testing.assert_allclose(g.axes["momentum"], root_mass * p, rtol=1e-14)
    step = root_mass * width
    np.testing.assert_allclose(g.mean.sum(axis=1) * step, 1, rtol=1e-7)
    square = (g.mean * g.axes["momentum"] ** 2).sum(axis=1) * step / 3
    np.testing.assert_allclose(square, result["temperature_scatterer"].mean, rtol=1e-6)


@pytest.mark.parametrize(
    "options", [{}, {"sigma": -0.9, "gamma": 20}, {"sigma": 0.03}, {"cells": 5, "gamma": 5}]
)
def test_discretisation_errors_cover_the_distance_from_a_finer_solution(
    solve: Measure, options: dict
) -> None:
    """The errors of a loose target cover the difference from a much finer solution. Densities, which are not
    truncated at 0, are negative within their errors only."""
    loose = solve(target_error=1e-3, **options)
    fine = solve(target_error=1e-11, **options)
    without = {"current_spread", "momentum_points"} | (set() if "cells" in options else {"kappa"})
    for name in loose.quantities.keys() - without:
        difference = np.abs(loose[name].mean - fine[name].mean)
        allowed = 2 * loose[name].discretisation_error + 2 * fine[name].discretisation_error
        assert (difference <= allowed).all(), name
        assert (fine[name].discretisation_error <= 2e-8 * np.abs(fine[name].mean).max()).all(), name
    for name in ("flux", "flux_density", "scatterer_density"):
        assert (fine[name].mean >= -fine[name].discretisation_error).all(), name


def test_kinetic_solution_between_equal_baths_is_gaussian(solve: Measure) -> None:
    baths = {"nu_left": 10, "nu_right": 10, "temperature_left": 4, "temperature_right": 4, "momentum_max": 10}
    result = solve(sigma=-0.3, gamma=30, **baths)
    density = result["flux_density"]
    expected = 10 * np.sqrt(2 / (np.pi * 4)) * np.exp(-(density.axes["momentum"] ** 2) / 8)
    np.testing.assert_allclose(density.mean, np.tile(expected, (11, 1)), atol=1e-12 * expected.max())
    assert abs(result["particle_current"].mean) < 1e-12 * 10
    np.testing.assert_allclose(result["temperature_scatterer"].mean, 4, rtol=1e-12)
    np.testing.assert_allclose(result["kurtosis"].mean, 3, rtol=1e-11)
    assert np.abs(result["jump"].mean).max() < 1e-11 * expected.max()


def test_target_out_of_reach_is_reported(program: Program, tmp_path: Path) -> None:
    result = program("boltzmann", target_error=0, progress="log")
    assert result.returncode == 4
    assert "target not reached" in result.stderr
    assert load(tmp_path / "out.h5").converged == "not reached"


@pytest.mark.parametrize("options", [{"gamma": 0}, {"gamma": 1e-10}, {"nu_left": 0}])
def test_currents_are_constant_in_extreme_limits(solve: Measure, options: dict) -> None:
    result = solve(**{"gamma": 1, "coarsening": 2, "target_error": 1e-6} | options)
    assert result["current_spread"].mean < 2e-15


def test_an_iteration_that_does_not_converge_is_a_numerical_failure(program: Program) -> None:
    baths = {"nu_left": 0, "nu_right": 1, "temperature_left": 1, "temperature_right": 1}
    done = program("boltzmann", sigma=-0.99, gamma=50, coarsening=4, **baths)
    assert done.returncode == 3
    assert done.stderr.startswith("boltzmann: numerical failure: Newton's iteration")
