"""Sound in the chain at γ = N by fluctuating hydrodynamics [model.md, section 7].

Lengths, not cells, unless a name says so: c is a length over a time. Times and momenta have the units of the
model, so that a velocity is a momentum.
"""

from dataclasses import dataclass
from math import erf, pi, sqrt


@dataclass(frozen=True)
class Chain:
    """A closed chain in equilibrium: ζ = zλ, where F(p) = z exp(-p²/2T) is the flux, the mass M of the
    scatterers, T and λ. Validity: many slow particles."""

    zeta: float
    mass: float
    temperature: float = 1.0
    cell_length: float = 1.0

    @property
    def fugacity(self) -> float:
        """z: the flux F(p) in the limit p -> 0."""
        return self.zeta / self.cell_length

    @property
    def inertia(self) -> float:
        """𝓜₁ [eq. 51]: momentum per length and drift w."""
        return 2 * self.fugacity + self.mass / self.cell_length

    @property
    def heat_capacity(self) -> float:
        """a [eq. 51]: energy per length and temperature at a fixed flux of slow particles."""
        return self.fugacity + 1 / (2 * self.cell_length)

    @property
    def sound_speed(self) -> float:
        """c [eq. 52], a length over a time."""
        return 2 * self.fugacity * sqrt(self.temperature / (self.inertia * self.heat_capacity))

    @property
    def sound_speed_in_cells(self) -> float:
        return self.sound_speed / self.cell_length

    @property
    def self_coupling(self) -> float:
        """λ_s [eq. 53]: the peak has the width (λ_s t)^(2/3)."""
        steepening = self.fugacity / self.heat_capacity + 2 * self.fugacity / self.inertia
        return steepening * sqrt(self.temperature / self.inertia)


def slow_logarithm(cut: float, temperature: float = 1.0) -> float:
    """Λ [eq. 50] of momenta |p| > cut."""
    from scipy.special import exp1  # noqa: PLC0415  0.2 s

    return float(exp1(cut**2 / (2 * temperature)) / 2)


def logarithm_at(time: float, temperature: float = 1.0, cell_length: float = 1.0) -> float:
    """Λ(t) [eq. 12] of the particles that move within a time: at most 1 more than that of the cut λ/t."""
    cut = cell_length / time
    slower = sqrt(pi * temperature / 2) * erf(cut / sqrt(2 * temperature)) / cut
    return slow_logarithm(cut, temperature) + slower
