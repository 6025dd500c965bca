"""The observables of the closed chain against exact results."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.special import erfc

from tests.python.conftest import Program
from workflow.lib.load import Quantity, Result, load

SHORT = {  # options specific to a program
    "waiting_time": {},
    "displacement": {"decades": 2},
    "ageing": {"decades": 2},
    "correlation": {
        "cells": 101,
        "particles-per-cell": None,
        "relaxation-time": None,
        "observation-time": 64,
        "times": "4,8,16",
    },
    "heat_current": {
        "cells": 20,
        "particles-per-cell": None,
        "relaxation-time": None,
        "times": "1,2,4",
        "fit-from": 1,
    },
    "energy_pulse": {
        "cells": 21,
        "particles-per-cell": 20,
        "relaxation-time": 0,
        "observation-time": None,
        "pairs_per_replica": 4,
        "times": "0.01,0.014",
    },
}
QUANTITIES = {
    "correlation": {"momentum_correlation": ["time", "cell"], "heat_correlation": ["time", "cell"], "peak_area": ["time"],
                    "centroid": ["time"], "sound_speed": ["middle"], "heat_area": ["time"], "peak_width": ["time"],
                    "peak": ["time"], "peak_position": ["time"], "peak_raw": ["time"], "peak_speed": ["middle"],
                    "local_damping_exponent": ["until"], "damping_drift": [], "damping_exponent": [], "damping_exponent_from": ["from"],
                    "peak_collapse": []},
    "heat_current": {"heat_variance": ["time"], "number_variance": ["time"], "local_exponent": ["middle"], "amplitude": [],
                     "diffusion": []},
    "waiting_time": {"density": ["tau"], "exponent": [], "exponent_by_cut": ["cut"], "exponent_spread": []},
    "displacement": {"variance": ["time"], "absolute_moment": ["time"], "fourth_moment": ["time"], "alpha": [],
                     "centre_of_mass": ["time"], "mean_displacement": ["time"], "local_slope": ["time"], "alpha_relative": [], "alpha_difference": [],
                     "variance_plain": ["time"], "alpha_plain": []},
    "ageing": {"scatterer_energy": ["time"], "particle_energy": ["time"], "log_slope": [],
               "scatterer_energy_mean": ["window"], "decade_slope": ["decade"]},
    "energy_pulse": {"energy_difference": ["time", "cell"], "injected_energy": [], "sum_error": [], "peak": ["time"],
                     "peak_position": ["time"], "peak_raw": ["time"], "centre_share": ["time"],
                     "odd_part": ["time", "distance"], "peak_speed": ["middle"], "local_damping_exponent": ["until"], "damping_drift": [],
                     "damping_exponent": [], "damping_exponent_from": ["from"], "peak_collapse": []},
}  # fmt: skip


def run(program: Program, folder: Path, name: str, **options: object) -> Result:
    result = program(name, **options)
    assert result.returncode == 0, result.stderr
    return load(folder / "out.h5")


def score(quantity: Quantity, expected: float) -> float:
    return float((quantity.mean - expected) / quantity.standard_error)


@pytest.mark.parametrize("name", SHORT)
def test_layout_and_threads(program: Program, tmp_path: Path, name: str) -> None:
    options = {key.replace("-", "_"): value for key, value in SHORT[name].items()}
    result = run(program, tmp_path, name, threads=1, **options)
    one = (tmp_path / "out.h5").read_bytes()
    run(program, tmp_path, name, threads=3, **options)
    assert (tmp_path / "out.h5").read_bytes() == one
    found = {key: set(quantity.axes) for key, quantity in result.quantities.items()}
    expected = {key: set(axes) for key, axes in QUANTITIES[name].items()}
    drifts = {} if name == "energy_pulse" else {"energy_drift": set(), "momentum_drift": set()}
    assert found == expected | drifts
    for quantity, axes in QUANTITIES[name].items():
        assert result[quantity].mean.shape == tuple(len(result[quantity].axes[axis]) for axis in axes)


def test_waiting_times_at_sigma_0_are_the_exact_ones(program: Program, tmp_path: Path) -> None:
    """Many particles per cell, because the law neglects the time of order 1/n for which a scatterer holds a
    momentum between two flights [eq. 17]."""
    result = run(
        program, tmp_path, "waiting_time", sigma=0, replicas=64, cells=11, particles_per_cell=320,
        relaxation_time=5, observation_time=20,
    )  # fmt: skip
    density = result["density"]
    tau = density.axes["tau"]
    thermal = 1 / np.sqrt(500)
    seen = (tau > thermal / 2) & (tau < 30 * thermal)
    low, high = tau[seen] * 10**-0.05, tau[seen] * 10**0.05

    def largest_score(below: Callable[[np.ndarray], np.ndarray]) -> float:
        """Largest z-score; below(t) is the probability of a waiting time below t."""
        expected = (below(high) - below(low)) / (high - low)
        return float(np.abs((density.mean[seen] - expected) / density.standard_error[seen]).max())

    assert largest_score(lambda t: np.exp(-((thermal / t) ** 2) / 2)) < 4
    # Mutants: another temperature; momenta without the flux weight.
    assert largest_score(lambda t: np.exp(-1.05 * (thermal / t) ** 2 / 2)) > 4
    assert largest_score(lambda t: erfc(thermal / t / np.sqrt(2))) > 40


def test_waiting_time_exponent(program: Program, tmp_path: Path) -> None:
    result = run(
        program, tmp_path, "waiting_time", sigma=0.5, replicas=64, cells=11, particles_per_cell=20,
        relaxation_time=10, observation_time=50,
    )  # fmt: skip
    assert abs(score(result["exponent"], -2)) < 4
    assert abs(score(result["exponent"], -3)) > 20


def test_displacement_begins_ballistically(program: Program, tmp_path: Path) -> None:
    result = run(
        program,
        tmp_path,
        "displacement",
        sigma=0.5,
        replicas=400,
        relaxation_time=0,
        observation_time=1e-4,
        decades=1,
    )
    variance = result["variance"]
    time = variance.axes["time"]
    z = (variance.mean / time**2 - 500) / (variance.standard_error / time**2)
    assert np.abs(z).max() < 4
    assert np.abs(result["local_slope"].mean - 2).max() < 0.01  # a few particles have collided by then
    fourth = result["fourth_moment"]
    assert abs((fourth.mean[0] / time[0] ** 4 - 3 * 500**2) / (fourth.standard_error[0] / time[0] ** 4)) < 4


FEW = {"cells": 4, "particles_per_cell": 5, "observation_time": 20, "decades": 1, "relaxation_time": 1}


def test_displacement_with_known_momentum(program: Program, tmp_path: Path) -> None:
    """Over seeds both estimates agree, also with moving scatterers at the start, and one has the smaller error."""
    found = []
    for seed in range(50):
        result = run(program, tmp_path, "displacement", **FEW, sigma=0.8, scatterer_temperature=500,
                     replicas=40, seed=seed)  # fmt: skip
        pair = (result["variance"], result["variance_plain"])
        found.append([(each.mean[-1], each.standard_error[-1]) for each in pair])
    (reduced, error), (plain, plain_error) = np.moveaxis(np.array(found), 0, -1)

    def difference(factor: float) -> float:
        sample = factor * reduced - plain
        return abs(float(sample.mean() / sample.std(ddof=1))) * np.sqrt(len(sample))

    assert difference(1) < 4
    # Mutant: the mean square of the particles' momentum only, 20 / (20 + 4 x 9) of the total.
    assert difference(20 / 56) > 10
    assert np.mean(plain_error**2) > 10 * np.mean(error**2)


@pytest.mark.parametrize("option", ["zero_total_momentum", "random_direction"])
def test_displacement_without_a_random_momentum_that_lasts(
    program: Program, tmp_path: Path, option: str
) -> None:
    result = run(program, tmp_path, "displacement", **FEW, **{option: True}, replicas=20)
    for name in ("variance", "alpha"):
        assert np.array_equal(result[name].mean, result[f"{name}_plain"].mean)


def test_walls_confine(program: Program, tmp_path: Path) -> None:
    """At sigma = 1 every particle is confined between two scatterers; at -1 it flies freely."""
    confined = run(program, tmp_path, "displacement", sigma=1, observation_time=100, decades=2)["variance"]
    assert confined.mean.max() <= 1
    free = run(program, tmp_path, "displacement", sigma=-1, observation_time=100, decades=2)
    np.testing.assert_allclose(free["alpha"].mean, 2, atol=1e-9)


def test_random_direction_conserves_energy(program: Program, tmp_path: Path) -> None:
    result = run(program, tmp_path, "displacement", random_direction=True, observation_time=50)
    assert result["energy_drift"].mean < 1e-13
    assert np.isnan(result["momentum_drift"].mean)


def test_ageing_moves_energy_from_particles_to_scatterers(program: Program, tmp_path: Path) -> None:
    result = run(
        program, tmp_path, "ageing", replicas=64, cells=11, particles_per_cell=20, relaxation_time=0,
        observation_time=100, decades=5,
    )  # fmt: skip
    scatterer, particle = result["scatterer_energy"], result["particle_energy"]
    total = 220 * particle.mean + 11 * scatterer.mean
    np.testing.assert_allclose(total, total[0], rtol=1e-12)
    assert scatterer.mean[0] < 250
    assert scatterer.mean[-1] > 1000
    assert score(result["log_slope"], 0) > 5


def test_pulse(program: Program, tmp_path: Path) -> None:
    result = run(
        program, tmp_path, "energy_pulse", cells=31, particles_per_cell=50, relaxation_time=0, observation_time=None,
        replicas=32, pairs_per_replica=4, times="0.001,0.01,0.02",
    )  # fmt: skip
    # The mean energy of 51 degrees of freedom rises from 5000 to 50000 each, and the sum is conserved.
    assert abs(score(result["injected_energy"], 51 * 45000)) < 4
    assert abs(score(result["injected_energy"], 50 * 45000)) > 4
    assert result["sum_error"].mean < 1e-13
    difference = result["energy_difference"]
    sums = difference.mean.sum(axis=1)
    np.testing.assert_allclose(sums, float(result["injected_energy"].mean), rtol=1e-12)
    # The fastest particles of the pulse, sqrt(10) times faster than thermal ones, are still near.
    assert (difference.mean[0, :12] == 0).all()
    assert (difference.mean[0, 19:] == 0).all()


@pytest.mark.parametrize(
    ("name", "options", "words"),
    [
        ("energy_pulse", {"times": "0.02,0.01"}, ["--times", "ascend"]),
        ("energy_pulse", {"times": "0.02,x"}, ["--times", "'0.02,x'", "ascending"]),
        ("energy_pulse", {"times": "0.02"}, ["--times", "Add another"]),
        ("energy_pulse", {"times": "0.01,0.02", "pulse_cells": 22}, ["--pulse-cells", "smaller"]),
        ("energy_pulse", {"times": "0.01,0.02", "pulse_cells": 2}, ["--pulse-cells", "odd"]),
        ("energy_pulse", {"times": "0.01,0.02", "gamma": "M"}, ["--gamma", "'M'", "or N"]),
        ("energy_pulse", {"times": "0.01,0.02", "gamma": "0"}, ["--gamma", "greater than 0"]),
        ("displacement", {"decades": "0"}, ["--decades", "[1, 15]"]),
    ],
)
def test_bad_input(program: Program, tmp_path: Path, name: str, options: dict, words: list[str]) -> None:
    base = {key.replace("-", "_"): value for key, value in SHORT[name].items()}
    result = program(name, **{**base, **options})
    assert result.returncode == 2
    for word in words:
        assert word in result.stderr
    assert list(tmp_path.iterdir()) == []
