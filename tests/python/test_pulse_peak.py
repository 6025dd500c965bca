"""The moving peak of a pulse against exact results for free flight, and its errors over many seeds."""

from functools import cache

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.stats import norm

from tests.python.conftest import Measure, OverSeeds, spread_accepted

CELLS, PARTICLES, ENERGY, PULSE_ENERGY = 101, 20, 5000, 50000
FREE = {"cells": CELLS, "particles_per_cell": PARTICLES, "gamma": 1e-9}
TIMES = (0.01, 0.0125, 0.016, 0.02, 0.025, 0.032, 0.04)


def fit(profile: np.ndarray) -> tuple[float, float]:
    """Position and height of the top of exp(cubic), weighted with 1 - u^2 where the profile, by the distance
    from the centre, is above half its maximum (|u| < 1)."""
    top = 1 + int(np.argmax(profile[1:]))
    level = profile[top] / 2
    low, high = top, top
    while profile[low] > level:
        low -= 1
    while profile[high] > level:
        high += 1
    left = low + (level - profile[low]) / (profile[low + 1] - profile[low])
    right = high - (level - profile[high]) / (profile[high - 1] - profile[high])
    middle, half = (left + right) / 2, max((right - left) / 2, 2.5)
    cells = np.arange(max(0, int(np.ceil(middle - half))), int(middle + half) + 1)
    u = (cells - middle) / half
    coefficients = least_squares(
        lambda c: np.sqrt(1 - u**2) * (np.exp(np.polyval(c, u)) - profile[cells] / profile[top]),
        [0, np.log(0.5), 0, 0],
        xtol=1e-14,
        ftol=1e-14,
    ).x
    extrema = np.roots(np.polyder(coefficients))
    maximum = next(root.real for root in extrema if np.polyval(np.polyder(coefficients, 2), root.real) < 0)
    return middle + half * maximum, profile[top] * np.exp(np.polyval(coefficients, maximum))


@cache
def free_profile(time: float) -> np.ndarray:
    """Mean energy difference by distance from the central cell without scattering. Particles start
    uniformly in the cell. Their momenta are uniform on a sphere with the pulse, which fixes the total
    energy of the cell, and Gaussian without."""
    dof = PARTICLES + 1
    speed = np.linspace(-1, 1, 400001)[1:-1] * np.sqrt(2 * PULSE_ENERGY * dof)
    with_pulse = (1 - speed**2 / (2 * PULSE_ENERGY * dof)) ** ((dof - 3) / 2)
    without = norm.pdf(speed, scale=np.sqrt(2 * ENERGY))
    density = with_pulse / with_pulse.sum() - without / without.sum()
    inside = [np.clip(1 - np.abs(speed * time - d), 0, None) for d in range(CELLS // 2 + 1)]
    profile = np.array([PARTICLES * np.sum(density * speed**2 / 2 * part) for part in inside])
    profile[0] += PULSE_ENERGY - ENERGY  # energy that the scatterer gains
    return profile


def test_pulse_peak_of_free_flight_is_exact(measure: Measure) -> None:
    result = measure(
        "energy_pulse", **FREE, pairs_per_replica=100, replicas=100, times=",".join(map(str, TIMES))
    )
    difference = result["energy_difference"]
    half = CELLS // 2
    profiles = np.array([free_profile(time) for time in TIMES])
    expected = np.concatenate([profiles[:, :0:-1], profiles], axis=1)
    # Cells reached by so few particles that their error is undefined are left out.
    defined = difference.standard_error > 0.002 * np.nanmax(difference.standard_error)
    defined &= np.abs(np.arange(CELLS) - half) < 35
    z = (difference.mean - expected)[defined] / difference.standard_error[defined]
    assert len(z) > 80
    assert np.abs(z).max() < 4.5

    tops = np.array([fit(profile) for profile in profiles])

    def exponent(first: int, last: int) -> float:
        used = slice(first, last + 1)
        return -float(np.polyfit(np.log(TIMES[used]), np.log(tops[used, 1]), 1)[0])

    octaves = [(0, 3), (3, 6)]  # indices of the first and the last time
    exponents_from = [exponent(first, 6) for first in range(6)]
    wanted = {
        "peak_position": tops[:, 0],
        "peak": tops[:, 1],
        "peak_speed": np.diff(tops[:, 0]) / np.diff(TIMES),
        "local_damping_exponent": [exponent(*ends) for ends in octaves],
        "damping_exponent_from": exponents_from,
        "damping_exponent": exponents_from[:1],
    }
    for name, values in wanted.items():
        z = (np.atleast_1d(result[name].mean) - values) / np.atleast_1d(result[name].standard_error)
        assert np.abs(z).max() < 4, name
    np.testing.assert_allclose(result["peak_speed"].axes["middle"], 0.5 * (np.array(TIMES[1:]) + TIMES[:-1]))
    np.testing.assert_array_equal(
        result["local_damping_exponent"].axes["until"], [TIMES[b] for _, b in octaves]
    )


SEEDS, REPLICAS = 70, 24
OF_THE_PEAK = (
    "peak",
    "peak_position",
    "peak_speed",
    "local_damping_exponent",
    "damping_exponent_from",
    "damping_exponent",
)
RINGS = {
    "N": {"cells": 41, "times": "0.007,0.01,0.014,0.02"},
    1: {"cells": 80, "times": "0.006,0.008,0.012,0.018"},
}


@pytest.mark.parametrize("gamma", RINGS)
def test_errors_and_mirror_symmetry_over_seeds(over_seeds: OverSeeds, gamma: str | int) -> None:
    """The spread over seeds against the stored errors, for all quantities of the peak and for the odd
    part, whose mean is 0, also on a ring with an even number of cells."""
    chain = RINGS[gamma] | {"particles_per_cell": 20, "gamma": gamma}
    effort = {"pairs_per_replica": 10, "replicas": REPLICAS}
    names = (*OF_THE_PEAK, "odd_part", "energy_difference")
    found = over_seeds("energy_pulse", SEEDS, *names, **chain, **effort)
    for name in OF_THE_PEAK:
        values, errors = found[name].reshape(2, SEEDS, -1)
        assert (errors > 0).all(), name
        for column in range(values.shape[1]):
            # Detected mistakes: errors that are twice or half as large.
            for factor, good in ((1, True), (2, False), (0.5, False)):
                accepted = spread_accepted(values[:, column], factor * errors[:, column], REPLICAS, 2e-4)
                assert accepted == good, (name, column, factor)

    odd, errors = (
        np.nan_to_num(values[:, -1]) for values in found["odd_part"]
    )  # NaN where no particle arrived
    profile = found["energy_difference"][0, :, -1]
    centre, distance = chain["cells"] // 2, np.arange(1, odd.shape[1] + 1)
    right, left = profile[:, (centre + distance) % chain["cells"]], profile[:, centre - distance]
    np.testing.assert_allclose(odd, (right - left) / 2, atol=1e-12 * profile.max())
    reached = errors.min(axis=0) > 0.1 * errors.max()  # reached often enough for a Gaussian mean
    assert reached.sum() > 7
    squares = np.sum((odd[:, reached] / errors[:, reached]) ** 2, axis=1) * (REPLICAS - 3) / (REPLICAS - 1)
    assert abs(squares.mean() - reached.sum()) < 4 * squares.std(ddof=1) / np.sqrt(SEEDS)
