"""Fits of independent points with known errors."""

import numpy as np
import pytest
from scipy.stats import chi2

from workflow.lib.fit import fit_power, format_with_error, local_exponents, mean_of, rejected

SIZE = np.array([4, 8, 16, 64, 256])


def test_fit_power_has_standard_normal_pulls_and_chi_square() -> None:
    """With unequal errors, the pulls of the exponent are standard normal and chi^2 is chi-square
    distributed."""
    generator = np.random.default_rng(1)
    exact, relative = 3 * SIZE**0.4, np.array([0.01, 0.02, 0.01, 0.03, 0.02])
    pulls, chi_squares = [], []
    for _ in range(400):
        law = fit_power(SIZE, exact * (1 + relative * generator.normal(size=5)), relative * exact)
        pulls.append((law.exponent - 0.4) / law.error)
        chi_squares.append(law.chi_square)
    low, high = chi2.ppf([5e-4, 1 - 5e-4], 400)
    assert low < np.sum(np.square(pulls)) < high
    assert (
        not low < np.sum(np.square(pulls)) * 1.5**2 < high
    )  # detected mistake: errors that are 1.5 times too small
    low, high = chi2.ppf([5e-4, 1 - 5e-4], 400 * 3)
    assert low < np.sum(chi_squares) < high


def test_format_with_error_has_two_digits_of_the_error() -> None:
    texts = {(1.86204, 0.00541): "1.8620(54)", (745.03, 8.24): "745.0(8.2)", (12345.6, 123.4): "12346(120)"}
    texts |= {
        (0.5, 0.0996): "0.50(10)",
        (-0.322, 0.0517): "−0.322(52)",
        (2.5, np.nan): "2.5",
        (-2.5, 0): "−2.5",
    }
    assert {numbers: format_with_error(*numbers) for numbers in texts} == texts


def test_values_that_differ_are_rejected() -> None:
    mean, error, chi_square = mean_of([1, 3], [1, 1])
    assert (mean, error, chi_square) == pytest.approx((2, np.sqrt(0.5), 2))
    mean, error, chi_square = mean_of([1, 6], [1, 2])  # weights 4 and 1
    assert (mean, error, chi_square) == pytest.approx((2, np.sqrt(0.8), 5))
    assert not rejected(chi_square, 1)
    assert rejected(7, 1)


def test_local_exponents_and_fit_power_skip_points_without_a_value() -> None:
    """y = 3 x^0.4 without its second point: all exponents are 0.4. A point without an error is none of them."""
    y = np.where(SIZE == 8, np.nan, 3 * SIZE**0.4)
    error = 0.01 * (1 + np.arange(5)) * y
    middle, exponent, exponent_error = local_exponents(SIZE, y, error)
    np.testing.assert_allclose(middle, [8, np.nan, 32, 128, np.nan])
    np.testing.assert_allclose(exponent, [0.4, np.nan, 0.4, 0.4, np.nan])
    steps = np.log([4, np.nan, 4, 4, np.nan])
    np.testing.assert_allclose(
        exponent_error * steps, [*np.hypot([0.01, np.nan, 0.03, 0.04], [0.03, 0, 0.04, 0.05]), np.nan]
    )
    law = fit_power(SIZE, y, error)
    assert (law.exponent, law.dof) == (pytest.approx(0.4), 2)
    assert np.isnan(fit_power(SIZE, y, np.where(SIZE == 16, np.nan, error)).exponent)
