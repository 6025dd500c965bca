"""Slopes between independent points. Points whose value is NaN are skipped."""

import numpy as np
from numpy.typing import ArrayLike


def local_slopes(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Middle, slope and its error from every point to the next, in the order of the points; NaN for those
    without a value and for the last."""
    slopes = np.full((3, np.size(y)), np.nan)
    known = np.flatnonzero(np.isfinite(np.asarray(y, dtype=float)))
    x, y, error = (np.asarray(each, dtype=float)[known] for each in (x, y, error))
    step = np.diff(x)
    slopes[:, known[:-1]] = (x[1:] + x[:-1]) / 2, np.diff(y) / step, np.hypot(error[1:], error[:-1]) / step
    return slopes[0], slopes[1], slopes[2]


def local_exponents(
    x: ArrayLike, y: ArrayLike, error: ArrayLike
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Local slopes d ln y/d ln x, with geometric middles."""
    y = np.asarray(y, dtype=float)
    middle, exponent, exponent_error = local_slopes(np.log(x), np.log(y), np.asarray(error) / y)
    return np.exp(middle), exponent, exponent_error
