"""Correlations of a closed chain: particles that fly freely against the exact result, and a chain that scatters against
the reference simulator, which shares no code with the program."""

import subprocess
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import chi2

from tests.python.conftest import ROOT, Program
from workflow.lib.load import Result, load

FIELDS = ("number", "energy", "momentum")
CELLS, PARTICLES, TEMPERATURE, SCATTERERS, SIGMA = 15, 6, 400.0, 900.0, 0.5
MASS = (1 + SIGMA) / (1 - SIGMA)
CHAIN = {"cells": CELLS, "particles_per_cell": PARTICLES, "temperature": TEMPERATURE,
         "scatterer_temperature": SCATTERERS, "sigma": SIGMA}  # fmt: skip


@pytest.fixture
def correlation(program: Program, tmp_path: Path) -> Callable[..., Result]:
    def measure(**options: object) -> Result:
        done = program("correlation", **CHAIN | options)
        assert done.returncode in (0, 4), done.stderr  # 4: without a moving peak
        return load(tmp_path / "out.h5")

    return measure


def by_distance(profile: np.ndarray) -> np.ndarray:
    return np.roll(profile, -(CELLS // 2), axis=-1)


def overlap(shift: float, distance: int) -> float:
    """Probability that a particle that begins anywhere in a cell and moves by `shift` cells ends that many cells on."""
    turns = distance + CELLS * np.arange(-6, 7)
    return float(np.maximum(0, 1 - np.abs(shift - turns)).sum())


def free_flight(weight: Callable[[float], float], distance: int, time: float) -> float:
    """Mean over the Gaussian of the weight times the probability to arrive."""
    thermal = np.sqrt(TEMPERATURE)
    edges = np.arange(-8 * thermal * time, 8 * thermal * time, 0.5)

    def integrand(shift: float) -> float:
        u = shift / time
        return weight(u) * overlap(shift, distance) * np.exp(-(u**2) / (2 * TEMPERATURE))

    parts = [quad(integrand, a, a + 0.5)[0] for a in edges]
    return sum(parts) / time / np.sqrt(2 * np.pi * TEMPERATURE)


def of_free_flight(time: float) -> dict[str, np.ndarray]:
    distances = np.arange(CELLS)
    powers = {"number": lambda u: 1.0, "energy": lambda u: u**4 / 4, "momentum": lambda u: u**2}
    exact = {
        name: PARTICLES * np.array([free_flight(weight, r, time) for r in distances])
        for name, weight in powers.items()
    }
    exact["number"] -= PARTICLES / CELLS
    exact["energy"] -= PARTICLES * (TEMPERATURE / 2) ** 2 / CELLS  # the number of particles is fixed
    exact["energy"][0] += SCATTERERS**2 / 2  # scatterers keep theirs
    exact["momentum"][0] += MASS * SCATTERERS
    return exact


def scores(
    result: Result, index: int, expected: dict[str, np.ndarray], errors: dict[str, np.ndarray] | None = None
):
    """z of every field up to half the ring; the other half is the same."""
    half = slice(0, CELLS // 2 + 1)
    found = {}
    for name in FIELDS:
        quantity = result[f"{name}_correlation"]
        error = by_distance(quantity.standard_error[index])[half]
        if errors:
            error = np.hypot(error, errors[name][half])
        found[name] = (by_distance(quantity.mean[index]) - expected[name])[half] / error
    return found


def accepted(z: np.ndarray) -> bool:
    """Distances are correlated by the sum rule, so only the largest score and a generous sum count."""
    return bool(np.abs(z).max() < 4.2 and np.sum(z**2) < 2 * chi2.ppf(1 - 1e-4, len(z)))


def test_free_flight(correlation: Callable[..., Result]) -> None:
    """No particle meets a scatterer within the run."""
    free = {
        "gamma": 1e-12,
        "relaxation_time": 2,
        "observation_time": 0.4,
        "times": "0.02,0.06",
        "replicas": 2000,
    }
    result = correlation(**free)
    for index, time in enumerate((0.02, 0.06)):
        for name, z in scores(result, index, of_free_flight(time)).items():
            assert accepted(z), (name, time, z)
    # Mutants: another time; fluctuations about the ring's own mean, whose variance is not put back.
    assert not accepted(scores(result, 1, of_free_flight(0.045))["momentum"])
    for name, z in scores(result, 0, of_free_flight(0.02)).items():
        total = {"number": 0, "energy": (PARTICLES * TEMPERATURE**2 + SCATTERERS**2) / 2,
                 "momentum": PARTICLES * TEMPERATURE + MASS * SCATTERERS}[name]  # fmt: skip
        if name != "number":
            error = by_distance(result[f"{name}_correlation"].standard_error[0])[: len(z)]
            assert not accepted(z - total / CELLS / error)


@cache
def reference(relaxation: float, lag: float, replicas: int) -> np.ndarray:
    """[replica, field, distance]"""
    words = [
        ROOT / "build/bin/reference_correlation",
        CELLS,
        PARTICLES,
        SIGMA,
        TEMPERATURE,
        SCATTERERS,
        relaxation,
        lag,
    ]
    command = [str(word) for word in [*words, replicas, 1]]
    output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    rows = [[float(word) for word in line.split()] for line in output.splitlines()]
    return np.array(rows).reshape(replicas, len(FIELDS), CELLS)


@pytest.mark.parametrize("lag", [0.05, 0.15])
def test_against_the_reference(correlation: Callable[..., Result], lag: float) -> None:
    sample = reference(0.3, lag, 6000)
    mean, error = sample.mean(axis=0), sample.std(axis=0, ddof=1) / np.sqrt(len(sample))
    expected = dict(zip(FIELDS, mean, strict=True))
    errors = dict(zip(FIELDS, error, strict=True))
    run = {"relaxation_time": 0.3, "observation_time": lag, "times": f"{lag / 5},{lag}", "replicas": 4000}
    z = scores(correlation(**run), 1, expected, errors)
    assert all(accepted(one) for one in z.values()), z
    # Mutant: lighter scatterers.
    lighter = scores(correlation(**run, sigma=0.35), 1, expected, errors)
    assert not all(accepted(one) for one in lighter.values())


def test_sums_over_the_ring_are_known(correlation: Callable[..., Result]) -> None:
    """Number, energy and momentum are conserved: exact in every run."""
    run = {"relaxation_time": 0.2, "observation_time": 0.4, "times": "0.1,0.2,0.4", "replicas": 3}
    result = correlation(**run)
    totals = {"number": 0, "energy": (PARTICLES * TEMPERATURE**2 + SCATTERERS**2) / 2,
              "momentum": PARTICLES * TEMPERATURE + MASS * SCATTERERS}  # fmt: skip
    for name, total in totals.items():
        np.testing.assert_allclose(
            result[f"{name}_correlation"].mean.sum(axis=1), total, rtol=1e-9, atol=1e-9
        )
    still = correlation(**run, zero_total_momentum=True)
    np.testing.assert_allclose(
        still["momentum_correlation"].mean.sum(axis=1), 0, atol=1e-9 * totals["momentum"]
    )
    free_to_move = (1 + MASS / PARTICLES) ** 2
    energy = ((PARTICLES - 1 / CELLS) * TEMPERATURE**2 + (1 + (free_to_move - 1) / CELLS) * SCATTERERS**2) / 2
    np.testing.assert_allclose(still["energy_correlation"].mean.sum(axis=1), energy, rtol=1e-9)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"times": "0.02,0.03"}, "whole multiple"),
        ({"times": "0.1"}, "Add another"),
        ({"times": "0.1,0.2", "observation_time": 0.15}, "--observation-time"),
        ({"cells": 5}, "Choose more cells"),
        ({"times": "1e-9,1"}, "whole multiple"),
    ],
)
def test_refused(program: Program, tmp_path: Path, options: dict, words: str) -> None:
    done = program("correlation", **CHAIN | {"relaxation_time": 1, "observation_time": 1} | options)
    assert done.returncode == 2
    assert words in done.stderr
    assert not (tmp_path / "out.h5").exists()
