"""Fits of independent points with known errors."""

import numpy as np
import pytest
from scipy.stats import chi2

from workflow.lib.fit import fit_power

SIZE = np.array([4, 8, 16, 64, 256])


def test_an_exact_law() -> None:
    law = fit_power(SIZE, 3 * SIZE**0.4, SIZE / 100)
    assert law.exponent == pytest.approx(0.4, abs=1e-12)
    assert law.chi_square < 1e-20
    assert law.freedom == 3


def test_error_and_goodness_over_samples() -> None:
    """With unequal errors, the pulls of the exponent are standard normal and chi^2 is chi-square distributed."""
    generator = np.random.default_rng(1)
    exact, relative = 3 * SIZE**0.4, np.array([0.01, 0.02, 0.01, 0.03, 0.02])
    pulls, chi_squares = [], []
    for _ in range(400):
        law = fit_power(SIZE, exact * (1 + relative * generator.normal(size=5)), relative * exact)
        pulls.append((law.exponent - 0.4) / law.error)
        chi_squares.append(law.chi_square)
    low, high = chi2.ppf([5e-4, 1 - 5e-4], 400)
    assert low < np.sum(np.square(pulls)) < high
    assert not low < np.sum(np.square(pulls)) * 1.5**2 < high  # mutant: errors too small
    low, high = chi2.ppf([5e-4, 1 - 5e-4], 400 * 3)
    assert low < np.sum(chi_squares) < high


def test_text_has_the_error_in_the_last_digit() -> None:
    law = fit_power(SIZE, SIZE**0.5, 0.01 * SIZE**0.5)
    assert law.text == f"{0.5:.3f}({round(law.error * 1000)})"
