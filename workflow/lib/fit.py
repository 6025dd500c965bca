"""Weighted least-squares fits of independent points, and slopes between them. Points whose value is NaN are
skipped."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

LEVEL = 1e-2  # p-value below which a law is rejected


@dataclass(frozen=True)
class PowerLaw:
    """y ~ x^exponent, with the error of the exponent, chi^2 and its degrees of freedom."""

    exponent: float
    error: float
    chi_square: float
    dof: int

    @property
    def rejected(self) -> bool:
        return rejected(self.chi_square, self.dof)


def p_value(chi_square: float, dof: int) -> float:
    """p-value of chi^2; nan without a degree of freedom."""
    # Imported here: most panels need no p-value, and the import takes a tenth of their time.
    from scipy.special import chdtrc  # noqa: PLC0415

    return float(chdtrc(dof, chi_square)) if dof > 0 else np.nan


def rejected(chi_square: float, dof: int) -> bool:
    return p_value(chi_square, dof) < LEVEL


def format_with_error(value: float, error: float, systematic: float = 0) -> str:
    """Value and error with two digits of the error: 1.8620(54), or 745.0(8.2) for errors of 1 and above;
    `unknown` for NaN. The bound on the systematic error follows in its own brackets, unless it is below
    the last digit: 0.299(8)(52); ∞ if it is unknown."""
    if np.isnan(value):
        return "unknown"
    if not (np.isfinite(error) and error > 0):
        return f"{value:.4g}".replace("-", "−")
    error = float(f"{error:.1e}")
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    errors = [error] if systematic * 10**digits <= 0.5 else [error, systematic]
    brackets = (
        "∞" if np.isinf(one) else f"{one:.{digits}f}" if error >= 1 else f"{round(one * 10**digits)}"
        for one in errors
    )
    return "".join([f"{value:.{digits}f}", *(f"({number})" for number in brackets)]).replace("-", "−")


def mean_of(value: ArrayLike, error: ArrayLike) -> tuple[float, float, float]:
    """Weighted mean of independent values, its error, and chi^2 of the values."""
    value, error = (np.asarray(values, dtype=float) for values in (value, error))
    mean = float(np.average(value, weights=error**-2))
    return mean, float(np.sum(error**-2) ** -0.5), float(np.sum(((value - mean) / error) ** 2))


def fit_power(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> PowerLaw:
    """Power law by a line through ln y against ln x, weighted with the standard errors of the points."""
    x, y, error = _known(x, y, error)
    relative = error / y
    design = np.stack([np.ones_like(x), np.log(x)], axis=1) / relative[:, None]
    covariance = np.linalg.inv(design.T @ design)
    solution = covariance @ design.T @ (np.log(y) / relative)
    residual = np.log(y) / relative - design @ solution
    return PowerLaw(
        float(solution[1]), float(np.sqrt(covariance[1, 1])), float(residual @ residual), len(x) - 2
    )


def local_slopes(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Middle, slope and its error from every point to the next, in the order of the points; NaN for those
    without a value and for the last."""
    slopes = np.full((3, np.size(y)), np.nan)
    from_here = np.flatnonzero(np.isfinite(np.asarray(y, dtype=float)))[:-1]
    x, y, error = _known(x, y, error)
    step = np.diff(x)
    slopes[:, from_here] = (x[1:] + x[:-1]) / 2, np.diff(y) / step, np.hypot(error[1:], error[:-1]) / step
    return slopes[0], slopes[1], slopes[2]


def local_exponents(
    x: ArrayLike, y: ArrayLike, error: ArrayLike
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Local slopes d ln y/d ln x, with geometric middles."""
    y = np.asarray(y, dtype=float)
    middle, exponent, exponent_error = local_slopes(np.log(x), np.log(y), np.asarray(error) / y)
    return np.exp(middle), exponent, exponent_error


def _known(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The points that have a value. A point without an error stays: it makes the error of a fit unknown."""
    x, y, error = (np.asarray(values, dtype=float) for values in (x, y, error))
    known = np.isfinite(y)
    return x[known], y[known], error[known]
