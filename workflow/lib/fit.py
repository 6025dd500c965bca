"""Fits of independent points with known errors."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Line:
    """y = intercept + slope x; error is that of the slope. chi_square and freedom (degrees of freedom) tell how good the fit is."""

    intercept: float
    slope: float
    error: float
    chi_square: float
    freedom: int

    def at(self, x: ArrayLike) -> np.ndarray:
        return self.intercept + self.slope * np.asarray(x, dtype=float)


@dataclass(frozen=True)
class PowerLaw:
    """y ~ x^exponent."""

    exponent: float
    error: float
    chi_square: float
    freedom: int

    @property
    def text(self) -> str:
        return with_error(self.exponent, self.error)


def with_error(value: float, error: float) -> str:
    """A number with its error in units of the last digit, as 1.862(5)."""
    if not (np.isfinite(error) and error > 0):
        return f"{value:.4g}"
    digits = max(0, -int(np.floor(np.log10(error))))
    return f"{value:.{digits}f}({round(error * 10**digits)})"


def fit_line(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> Line:
    """Least squares, weighted with the points' standard errors."""
    x, y, error = (np.asarray(values, dtype=float) for values in (x, y, error))
    design = np.stack([np.ones_like(x), x], axis=1) / error[:, None]
    covariance = np.linalg.inv(design.T @ design)
    solution = covariance @ design.T @ (y / error)
    residual = y / error - design @ solution
    return Line(
        *map(float, solution), float(np.sqrt(covariance[1, 1])), float(residual @ residual), len(x) - 2
    )


def fit_power(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> PowerLaw:
    """Straight line through ln y against ln x."""
    y = np.asarray(y, dtype=float)
    line = fit_line(np.log(np.asarray(x, dtype=float)), np.log(y), np.asarray(error, dtype=float) / y)
    return PowerLaw(line.slope, line.error, line.chi_square, line.freedom)
