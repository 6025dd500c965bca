"""Numbers with errors as text, and slopes between independent points. Points whose value is NaN are skipped."""

import numpy as np
from numpy.typing import ArrayLike


def format_with_error(value: float, error: float, systematic: float = 0) -> str:
    """Value and error with two digits of the error: 1.8620(54), or 745.0(8.2) for errors of 1 and above;
    1.0(?) if the error is unknown, `unknown` for NaN. An error of 0 is not written. The bound on the systematic error follows in its own brackets, unless it is below
    the last digit: 0.299(8)(52); ∞ if it is unknown."""
    if not np.isfinite(value):
        return "unknown"
    if not (np.isfinite(error) and error > 0):
        text = (f"{value:.0f}" if abs(value) >= 1e4 else f"{value:z.4g}").replace("-", "−")
        return text if error == 0 else f"{text}(?)" if "." in text else f"{text}.0(?)"
    error = float(f"{error:.1e}")
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    errors = [error] if systematic * 10**digits <= 0.5 else [error, systematic]
    brackets = (
        "∞" if not np.isfinite(one) else f"{one:.{digits}f}" if error >= 1 else f"{round(one * 10**digits)}"
        for one in errors
    )
    return "".join([f"{value:z.{digits}f}", *(f"({number})" for number in brackets)]).replace("-", "−")


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
