"""Fits of growth laws against data that follow a known law."""

import numpy as np
import pytest
from scipy.stats import kstest

from workflow.lib.growth import LAWS, POWER, fits, local_exponents, widest

SIZES = np.array([16, 32, 64, 128, 256, 512, 1024, 2048], dtype=float)
TRUTH = {
    "constant": 300 - 200 * SIZES ** (-1 / 3),
    "logarithm": 50 + 40 * np.log(SIZES),
    "N^(1/3)": 60 + 40 * np.cbrt(SIZES),
    POWER: 70 * SIZES**0.25,
}


def noisy(values: np.ndarray, relative: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    error = relative * values
    return values + error * np.random.default_rng(seed).standard_normal(len(values)), error


@pytest.mark.parametrize("law", TRUTH)
def test_the_law_is_found_and_its_p_value_is_uniform(law: str) -> None:
    values, p_values = TRUTH[law], []
    for seed in range(200):
        found = {one.law: one for one in fits(SIZES, *noisy(values, 0.005, seed), first=16)}
        assert found.keys() == {*LAWS, POWER}
        p_values.append(found[law].p_value)
        if seed < 20:
            assert min(found.values(), key=lambda one: one.criterion).law == law
    assert kstest(p_values, "uniform").pvalue > 1e-3


def test_exponent_and_its_error() -> None:
    """Detected mistake: the error ignores that the amplitude is fitted too."""
    scores = []
    for seed in range(300):
        power = fits(SIZES, *noisy(TRUTH[POWER], 0.01, seed), first=16)[-1]
        scores.append((power.exponent - 0.25) / power.exponent_error)
    assert abs(np.mean(scores)) < 4 / np.sqrt(len(scores))
    assert np.std(scores) == pytest.approx(1, abs=4 / np.sqrt(2 * len(scores)))
    power = fits(SIZES, TRUTH[POWER], 0.01 * TRUTH[POWER], first=16)[-1]
    spread = np.sum(
        (np.log(SIZES) - np.log(SIZES).mean()) ** 2
    )  # slope of a line through logarithms with equal errors
    assert power.exponent_error == pytest.approx(0.01 / np.sqrt(spread), rel=1e-3)


def test_widest_range_of_a_law() -> None:
    """The range excludes the two smallest sizes, which are far from the law. There is none if only three sizes
    agree, or only another law does."""
    values, error = TRUTH["N^(1/3)"].copy(), np.full(len(SIZES), 0.1)
    values[:2] += 50
    growth = widest(SIZES, values, error, "N^(1/3)", 0.01)
    assert growth is not None
    assert (growth.law, growth.first, growth.freedom) == ("N^(1/3)", 64, 4)
    values[-4] += 50
    assert widest(SIZES, values, error, "N^(1/3)", 0.01) is None
    assert widest(SIZES, TRUTH["logarithm"], error, "N^(1/3)", 0.01) is None


def test_local_exponents() -> None:
    middle, slope, error = local_exponents(SIZES, TRUTH[POWER], 0.01 * TRUTH[POWER])
    np.testing.assert_allclose(middle, np.sqrt(SIZES[1:] * SIZES[:-1]))
    np.testing.assert_allclose(slope, 0.25)
    np.testing.assert_allclose(error, 0.01 * np.sqrt(2) / np.log(2))
