"""Fits of independent points with known errors."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True)
class PowerLaw:
    """y ~ x^exponent. chi_square and freedom (degrees of freedom) tell how good the fit is."""

    exponent: float
    error: float
    chi_square: float
    freedom: int

    @property
    def text(self) -> str:
        digits = max(0, -int(np.floor(np.log10(self.error))))
        return f"{self.exponent:.{digits}f}({round(self.error * 10**digits)})"


def fit_power(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> PowerLaw:
    """Straight line through ln y against ln x, weighted with the points' standard errors."""
    log_x, log_y = np.log(np.asarray(x, dtype=float)), np.log(np.asarray(y, dtype=float))
    weight = np.asarray(y, dtype=float) / np.asarray(error, dtype=float)
    design = np.stack([np.ones_like(log_x), log_x], axis=1) * weight[:, None]
    covariance = np.linalg.inv(design.T @ design)
    solution = covariance @ design.T @ (log_y * weight)
    residual = log_y * weight - design @ solution
    return PowerLaw(
        float(solution[1]), float(np.sqrt(covariance[1, 1])), float(residual @ residual), len(log_x) - 2
    )
