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
        ({"cells": 1}, "--cells"),
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


@pytest.mark.parametrize(
    ("rule", "conducts"),
    [
        ({"rule": "elastic"}, ()),
        ({"rule": "random-direction"}, (0,)),
        ({"rule": "reversal", "reversal_probability": 0.5}, (0,)),
        ({"rule": "reversal", "reversal_probability": 0}, ()),
        ({"rule": "rotation", "rotation_probability": 0.5}, (0, 1)),
    ],
)
@pytest.mark.parametrize("sigma", [-1, 0, 1])
def test_every_rule_conducts_where_it_exchanges_energy(
    program: Program, tmp_path: Path, rule: dict, conducts: tuple[int, ...], sigma: int
) -> None:
    """And not momenta only. Detected mistakes: a rule that conserves momentum exchanges momenta only;
    scatterers of infinite mass exchange no energy."""
    times = {"relaxation_time": 10, "observation_time": 40}
    done = program("conductivity", cells=3, sigma=sigma, replicas=32, **times, **rule, progress="log")
    assert done.returncode == 0
    result = load(tmp_path / "out.h5")
    assert np.isfinite(result["kappa"].mean) == np.isfinite(result["kappa"].error) == (sigma in conducts)
    assert result.provenance["target_quantity"] == ("kappa" if sigma in conducts else "energy_current")
    assert ("--sigma" in done.stderr) == (sigma not in conducts)


def test_conductivities_are_those_of_the_currents_and_temperatures(program: Program, tmp_path: Path) -> None:
    """[eq. 27]. That of heat leaves out the energy that particles carry: T each on average, the mean of both
    ends. Detected mistakes: the sign; N - 1 gradients; another temperature."""
    program("conductivity", cells=5, replicas=32, observation_time=20)
    result = load(tmp_path / "out.h5")
    names = ("energy_current", "particle_current", "temperature_first", "temperature_last")
    energy, particles, first, last = (float(result[name].mean) for name in names)
    carried = (first + last) / 2 * particles
    expected = np.array([energy, energy - carried]) * -5 / (last - first)
    found = [float(result[name].mean) for name in ("kappa", "kappa_heat")]
    np.testing.assert_allclose(found, expected, rtol=1e-12)
    assert abs(found[1]) > 2 * abs(found[0])  # particles carry energy the other way


def test_slow_particles_that_accumulate_bound_the_error_of_the_current(
    program: Program, tmp_path: Path
) -> None:
    """Without scattering J_n is exactly 40 [eq. 29]. Particles slower than a chain length per time are still
    inside; each is missing at one opening, so that a current, the mean of both, lacks at most half of
    them."""
    window = {"relaxation_time": 10, "observation_time": 100}
    done = program("conductivity", cells=7, gamma=0, replicas=400, **window, progress="log")
    result = load(tmp_path / "out.h5")
    current, gain = result["particle_current"], result["particle_gain"]
    assert result["stationary"].mean == 1
    assert abs(current.mean - 40) > 5 * current.error
    assert abs(current.mean - 40) < 400 / 2 * gain.mean + 4 * np.hypot(current.error, 200 * gain.error)
    assert f"{float(gain.mean):+.2g}" in done.stderr
