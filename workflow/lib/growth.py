"""Growth of a quantity with system size: candidate laws, fitted by weighted least squares and compared."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize_scalar

from workflow.lib.fit import p_value

Basis = Callable[[np.ndarray], list[np.ndarray]]  # functions of the size, combined linearly

# Leading term and first correction of each law. A sound peak whose width grows as t^(2/3) gives corrections of relative order N^(-1/3).
LAWS: dict[str, Basis] = {
    "constant": lambda n: [n**0, n ** (-1 / 3)],
    "logarithm": lambda n: [n**0, np.log(n)],
    "N^(1/3)": lambda n: [n ** (1 / 3), n**0],
}
POWER = "power"  # name of the law a N^b


@dataclass(frozen=True)
class Growth:
    """A law fitted to the sizes from `first` on. Only the power law has an exponent; it is nan for others."""

    law: str
    first: float
    chi_square: float
    freedom: int
    parameters: int
    exponent: float = np.nan
    exponent_error: float = np.nan
    predicted: tuple[float, ...] = ()  # values of the law at the sizes in the fit

    @property
    def p_value(self) -> float:
        return p_value(self.chi_square, self.freedom)

    @property
    def criterion(self) -> float:
        """Akaike's information criterion, chi^2 + 2 parameters. A difference of 10 is decisive."""
        return self.chi_square + 2 * self.parameters


def fits(size: ArrayLike, value: ArrayLike, error: ArrayLike, first: float) -> list[Growth]:
    """Fits of all laws to the sizes from `first` on whose errors are known; empty for fewer than three."""
    size, value, error = (np.asarray(array, dtype=float) for array in (size, value, error))
    used = (size >= first) & np.isfinite(error)
    if used.sum() < 3:
        return []
    points = size[used], value[used], error[used]
    return [*(_linear(name, basis, points) for name, basis in LAWS.items()), _power(points)]


def widest(size: ArrayLike, value: ArrayLike, error: ArrayLike, law: str, level: float) -> Growth | None:
    """Fit of a law over the widest range, up to the largest size, with a p-value above the level and at least two degrees of
    freedom; None without one."""
    for first in np.asarray(size, dtype=float):
        for growth in fits(size, value, error, first):
            if growth.law == law and growth.freedom > 1 and growth.p_value > level:
                return growth
    return None


def _linear(law: str, basis: Basis, points: Sequence[np.ndarray]) -> Growth:
    size, value, error = points
    design = np.stack(basis(size), axis=1)
    solution, *_ = np.linalg.lstsq(design / error[:, None], value / error, rcond=None)
    predicted = design @ solution
    chi_square = float(np.sum(((value - predicted) / error) ** 2))
    parameters = design.shape[1]
    return Growth(law, size[0], chi_square, len(size) - parameters, parameters, predicted=tuple(predicted))


def _power(points: Sequence[np.ndarray]) -> Growth:
    """Power law; the error of the exponent raises chi^2, minimised over the amplitude, by 1."""
    size = points[0]

    def with_exponent(exponent: float) -> Growth:
        return _linear(POWER, lambda n: [n**exponent], points)

    best = minimize_scalar(lambda exponent: with_exponent(exponent).chi_square, bracket=(0, 0.5)).x
    step = 1e-3
    around = [with_exponent(best + shift).chi_square for shift in (-step, 0, step)]
    error = step * np.sqrt(2 / (around[0] - 2 * around[1] + around[2]))
    fit = with_exponent(best)
    return Growth(POWER, size[0], fit.chi_square, len(size) - 2, 2, float(best), float(error), fit.predicted)


def local_exponents(size: ArrayLike, value: ArrayLike, error: ArrayLike) -> tuple[np.ndarray, ...]:
    """Geometric means of neighbouring sizes, d ln value / d ln size between them, and its errors."""
    size, value, error = (np.asarray(array, dtype=float) for array in (size, value, error))
    step, relative = np.diff(np.log(size)), error / value
    slope = np.diff(np.log(value)) / step
    return np.sqrt(size[1:] * size[:-1]), slope, np.hypot(relative[1:], relative[:-1]) / step
