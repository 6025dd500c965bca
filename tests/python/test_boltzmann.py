"""The executable that solves the kinetic equation: layout, bad input, coverage of its errors."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest

from tests.python.conftest import SMALL, Program
from workflow.lib.load import Result, load

QUANTITIES = {
    "flux": ["x", "momentum"],
    "flux_density": ["x", "momentum"],
    "scatterer_density": ["x", "momentum"],
    "particle_current": [],
    "energy_current": [],
    "momentum_flux": [],
    "current_spread": [],
    "temperature_scatterer": ["x"],
    "temperature_particle": ["x"],
    "rate_right": ["x"],
    "rate_left": ["x"],
    "jump": ["x"],
    "kurtosis": ["x", "half"],
    "momentum_points": [],
}


@pytest.fixture
def boltzmann(program: Program) -> Program:
    """The program without the options SMALL of the other programs."""
    return partial(program, "boltzmann", **{name.replace("-", "_"): None for name in SMALL})


def solve(boltzmann: Program, folder: Path, **options: object) -> Result:
    result = boltzmann(**options)
    assert result.returncode == 0, result.stderr
    return load(folder / "out.h5")


@pytest.mark.parametrize("options", [{}, {"cells": 7}, {"positions": "0.5", "momentum_bins": 10}])
def test_layout(boltzmann: Program, tmp_path: Path, options: dict) -> None:
    result = solve(boltzmann, tmp_path, **options)
    assert {name: list(quantity.axes) for name, quantity in result.quantities.items()} == {
        name: list(axes) for name, axes in QUANTITIES.items()
    }
    for name, axes in QUANTITIES.items():
        quantity = result[name]
        assert quantity.mean.shape == tuple(len(quantity.axes[axis]) for axis in axes)
        assert quantity.discretisation_error.shape == quantity.mean.shape
        assert quantity.standard_error is None
        assert quantity.count is None
    assert result.converged == "reached"
    assert result.provenance["streams"] == "none"
    assert result.provenance["achieved_error"] <= 1e-10
    assert result["current_spread"].mean < 1e-12
    if "cells" in options:
        np.testing.assert_allclose(result["flux"].axes["x"], np.arange(8) / 7, rtol=1e-15)
        np.testing.assert_allclose(result["temperature_scatterer"].axes["x"], (np.arange(7) + 0.5) / 7)
        assert result.parameters["cells"] == 7
    else:
        assert result.parameters["cells"] == "continuum"


def test_equal_runs_give_equal_bytes(boltzmann: Program, tmp_path: Path) -> None:
    solve(boltzmann, tmp_path)
    once = (tmp_path / "out.h5").read_bytes()
    solve(boltzmann, tmp_path)
    assert (tmp_path / "out.h5").read_bytes() == once


def test_quantities_fit_together(boltzmann: Program, tmp_path: Path) -> None:
    result = solve(boltzmann, tmp_path, momentum_bins=400, momentum_max=150)
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
def test_errors_are_honest(boltzmann: Program, tmp_path: Path, options: dict) -> None:
    """The errors of a loose target cover the difference from a much finer solution. Densities, which are not
    truncated at 0, are negative within their errors only."""
    loose = solve(boltzmann, tmp_path, target_error=1e-3, **options)
    fine = solve(boltzmann, tmp_path, target_error=1e-11, **options)
    for name in set(QUANTITIES) - {"current_spread", "momentum_points"}:
        difference = np.abs(loose[name].mean - fine[name].mean)
        allowed = 2 * loose[name].discretisation_error + 2 * fine[name].discretisation_error
        assert (difference <= allowed).all(), name
        assert (fine[name].discretisation_error <= 2e-8 * np.abs(fine[name].mean).max()).all(), name
    for name in ("flux", "flux_density", "scatterer_density"):
        assert (fine[name].mean >= -fine[name].discretisation_error).all(), name


def test_equilibrium(boltzmann: Program, tmp_path: Path) -> None:
    baths = {"nu_left": 10, "nu_right": 10, "temperature_left": 4, "temperature_right": 4, "momentum_max": 10}
    result = solve(boltzmann, tmp_path, sigma=-0.3, gamma=30, **baths)
    density = result["flux_density"]
    expected = 10 * np.sqrt(2 / (np.pi * 4)) * np.exp(-(density.axes["momentum"] ** 2) / 8)
    np.testing.assert_allclose(density.mean, np.tile(expected, (11, 1)), atol=1e-12 * expected.max())
    assert abs(result["particle_current"].mean) < 1e-12 * 10
    np.testing.assert_allclose(result["temperature_scatterer"].mean, 4, rtol=1e-12)
    np.testing.assert_allclose(result["kurtosis"].mean, 3, rtol=1e-11)
    assert np.abs(result["jump"].mean).max() < 1e-11 * expected.max()


def test_target_out_of_reach_is_said(boltzmann: Program, tmp_path: Path) -> None:
    result = boltzmann(target_error=0, progress="log")
    assert result.returncode == 4
    assert "target not reached" in result.stderr
    assert load(tmp_path / "out.h5").converged == "not reached"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"gamma": "N"}, ["--gamma N", "Give --cells"]),
        ({"coarsening": 5}, ["--coarsening", "[0, 4]"]),
        ({"sigma": 1}, ["--sigma", "[-0.99, 0.99]"]),
        ({"gamma": -1}, ["--gamma", "[0, 1000]"]),
        ({"gamma": 1001}, ["--gamma", "[0, 1000]"]),
        ({"momentum_max": "1e308"}, ["--momentum-max", "the width of a bin"]),
        ({"momentum_max": "1e-320"}, ["--momentum-max", "the width of a bin"]),
        (
            {"momentum_max": "1e-12"},
            ["--momentum-max", "the hotter reservoir's thermal momentum", "[1e-12, "],
        ),
        ({"cells": 0}, ["--cells", "or continuum"]),
        ({"cells": 2.5}, ["--cells", "whole number"]),
        ({"cells": 4, "gamma": 5}, ["--gamma", "--cells", "probability"]),
        ({"cells": 4, "positions": "0.5"}, ["--positions", "bonds"]),
        ({"positions": "0.5,0.2"}, ["--positions", "ascend"]),
        ({"positions": "0.5,1.2"}, ["--positions", "[0, 1]"]),
        ({"nu_left": 0, "nu_right": 0}, ["--nu-left", "no particles"]),
        ({"temperature_left": 0}, ["--temperature-left", "greater than 0"]),
        ({"momentum_bins": 3}, ["--momentum-bins", "odd"]),
    ],
)
def test_bad_input(boltzmann: Program, tmp_path: Path, options: dict, words: list[str]) -> None:
    result = boltzmann(**options)
    assert result.returncode == 2
    for word in words:
        assert word in result.stderr
    assert list(tmp_path.iterdir()) == []
