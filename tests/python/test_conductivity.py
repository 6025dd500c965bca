"""Conductivities that are not defined: the reason and the remedy are in the last lines."""

from pathlib import Path

import numpy as np
import pytest

from tests.python.conftest import Program
from workflow.lib.load import load


@pytest.mark.parametrize(("gamma", "needed"), [("N", 18), (1, 24)])
def test_control_variates_need_replicas(program: Program, tmp_path: Path, gamma: object, needed: int) -> None:
    """max(3k, k + 8) for the six of the injections, and two of the end scatterers if not every particle is
    scattered."""
    for replicas in (needed - 1, needed):
        done = program("conductivity", gamma=gamma, replicas=replicas, progress="log")
        used = load(tmp_path / "out.h5")["energy_current"].control_variates > 0
        assert used == (replicas == needed)
        assert (f"control variates, which need {needed} replicas" in done.stderr) != used


@pytest.mark.parametrize(
    ("options", "remedy"),
    [
        ({"nu_left": 0, "nu_right": 0}, "--nu-right"),
        ({"temperature_left": 100, "temperature_right": 100}, "--temperature-right"),
        ({"cells": 1}, "--cells"),
        ({"sigma": 0, "rule": "reversal", "reversal_probability": 0}, "--sigma"),
        # No particle scatters: the difference of the temperatures is noise.
        ({"gamma": 1e-20, "observation_time": 20, "replicas": 32}, "T_N - T_1"),
    ],
)
def test_a_conductivity_that_is_not_defined(
    program: Program, tmp_path: Path, options: dict, remedy: str
) -> None:
    done = program("conductivity", **options, progress="log")
    assert done.returncode == 0
    line = next(line for line in done.stderr.splitlines() if "kappa is not defined: " in line)
    assert remedy in line
    result = load(tmp_path / "out.h5")
    assert np.isnan(result["kappa"].mean)
    defined = result.provenance["target_quantity"] if remedy.startswith("--") else "temperature_last"
    assert defined in ("energy_current", "temperature_last")
    assert np.isfinite(result[defined].mean)


def test_the_conductivity_of_heat_leaves_out_the_energy_that_particles_carry(
    program: Program, tmp_path: Path
) -> None:
    """Each carries T on average, the mean temperature of both ends."""
    program("conductivity", cells=4, replicas=32, observation_time=20)
    result = load(tmp_path / "out.h5")
    names = (
        "energy_current",
        "particle_current",
        "temperature_first",
        "temperature_last",
        "kappa",
        "kappa_heat",
    )
    energy, particles, first, last, kappa, heat = (float(result[name].mean) for name in names)
    per_rise = 4 / (last - first)
    np.testing.assert_allclose(heat, -(energy - (first + last) / 2 * particles) * per_rise, rtol=1e-12)
    assert abs(heat) > 2 * abs(kappa)  # particles carry energy the other way
