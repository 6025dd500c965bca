"""Fits of independent points with known errors."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import chdtrc

# A law is rejected if chi^2 exceeds what it does in one of so many cases by chance.
LEVEL = 1e-2


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
    """y = amplitude x^exponent; error is that of the exponent."""

    amplitude: float
    exponent: float
    error: float
    chi_square: float
    freedom: int

    @property
    def text(self) -> str:
        return with_error(self.exponent, self.error)

    @property
    def rejected(self) -> bool:
        return rejected(self.chi_square, self.freedom)

    def at(self, x: ArrayLike) -> np.ndarray:
        return self.amplitude * np.asarray(x, dtype=float) ** self.exponent


def p_value(chi_square: float, freedom: int) -> float:
    """Of chi^2; nan without a degree of freedom. scipy.stats has it too, and takes half a second to be imported."""
    return float(chdtrc(freedom, chi_square)) if freedom > 0 else np.nan


def rejected(chi_square: float, freedom: int) -> bool:
    return p_value(chi_square, freedom) < LEVEL


def with_error(value: float, error: float) -> str:
    """A number with two digits of its error: in units of the last one, as 1.8620(54), or with a point, as 745.0(8.2)."""
    if not (np.isfinite(error) and error > 0):
        return f"{value:.4g}".replace("-", "−")
    error = float(f"{error:.1e}")
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    shown = f"{error:.{digits}f}" if error >= 1 else f"{round(error * 10**digits)}"
    return f"{value:.{digits}f}({shown})".replace("-", "−")


def mean_of(value: ArrayLike, error: ArrayLike) -> tuple[float, float, float]:
    """Of independent values of one quantity: weighted mean, its error, chi^2 about it."""
    value, error = (np.asarray(values, dtype=float) for values in (value, error))
    mean = float(np.average(value, weights=error**-2))
    return mean, float(np.sum(error**-2) ** -0.5), float(np.sum(((value - mean) / error) ** 2))


def fit_line(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> Line:
    """Least squares, weighted with the points' standard errors."""
    x, y, error = (np.asarray(values, dtype=float) for values in (x, y, error))
    design = np.stack([np.ones_like(x), x], axis=1) / error[:, None]
    covariance = np.linalg.inv(design.T @ design)
    solution = covariance @ design.T @ (y / error)
    residual = y / error - design @ solution
    intercept, slope = map(float, solution)
    error_of_slope, chi_square = float(np.sqrt(covariance[1, 1])), float(residual @ residual)
    return Line(intercept, slope, error_of_slope, chi_square, len(x) - 2)


def fit_power(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> PowerLaw:
    """Straight line through ln y against ln x."""
    y = np.asarray(y, dtype=float)
    line = fit_line(np.log(np.asarray(x, dtype=float)), np.log(y), np.asarray(error, dtype=float) / y)
    return PowerLaw(float(np.exp(line.intercept)), line.slope, line.error, line.chi_square, line.freedom)
