"""Sound and heat peaks of rings in equilibrium.

A stable law of free order, width and area is fitted to the heat peak inside the sound peaks. Values of neighbouring cells are
correlated, so its errors follow from the spread over runs that differ only in their seed.
"""

from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import RectBivariateSpline
from scipy.optimize import least_squares

from workflow.lib.load import Result
from workflow.physics.mode_coupling import Chain, levy

FITTED = 8  # largest distance in the fit of a heat peak, in predicted widths
HEAT_ORDER, GAUSSIAN = 5 / 3, 2  # orders of the stable law in theory [eq. M29] and of diffusion
RATIOS_ALLOWED = (0.1, 10)  # bounds of width and area in the fit, over the predicted ones
ORDERS = (1, 3)  # bounds of the order in the fit
AT_BOUND = 0.01  # smallest distance of a fitted order from these
CENTRE = 3  # distance in cells from which on the heat peak is free of the cusp that slow particles make


class Record(NamedTuple):
    """Correlation profiles at one time, from runs that differ only in their seed."""

    results: Sequence[Result]
    position: int  # index of the time
    time: float
    gas: Chain  # with infinitely many slow particles
    mobile: Chain  # with the slow particles that move within the time

    def value(self, name: str) -> tuple[float, float]:
        """Mean of a quantity over the runs, and its error."""
        quantities = [result[name] for result in self.results]
        mean, error = mean_over_runs(
            np.array([quantity.mean[self.position] for quantity in quantities]),
            np.array([quantity.error[self.position] for quantity in quantities]),
        )
        return float(mean), float(error)

    def profile(self, name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Distances from the centre as lengths; mean of both sides over the runs; its error."""
        profiles = self.profiles(name)
        errors = np.stack([result[name].error[self.position] for result in self.results])
        mean, error = mean_over_runs(profiles, errors[:, errors.shape[1] // 2 :])
        return np.arange(len(mean)) * self.gas.cell_length, mean, error

    def profiles(self, name: str) -> np.ndarray:
        """Mean of both sides [run, distance in cells]."""
        means = np.stack([result[name].mean[self.position] for result in self.results])
        middle = means.shape[1] // 2
        return 0.5 * (means[:, middle:] + means[:, middle::-1][:, : means.shape[1] - middle])

    @property
    def mean_error(self) -> float:
        return float(np.mean(self.profile("momentum_correlation")[2]))


def mean_over_runs(values: np.ndarray, errors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean over the first dimension, and its error from the spread of equal runs; that of a single run is its own."""
    if len(values) == 1:
        return values[0], errors[0]
    return values.mean(axis=0), values.std(axis=0, ddof=1) / np.sqrt(len(values))


def heat_width(record: Record) -> float:
    """Predicted width of the heat peak, (D_h t)^(3/5) [eq. M29]."""
    return float((record.mobile.heat_spreading * record.time) ** (3 / 5))


def heat_area(record: Record) -> float:
    """Predicted sum of the heat covariance over all cells: T^4/(4 λ χ_q)."""
    return record.gas.temperature**4 / (4 * record.gas.cell_length * record.mobile.heat_susceptibility)


@cache
def stable_densities() -> RectBivariateSpline:
    """Interpolates levy(x, order), which fits need thousands of times."""
    x, order = np.arange(0, 40, 0.1), np.arange(0.9, 3.15, 0.1)
    return RectBivariateSpline(x, order, levy(x, order))


def stable_law(
    record: Record,
    profile: np.ndarray,
    order: float | None = None,
    omitted: int = 0,
    start: ArrayLike = (1, 1, HEAT_ORDER),
) -> np.ndarray:
    """Width and area, over the predicted ones, and order of the stable law that best fits a heat peak inside the sound peaks. order:
    fixed order, free if None; omitted: distance in cells from which on the peak is fitted; start: of the fit."""
    within = min(0.5 * record.gas.sound_speed * record.time, FITTED * heat_width(record))
    inside = profile[omitted : int(within / record.gas.cell_length)]
    x = np.arange(omitted, omitted + len(inside)) * record.gas.cell_length / heat_width(record)
    y = inside * heat_width(record) / (heat_area(record) * record.gas.cell_length)
    weight = np.where(x == 0, np.sqrt(0.5), 1)  # other values are means of two sides

    def residuals(law: np.ndarray) -> np.ndarray:
        width, area, exponent = law
        return weight * (area / width * stable_densities().ev(x / width, exponent) - y)

    exact = {"ftol": 1e-12, "xtol": 1e-12, "gtol": 1e-12}
    if order is not None:
        fit = least_squares(
            lambda law: residuals(np.append(law, order)), [1, 1], bounds=RATIOS_ALLOWED, **exact
        )
        return np.append(fit.x, order)
    bounds = [*zip(RATIOS_ALLOWED, RATIOS_ALLOWED, ORDERS, strict=True)]
    return least_squares(residuals, start, bounds=bounds, **exact).x


def stable_laws(record: Record, omitted: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Stable laws (width, area, order) of the mean over all runs, and of the means that leave out one run [run, parameter]."""
    profiles = record.profiles("heat_correlation")
    law = stable_law(record, profiles.mean(axis=0), omitted=omitted)
    without_one = [
        stable_law(record, np.delete(profiles, k, axis=0).mean(axis=0), omitted=omitted, start=law)
        for k in range(len(profiles))
    ]
    return law, np.array(without_one)


def determined(law: np.ndarray, without_one: np.ndarray) -> bool:
    """Whether the profiles determine the order: no fit ended at a bound."""
    orders = np.append(without_one[:, -1], law[-1])
    return bool(ORDERS[0] + AT_BOUND < orders.min() and orders.max() < ORDERS[1] - AT_BOUND)


def jackknife_error(without_one: np.ndarray) -> np.ndarray:
    """Jackknife error from the values without one run each. It includes the correlation of neighbouring cells."""
    return np.sqrt(len(without_one) - 1) * np.std(without_one, axis=0)
