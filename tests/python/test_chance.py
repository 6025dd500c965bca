"""Randomness of every program: closed chains agree with the reference simulator, means that are 0 by symmetry
are 0, and results of different seeds scatter as their errors predict.

Tests of errors alone check only that a seed reproduces its results and that results scatter over replicas and
seeds as the errors predict. They do not detect directions or passes common to all replicas and seeds, which
shift every result alike.
"""

import subprocess
from collections.abc import Callable
from dataclasses import asdict, dataclass, fields, replace
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import norm, t

from tests.python.conftest import ROOT, Program
from workflow.lib.load import Quantity, Result, load


def run(program: Program, folder: Path, name: str, **options: object) -> Result:
    done = program(name, threads=1, **options)
    assert done.returncode in (0, 4), done.stderr  # 4: a pulse so small has no damping exponent
    return load(folder / "out.h5")


@dataclass(frozen=True)
class Chain:
    """Few particles in many replicas, so that errors common to all replicas exceed the standard errors."""

    sigma: float = 0.5
    gamma: float | str = "N"
    random_direction: bool = False
    cells: int = 6
    particles_per_cell: int = 1
    temperature: float = 500
    relaxation_time: float = 0.5
    observation_time: float = 5
    replicas: int = 8000

    @property
    def options(self) -> dict[str, object]:
        """Options of a program. A flag is given only if it is set, because only `displacement` has it."""
        return {name: value for name, value in asdict(self).items() if value is not False}

    def __str__(self) -> str:
        directions = "drawn" if self.random_direction else "kept"
        return f"sigma={self.sigma},gamma={self.gamma},{directions},cells={self.cells}"


DECADES, POINTS_PER_DECADE, EVERY = 2, 8, 4  # times of the programs; every fourth is compared
BINS_PER_DECADE, BINS = 10, 50  # of waiting times


def waiting_time_edges(chain: Chain) -> np.ndarray:
    return 1e-3 / np.sqrt(chain.temperature) * 10 ** (np.arange(BINS + 1) / BINS_PER_DECADE)


@cache
def reference(chain: Chain) -> dict[str, np.ndarray]:
    """Measurements of the reference simulator, [replica, ...]."""
    gamma = chain.cells if chain.gamma == "N" else chain.gamma
    times = chain.observation_time * 10 ** np.arange(-DECADES, 0.01, EVERY / POINTS_PER_DECADE)
    words = [chain.cells, chain.particles_per_cell, chain.sigma, gamma, chain.temperature]
    words += [chain.relaxation_time, chain.observation_time, "drawn" if chain.random_direction else "kept"]
    words += [chain.replicas, 1, waiting_time_edges(chain)[0], BINS_PER_DECADE, BINS, *times]
    command = [str(word) for word in (ROOT / "build/bin/reference_closed_chain", *words)]
    output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    rows = np.array([[float(word) for word in line.split()] for line in output.splitlines()])
    moments, scatterings, persistent, waits = np.split(rows, 4 * len(times) + np.arange(3), axis=1)
    names = ("variance", "centre_of_mass", "mean_displacement", "scatterer_energy")
    found = dict(zip(names, np.moveaxis(moments.reshape(chain.replicas, -1, 4), 2, 0), strict=True))
    return found | {"scatterings": scatterings, "persistent": persistent, "waits": waits}


def average(sample: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return sample.mean(axis=0), sample.std(axis=0, ddof=1) / np.sqrt(len(sample))


def ratio(counts: np.ndarray, totals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Ratio of sums over replicas, with its standard error to first order."""
    value = counts.sum(axis=0) / totals.sum()
    return value, average((counts - value * totals) / totals.mean())[1]


Measured = dict[str, tuple[np.ndarray, np.ndarray]]  # means and standard errors


def measured(program: Program, folder: Path, chain: Chain) -> Measured:
    """Measurements of the programs."""
    found: Measured = {}

    def measure(name: str, quantities: list[str], every: int = 1, **options: object) -> None:
        result = run(program, folder, name, **chain.options, **options)
        for key in quantities:
            found[key] = tuple(np.ravel(x)[::every] for x in (result[key].mean, result[key].standard_error))

    moments = ["variance", "variance_plain", "centre_of_mass", "mean_displacement"]
    measure("displacement", moments, EVERY, decades=DECADES)
    if not chain.random_direction:
        measure("ageing", ["scatterer_energy"], EVERY, decades=DECADES)
        measure("persistence", ["mu"])
        measure("waiting_time", ["density"])
    return found


def scores(found: Measured, chain: Chain) -> dict[str, np.ndarray]:
    """z-scores of all measurements against the reference simulator."""
    sample = reference(chain)
    expected = {
        name: average(sample[name.removesuffix("_plain")]) for name in found if name not in ("mu", "density")
    }
    often = sample["waits"].sum(axis=0) > 200  # often enough for a normal mean
    if "mu" in found:
        expected["mu"] = ratio(sample["persistent"], sample["scatterings"])
        widths = np.diff(waiting_time_edges(chain))
        density = ratio(sample["waits"], sample["scatterings"])
        expected["density"] = tuple((x / widths)[often] for x in density)
        found = found | {"density": tuple(x[:BINS][often] for x in found["density"])}
    return {
        name: (found[name][0] - mean) / np.hypot(found[name][1], error)
        for name, (mean, error) in expected.items()
    }


def agree(z: dict[str, np.ndarray]) -> bool:
    """Bound for the largest of as many independent normal scores; correlations reduce the largest."""
    every = np.concatenate([np.ravel(each) for each in z.values()])
    return bool(np.abs(every).max() < norm.isf(1e-4 / 2 / every.size))


CHAINS = [
    *(Chain(sigma, gamma) for gamma in ("N", 3, 1, 0.3) for sigma in (0.5, -0.4)),
    *(Chain(sigma, gamma, random_direction=True) for gamma in ("N", 1) for sigma in (0.5, -0.4)),
    # The paper's chain.
    Chain(
        random_direction=True,
        cells=11,
        particles_per_cell=20,
        relaxation_time=20,
        observation_time=100,
        replicas=100,
    ),
]


@pytest.mark.parametrize("chain", CHAINS, ids=str)
def test_closed_chain_against_the_reference_simulator(program: Program, tmp_path: Path, chain: Chain) -> None:
    z = scores(measured(program, tmp_path, chain), chain)
    assert agree(z), z


@pytest.mark.parametrize("chain", [Chain(gamma=1), Chain(gamma=1, random_direction=True)], ids=str)
def test_another_chain_does_not_agree(program: Program, tmp_path: Path, chain: Chain) -> None:
    found = measured(program, tmp_path, chain)
    assert agree(scores(found, chain))
    for mutant in ({"sigma": 0.44}, {"gamma": 1.1}, {"temperature": 450}, {"relaxation_time": 1}):
        assert not agree(scores(found, replace(chain, **mutant))), mutant
    assert not agree(scores(found, replace(chain, random_direction=not chain.random_direction)))


SEEDS, SEED_REPLICAS = 40, 40


@dataclass(frozen=True)
class Seen:
    """Results of one seed: numbers with mean 0 by symmetry, and means with their standard errors."""

    odd: np.ndarray
    means: np.ndarray
    errors: np.ndarray


def signed(quantity: Quantity) -> Seen:
    """Signed quantity at three times, or at a single one."""
    every = max(1, quantity.mean.size // 2)
    means, errors = (np.ravel(x)[::every] for x in (quantity.mean, quantity.standard_error))
    return Seen(means, means, errors)


def flux_by_direction(result: Result) -> Seen:
    rate = result["rate"]
    left, right = rate.mean.T
    middle = len(left) // 2
    return Seen(np.array([np.mean(right - left)]), rate.mean[middle], rate.standard_error[middle])


def pulse(result: Result, shift: int = 0) -> Seen:
    """At every time, sums over the distance d from the centre of right minus left half times 1, d, d^2."""
    difference = result["energy_difference"]
    centre = difference.mean.shape[1] // 2
    profiles = np.roll(difference.mean, shift, axis=1)
    odd = (profiles[:, centre + 1 :] - profiles[:, :centre][:, ::-1]) @ np.vander(np.arange(1, centre + 1), 3)
    near = np.s_[:, centre - 1 : centre + 2 : 2]
    return Seen(odd.ravel(), difference.mean[near].ravel(), difference.standard_error[near].ravel())


def momenta(result: Result) -> Seen:
    """At every time, sums over p of |p| n(p) times sign(p), for all and for slow particles, and times p."""
    density = result["weighted_momentum_density"]
    p = density.axes["p"]
    odd = density.mean @ np.column_stack([np.sign(p), np.sign(p) * (np.abs(p) < 10), p])
    thermal = np.flatnonzero(np.abs(np.abs(p) - 10) < 1)[::2]
    return Seen(odd.ravel(), density.mean[:, thermal].ravel(), density.standard_error[:, thermal].ravel())


Reader = Callable[[Result], Seen]
READERS: dict[str, Reader] = {
    "displacement": lambda result: signed(result["mean_displacement"]),
    "conductivity": lambda result: signed(result["particle_current_plain"]),
    "steady_profile": lambda result: signed(result["particle_current_mean"]),
    "momentum_flux": flux_by_direction,
    "energy_pulse": pulse,
    "particle_count": momenta,
}
OPEN = {"cells": 5, "particles_per_cell": None, "temperature_left": 100, "temperature_right": 100}
OPEN |= {"nu_left": 200, "nu_right": 200, "relaxation_time": 1, "observation_time": 2}
SETTINGS = {
    "displacement": {"decades": 2, "particles_per_cell": 2, "relaxation_time": 0.5, "observation_time": 2},
    "conductivity": OPEN,
    "steady_profile": OPEN,
    "momentum_flux": OPEN,
    "energy_pulse": {
        "cells": 7,
        "pairs_per_replica": 1,
        "relaxation_time": 0.05,
        "observation_time": None,
        "times": "0.02,0.04",
    },
    "particle_count": OPEN | {"relaxation_time": None, "observation_time": None, "times": "1,2"},
}


def over_seeds(program: Program, folder: Path, name: str, read: Reader, **options: object) -> Seen:
    """Results of all seeds, [seed, ...]."""
    options = {"replicas": SEED_REPLICAS, **SETTINGS[name], **options}
    seen = [read(run(program, folder, name, seed=seed, **options)) for seed in range(SEEDS)]
    return Seen(*(np.array([getattr(each, field.name) for each in seen]) for field in fields(Seen)))


def zero(values: np.ndarray) -> bool:
    """Whether means over seeds are compatible with 0 by Student's t-test."""
    score = values.mean(axis=0) / values.std(axis=0, ddof=1) * np.sqrt(SEEDS)
    return bool(np.abs(score).max() < t.isf(1e-4 / 2 / score.size, SEEDS - 1))


def spread(values: np.ndarray, errors: np.ndarray) -> np.ndarray:
    """Sum over seeds of squared deviations from the mean in units of each seed's standard error."""
    return np.sum(((values - values.mean(axis=0)) / errors) ** 2, axis=0)


@cache
def limits_of_spread(level: float) -> tuple[float, float]:
    """Limits of spread() for normal records: normal means of the seeds, chi-square distributed squared errors."""
    generator, shape, freedom = np.random.default_rng(1), (SEEDS, 100000), SEED_REPLICAS - 1
    errors = np.sqrt(generator.chisquare(freedom, shape) / freedom)
    low, high = np.quantile(spread(generator.standard_normal(shape), errors), [level / 2, 1 - level / 2])
    return float(low), float(high)


def scatter_as_stated(values: np.ndarray, errors: np.ndarray) -> bool:
    found = spread(values, errors)
    low, high = limits_of_spread(1e-3 / found.size)
    return bool(low < found.min() and found.max() < high)


@pytest.mark.parametrize(
    ("name", "options"),
    [
        *((name, {"gamma": gamma}) for name in READERS for gamma in ("N", 1, 0.3)),
        *(("displacement", {"gamma": gamma, "random_direction": True}) for gamma in ("N", 1)),
    ],
    ids=lambda value: "-".join(map(str, value.values())) if isinstance(value, dict) else value,
)
def test_symmetry_over_seeds(program: Program, tmp_path: Path, name: str, options: dict) -> None:
    """Random numbers common to replicas and seeds shift the mean from 0; those common to seeds make the spread
    smaller than the errors predict, those common to replicas larger."""
    seen = over_seeds(program, tmp_path, name, READERS[name], **options)
    assert zero(seen.odd)
    assert scatter_as_stated(seen.means, seen.errors)
    # Mutants: a shift by the standard deviation of one seed; errors three times too large or too small.
    assert not zero(seen.odd + seen.odd.std(axis=0, ddof=1))
    assert not scatter_as_stated(seen.means, 3 * seen.errors)
    assert not scatter_as_stated(seen.means, seen.errors / 3)


@pytest.mark.parametrize(
    ("name", "read", "options"),
    [
        *(
            (name, READERS[name], {"nu_left": 210})
            for name, options in SETTINGS.items()
            if "nu_left" in options
        ),
        ("energy_pulse", partial(pulse, shift=1), {}),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_asymmetry_is_found(program: Program, tmp_path: Path, name: str, read: Reader, options: dict) -> None:
    assert not zero(over_seeds(program, tmp_path, name, read, **options).odd)
