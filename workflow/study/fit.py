"""Weighted least-squares fit of a power law to independent points. Points whose value is NaN are skipped."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import fdtrc

from workflow.lib.fit import with_values

LEVEL = 1e-2  # p-value below which a law is rejected


@dataclass(frozen=True)
class PowerLaw:
    """y ~ x^exponent, with the error of the exponent and the p-value of the points, nan for two of them."""

    exponent: float
    error: float
    p_value: float

    @property
    def rejected(self) -> bool:
        return self.p_value < LEVEL


def fit_power(x: ArrayLike, y: ArrayLike, error: ArrayLike, dof: ArrayLike) -> PowerLaw:
    """Power law by a line through ln y against ln x, weighted with the standard errors of the points, which
    have dof degrees of freedom. Weights from such errors scatter: the error of the exponent includes this to
    first order in 1/dof (Kenward and Roger 1997), and the p-value is that of Welch's test (1951). With errors
    taken as exact, those from 8 replicas would reject 4 to 7 % of true laws at the level of 1 %. Raises ValueError
    unless two points have values and different x > 0."""
    x, y, error, dof = with_values(x, y, error, dof)
    if not (np.all(x > 0) and np.all(y > 0) and len(set(x)) > 1):
        raise ValueError(f"no power law through the points x = {x}, y = {y}")
    relative, uncertainty = error / y, 1 / np.maximum(dof, 1)
    design = np.stack([np.ones_like(x), np.log(x)], axis=1) / relative[:, None]
    covariance = np.linalg.inv(design.T @ design)
    solution = covariance @ design.T @ (np.log(y) / relative)
    residual = np.log(y) / relative - design @ solution
    free = 1 - np.sum(design @ covariance * design, axis=1)  # 1 minus the leverage of each point
    scatter = (design.T * (4 * free * uncertainty)) @ design
    variance = (covariance + covariance @ scatter @ covariance)[1, 1]
    number, lost = len(x) - 2, max(1e-9, float(free**2 @ np.broadcast_to(uncertainty, x.shape)))
    p_value = np.nan
    if number > 0:
        expected = number + 2 * (number - 1) / (number + 2) * lost
        p_value = float(fdtrc(number, number * (number + 2) / (3 * lost), residual @ residual / expected))
    return PowerLaw(float(solution[1]), float(np.sqrt(variance)), p_value)
