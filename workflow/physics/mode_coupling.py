"""Predictions of nonlinear fluctuating hydrodynamics for the chain at γ = N [mode_coupling.md].

Lengths, not cells, unless a name says so: c is a length over a time, densities and the variance of the heat are per
length. Times and momenta have the units of the model, so that a velocity is a momentum.
"""

from dataclasses import dataclass
from functools import cache
from math import cos, erf, gamma, inf, pi, sqrt
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

# Of f_KPZ (Prähofer and Spohn, J. Stat. Phys. 115, 255, 2004). The tests recompute it from f_kpz.csv.
SECOND_MOMENT = 0.510523


@dataclass(frozen=True)
class Chain:
    """A closed chain in equilibrium: ζ = zλ, where F(p) = z exp(-p²/2T) is the flux, the mass M of the scatterers, T and λ.

    slow_logarithm is Λ, half the integral of exp(-p²/2T)/|p| over all populated p: infinite, or finite with a cut at small |p|.
    """

    zeta: float
    mass: float
    temperature: float = 1.0
    cell_length: float = 1.0
    slow_logarithm: float = inf

    @property
    def fugacity(self) -> float:
        """z: the flux F(p) in the limit p -> 0."""
        return self.zeta / self.cell_length

    @property
    def inertia(self) -> float:
        """ρ [eq. M4]: momentum per length and drift w."""
        return 2 * self.fugacity + self.mass / self.cell_length

    @property
    def heat_capacity(self) -> float:
        """a [eq. M9]: energy per length and temperature at a fixed flux of slow particles."""
        return self.fugacity + 1 / (2 * self.cell_length)

    @property
    def sound_speed(self) -> float:
        """c [eq. M13], a length over a time."""
        pressure, capacity = self.fugacity + self._release, self.heat_capacity + self._release
        return sqrt(4 * self.fugacity * self.temperature * pressure / (self.inertia * capacity))

    @property
    def sound_speed_in_cells(self) -> float:
        return self.sound_speed / self.cell_length

    @property
    def steepening(self) -> float:
        """K = dc/dw [eq. M12] along a sound wave, to first order in 1/Λ [eq. M14]."""
        zeta, mass = self.zeta, self.mass
        correction = (mass - 6 * zeta**2 - zeta) / (
            2 * zeta * (2 * mass * zeta + mass + 8 * zeta**2 + 6 * zeta + 1)
        )
        of_many = self.fugacity / self.heat_capacity + 2 * self.fugacity / self.inertia
        return of_many * (1 + correction / self.slow_logarithm)

    @property
    def _release(self) -> float:
        """b [eq. M13]: T dz/dT in a sound wave, by which the slow particles are released; 0 if there are infinitely many."""
        return 1 / (2 * self.cell_length * (2 * self.slow_logarithm - 1))

    @property
    def self_coupling(self) -> float:
        """λ_s [eq. M17]: the peak has the width (λ_s t)^(2/3)."""
        return self.steepening * sqrt(self.temperature / self.inertia)

    @property
    def heat_amplitude(self) -> float:
        """A [eqs. M25, M26], where <J_q(t) J_q(0)> per length is T² A t^(-2/3)."""
        hot = self.fugacity / (self.fugacity + self._release)
        scale = (hot * self.sound_speed) ** 2 * self.self_coupling ** (-2 / 3)
        return float(8 / 9 * SECOND_MOMENT * scale)

    @property
    def peak_area(self) -> float:
        """Area of each sound peak of C_g per length [eq. M19]."""
        return self.inertia * self.temperature / 2

    def sound_peak(self, x: ArrayLike, time: float) -> np.ndarray:
        """C_g per length of the peak that moves to the right [eq. M19]."""
        width = (self.self_coupling * time) ** (2 / 3)
        offset = (np.asarray(x, dtype=float) - self.sound_speed * time) / width
        return self.peak_area * f_kpz(offset) / width

    @property
    def heat_susceptibility(self) -> float:
        """Variance of e - Tn per length [eq. M23]; grows with the slow particles."""
        slow = self.fugacity * (2 * self.slow_logarithm - 1)
        return self.temperature**2 * (slow + 1 / (2 * self.cell_length))

    @property
    def heat_spreading(self) -> float:
        """D_h [eq. M29]: the Fourier transform of the heat peak is exp(-D_h |k|^(5/3) t)."""
        per_susceptibility = self.temperature**2 * self.heat_amplitude / self.heat_susceptibility
        return float(per_susceptibility * gamma(1 / 3) * cos(pi / 6) * self.sound_speed ** (-1 / 3))


def slow_logarithm(cut: float, temperature: float = 1.0) -> float:
    """Λ [eq. M2] of momenta |p| > cut."""
    from scipy.special import exp1  # noqa: PLC0415  0.2 s

    return float(exp1(cut**2 / (2 * temperature)) / 2)


def logarithm_at(time: float, temperature: float = 1.0, cell_length: float = 1.0) -> float:
    """Λ(t) [eq. 13] of the particles that move within a time: at most 1 more than that of the cut λ/t."""
    cut = cell_length / time
    slower = sqrt(pi * temperature / 2) * erf(cut / sqrt(2 * temperature)) / cut
    return slow_logarithm(cut, temperature) + slower


def f_kpz(y: ArrayLike) -> np.ndarray:
    """Scaling function of stationary KPZ growth, even and of integral 1; below 1e-10 beyond the table, and 0 there."""
    distance = np.abs(np.asarray(y, dtype=float))
    spline = _spline()
    return np.where(distance < spline.x[-1], spline(np.minimum(distance, spline.x[-1])), 0.0)


@cache
def _spline() -> "CubicSpline":
    from scipy.interpolate import CubicSpline  # noqa: PLC0415  0.4 s

    y, f = np.loadtxt(Path(__file__).with_name("f_kpz.csv"), delimiter=",", skiprows=3).T
    return CubicSpline(np.concatenate([-y[:0:-1], y]), np.concatenate([f[:0:-1], f]))


def levy(x: ArrayLike, order: ArrayLike = 5 / 3) -> np.ndarray:
    """Symmetric stable density of the given order: Fourier transform of exp(-|k|^order). Several orders are the last dimension."""
    # k = s^3 makes the integrand smooth at 0, where the singularity of |k|^order would spoil the trapezoidal rule.
    distance = np.asarray(x, dtype=float)
    s = np.linspace(0, 2.4, int(np.clip(150 * np.abs(distance).max(), 1000, 6000)))
    cosines = np.cos(np.multiply.outer(distance, s**3))  # for all orders, as they take most of the time
    weights = [3 * s**2 * np.exp(-(s ** (3 * each))) * (s[1] - s[0]) / pi for each in np.ravel(order)]
    values = np.stack([cosines @ weight for weight in weights], axis=-1)
    return values.reshape(distance.shape + np.shape(order))
