"""Numbers with errors as text, and exponents between independent points."""

import numpy as np

from workflow.lib.fit import local_exponents
from workflow.lib.text import format_with_error

SIZE = np.array([4, 8, 16, 64, 256])


def test_format_with_error_has_two_digits_of_the_error() -> None:
    texts = {(1.86204, 0.00541): "1.8620(54)", (745.03, 8.24): "745.0(8.2)", (12345.6, 123.4): "12346(120)"}
    texts |= {
        (0.5, 0.0996): "0.50(10)",
        (-0.322, 0.0517): "−0.322(52)",
        (2.5, np.nan): "2.5(?)",
        (-2.5, 0): "−2.5",
        (123456, 0): "123456",
        (-1e-4, 0.01): "0.000(10)",
        (-np.inf, np.inf): "unknown",
    }
    assert {numbers: format_with_error(*numbers) for numbers in texts} == texts


def test_local_exponents_skip_points_without_a_value() -> None:
    """y = 3 x^0.4 without its second point: all exponents are 0.4."""
    y = np.where(SIZE == 8, np.nan, 3 * SIZE**0.4)
    error = 0.01 * (1 + np.arange(5)) * y
    middle, exponent, exponent_error = local_exponents(SIZE, y, error)
    np.testing.assert_allclose(middle, [8, np.nan, 32, 128, np.nan])
    np.testing.assert_allclose(exponent, [0.4, np.nan, 0.4, 0.4, np.nan])
    steps = np.log([4, np.nan, 4, 4, np.nan])
    np.testing.assert_allclose(
        exponent_error * steps, [*np.hypot([0.01, np.nan, 0.03, 0.04], [0.03, 0, 0.04, 0.05]), np.nan]
    )
