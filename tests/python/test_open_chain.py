"""The observables of the open chain: agreement with the reference simulator, equilibrium."""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from tests.python.conftest import Measure, OverSeeds, agree, simulate, spread_accepted
from workflow.lib.load import Quantity

BATHS = {"nu_left": 220, "nu_right": 180, "temperature_left": 900 / 11, "temperature_right": 1100 / 9}
EQUAL = {"nu_left": 200, "nu_right": 200, "temperature_left": 100, "temperature_right": 100}
BINS, MAX = 20, 60


@cache
def reference(
    cells: int, gamma: float, times: tuple[float, float], rotation: float = 0, sigma: float = 0.5
) -> dict[str, np.ndarray]:
    """Measurements of the reference simulator with the default baths, [replica, value]."""
    chain = {
        "cells": cells,
        "cell_length": 1 / cells,
        "sigma": sigma,
        "gamma": gamma,
        "rotation": rotation,
        **BATHS,
    }
    bins = {"momentum_bins": BINS, "momentum_max": MAX}
    window = {"relaxation_time": times[0], "observation_time": times[1]}
    rows = simulate("open_chain", **chain, **window, **bins, replicas=100, seed=1)
    sizes = {
        **dict.fromkeys(("temperature_scatterer", "temperature_particle", "density"), cells),
        **dict.fromkeys(("rate_right", "rate_left"), cells),
        **dict.fromkeys(("particle_current", "energy_current"), cells + 1),
        "flux": (cells + 1) * BINS,
        "total_number": 1,
        "inside": BINS,
    }
    return dict(zip(sizes, np.split(rows, np.cumsum(list(sizes.values()))[:-1], axis=1), strict=True))


def scores(quantity: Quantity, sample: np.ndarray) -> np.ndarray:
    """z-scores of the values that occur often enough to have a normal distribution."""
    mean, error = sample.mean(axis=0), sample.std(axis=0, ddof=1) / np.sqrt(len(sample))
    often = (np.count_nonzero(sample, axis=0) > len(sample) / 2) & (quantity.standard_error.ravel() > 0)
    difference = quantity.mean.ravel() - mean
    return difference[often] / np.hypot(quantity.standard_error.ravel(), error)[often]


@pytest.mark.parametrize(
    ("cells", "gamma", "rotation", "sigma"),
    [
        (1, "N", 0, 0.5),
        (7, "N", 0, 0.5),
        (7, 3.4, 0, 0.5),
        (7, "N", 0.3, 0.5),
        (3, 1.7, 1, 0.5),
        (7, "N", 0.5, 0),  # the rotation alone exchanges energy
        (7, 3.4, 0.5, 0.9999),
    ],
)
def test_open_chain_against_the_reference_simulator(
    measure: Measure, cells: int, gamma: str | float, rotation: float, sigma: float
) -> None:
    expected = reference(cells, cells if gamma == "N" else gamma, (5, 15), rotation, sigma)
    options = {"cells": cells, "sigma": sigma, "gamma": gamma, "start": "empty", "replicas": 150, "seed": 5}
    options |= {"relaxation_time": 5, "observation_time": 15}
    options |= {"rule": "rotation", "rotation_probability": rotation} if rotation else {}

    profile = measure("steady_profile", **options, momentum_bins=BINS)
    for name in ("temperature_scatterer", "temperature_particle", "density", "rate_right", "rate_left",
                 "particle_current", "energy_current"):  # fmt: skip
        assert agree(scores(profile[name], expected[name])), name
    # Detected mistake: an opening has the current of particles that enter, which the controls determine,
    # minus that of those that leave.
    errors = profile["energy_current"].error
    assert cells == 1 or errors[[0, -1]].max() < 1.5 * errors[1:-1].max()
    density = profile["scatterer_density"]
    square = (density.mean * density.axes["scaled_momentum"] ** 2).sum(axis=1) * (2 * MAX / BINS)
    np.testing.assert_allclose(
        square, profile["temperature_scatterer"].mean[[0, -1]], rtol=0.1
    )  # finite bins
    flux = measure("momentum_flux", **options, momentum_bins=BINS, momentum_max=MAX)
    assert agree(scores(flux["flux"], expected["flux"]))

    found = {name: expected[name][:, [0, -1]].mean(axis=1) for name in ("energy_current", "particle_current")}
    found["temperature_first"] = expected["temperature_scatterer"][:, 0]
    found["temperature_last"] = expected["temperature_scatterer"][:, -1]

    def largest_score(**changed: object) -> float:
        result = measure("conductivity", **options | changed)
        assert np.isfinite(result["kappa"].error) or sigma != 0
        z = [scores(result[name], sample[:, None])[0] for name, sample in found.items()]
        return float(np.abs(z).max())

    assert largest_score() < 4
    # Detected mistakes: the baths are exchanged; one bath is slightly hotter.
    if gamma == 3.4:
        assert largest_score(temperature_left=1100 / 9, temperature_right=900 / 11) > 4
        assert largest_score(temperature_right=145) > 4


def test_number_of_particles_against_the_reference_simulator(measure: Measure) -> None:
    expected = reference(13, 13, (0, 10))
    options = {
        "cells": 13,
        "cell_length": 1 / 13,
        "replicas": 200,
        "momentum_bins": BINS,
        "momentum_max": MAX,
    }
    result = measure("particle_count", **options, **BATHS)
    number, density = result["total_number"], result["weighted_momentum_density"]
    sample = expected["total_number"][:, 0]
    error = np.hypot(number.standard_error[-1], sample.std(ddof=1) / np.sqrt(len(sample)))
    assert abs(number.mean[-1] - sample.mean()) < 4 * error
    # Bins of fast particles, where |p| n(p) is nearly n(p) times the middle of the bin.
    width, p = 2 * MAX / BINS, density.axes["p"]
    fast = (np.abs(p) > 20) & (np.abs(p) < 30)
    inside = expected["inside"][:, fast] * np.abs(p[fast]) / width
    spread = np.hypot(density.standard_error[-1][fast], inside.std(axis=0, ddof=1) / np.sqrt(len(inside)))
    assert (
        np.abs(density.mean[-1][fast] - inside.mean(axis=0)) < 4 * spread + 0.05 * inside.mean(axis=0)
    ).all()


def test_front_of_free_flight(measure: Measure) -> None:
    """Without scattering [eq. 23] is exact in a chain of one cell, which is a path long. Detected
    mistakes: without the particles below the bins p_0 is a tenth larger at the last time; where |p| n(p)
    is half of the plateau is e/2 p_0."""
    times = (20, 60, 200)
    free = EQUAL | {"nu_left": 1000, "nu_right": 1000, "cells": 1, "cell_length": 1, "gamma": 0}
    result = measure("particle_count", **free, times=",".join(map(str, times)), replicas=400)
    middles = np.log(result["weighted_speed_density"].axes["speed"])
    width = middles[1] - middles[0]
    edges = np.append(middles, middles[-1] + width) - width / 2

    def density(x: float, time: float) -> float:
        """Particles per unit of x = ln |p|."""
        flux = 2 * 1000 * np.sqrt(2 / np.pi / 100) * np.exp(-np.exp(2 * x) / 200)
        return float(flux * min(1, np.exp(x) * time))

    def number(low: float, high: float, time: float) -> float:
        return float(quad(density, low, high, (time,), points=[np.clip(-np.log(time), low, high)])[0])

    expected = []
    for time in times:
        used = (middles > np.log(10 / time)) & (middles < np.log(0.2 * 10))
        densities = [number(low, low + width, time) / width for low in edges[:-1][used]]
        below = edges[edges < np.log(4 / time)][-1]
        expected.append(np.exp(below - number(-20, below, time) / np.mean(densities)))
    front = result["front"]
    assert agree((front.mean - expected) / front.error)
    assert (np.abs(front.mean - 1.1 * np.array(expected)) > 5 * front.error).all()
    np.testing.assert_allclose(expected, 1 / (np.e * np.array(times)), rtol=0.02)
    # Detected mistakes: one sign of p; widths in decades; edges that are shifted by a quarter of a bin.
    found = result["weighted_speed_density"]
    exact = np.array([[number(low, low + width, time) / width for low in edges[:-1]] for time in times])
    often = exact * width * 400 > 100  # a number of particles with a normal mean
    assert often.sum() > 50
    assert agree(((found.mean - exact) / found.error)[often])


def mean_flight(cells: int, probability: float) -> float:
    """Geometric mean of the cells of a slow particle's flight, each flight counted by its length: from a
    scatterer or, half a cell before the first one, from an opening, to a scatterer or the other opening."""
    k = np.arange(1, cells + 1)
    scattered = probability * (1 - probability) ** (k - 1)
    lengths, rates = [k - 0.5, [cells]], [scattered, [(1 - probability) ** cells]]
    for ahead in range(cells):  # scatterers ahead
        lengths += [k[:ahead], [ahead + 0.5]]
        rates += [probability * scattered[:ahead], [probability * (1 - probability) ** ahead]]
    length, rate = np.concatenate(lengths), np.concatenate(rates)
    assert np.sum(rate * length) == pytest.approx(cells)
    return float(np.exp(np.sum(rate * length * np.log(length)) / cells))


@pytest.mark.parametrize("gamma", ["N", 13.7])
def test_front_of_a_filling_chain(measure: Measure, gamma: str | float) -> None:
    """Flights of k cells are populated up to the speed kλ/t. [eq. 24] is that of k = 1, with half a cell
    at the openings. Detected mistake: λN/γ in place of the mean, 20 % less at γ = 13.7."""
    cells, times = 37, np.array([100, 250, 700])
    run = EQUAL | {"cells": cells, "gamma": gamma, "cell_length": "1/N", "replicas": 40}
    front = measure("particle_count", **run, times=",".join(map(str, times)))["front"]
    probability = 1 if gamma == "N" else float(gamma) / cells
    mean = mean_flight(cells, probability)
    expected = mean / (np.e * cells * times)
    assert agree((front.mean - expected) / front.error)
    if gamma == "N":
        assert mean == pytest.approx(2 ** (-1 / cells))
    else:
        assert not agree((front.mean - expected / mean / probability) / front.error)


def test_open_chain_between_equal_baths_is_gaussian(measure: Measure) -> None:
    """g is Gaussian at the temperature of the baths."""
    options = {"cells": 7, "gamma": 1.3, "replicas": 200, "relaxation_time": 20, "observation_time": 30}
    density = measure("steady_profile", **options, **EQUAL, momentum_bins=BINS)["scatterer_density"]
    inner = np.abs(density.axes["scaled_momentum"]) < 30
    edges = np.linspace(-MAX, MAX, BINS + 1)

    def agrees(temperature: float) -> bool:
        expected = np.diff(norm.cdf(edges / np.sqrt(temperature))) / np.diff(edges)
        return agree(((density.mean - expected) / density.error)[:, inner])

    assert agrees(100)
    assert not agrees(110)


@pytest.mark.parametrize(
    ("gamma", "cells", "times", "target"),
    [("N", 5, (3, 6), "energy_current"), (0.9, 7, (5, 12), "temperature_first")],
)
def test_reduced_and_plain_estimates_over_seeds(
    over_seeds: OverSeeds, gamma: str | int, cells: int, times: tuple[int, int], target: str
) -> None:
    """Estimates with control variates, and those of too few replicas for these, agree; the former have
    smaller errors, and both errors predict the spread over seeds."""
    options = {"gamma": gamma, "cells": cells, "relaxation_time": times[0], "observation_time": times[1]}
    many, few = 40, 16
    reduced, error = over_seeds("conductivity", 50, target, **options, replicas=many)[target]
    plain, plain_error = over_seeds("conductivity", 125, target, **options, replicas=few)[target]
    kappa, kappa_error = over_seeds("conductivity", 50, "kappa", **options, replicas=many)["kappa"]
    of_mean = np.hypot(*(each.std(ddof=1) / np.sqrt(len(each)) for each in (reduced, plain)))
    assert abs(reduced.mean() - plain.mean()) < 4 * of_mean
    assert few * np.mean(plain_error**2) > 8 * many * np.mean(error**2)

    for values, errors, replicas in (
        (reduced, error, many),
        (plain, plain_error, few),
        (kappa, kappa_error, many),
    ):
        assert spread_accepted(values, errors, replicas, 1e-3)
        assert not spread_accepted(values, 2 * errors, replicas, 1e-3)
        assert not spread_accepted(values, errors / 2, replicas, 1e-3)
    assert not spread_accepted(plain[:50], error, many, 1e-3)
