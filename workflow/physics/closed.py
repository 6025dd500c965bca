"""Closed chains."""

import numpy as np
from numpy.typing import ArrayLike

from workflow.physics.sound import logarithm_at

ITERATIONS = 20  # of the quasi-stationary estimate; each reduces the error by a factor of at least 8


def persistence_law(sigma: np.ndarray) -> np.ndarray:
    """Persistence for independent Gaussian momenta of particle and scatterer at one temperature."""
    return np.arccos(sigma) / np.pi


def persistence_at_momentum(sigma: float, total_mass: float, momentum: float) -> float:
    """Persistence where the total momentum is conserved [eq. 10]. total_mass: variance that it would have if
    the momenta were independent, over T; momentum: its mean square, over T."""
    reduction = (1 - momentum / total_mass) / total_mass
    return float(np.arccos((sigma + reduction) / (1 - reduction)) / np.pi)


def quasi_stationary(particles: float, start: float, length: float, time: ArrayLike) -> np.ndarray:
    """Temperature T and logarithm Λ of a chain from scatterers at rest, at the given times: T solves eq.
    13, in which Λ [eq. 12] depends on T. particles: per cell; start: temperature of the particles at the
    start; length: of a cell."""
    solutions = []
    for moment in np.atleast_1d(time):
        temperature = start
        for _ in range(ITERATIONS):
            slow = logarithm_at(moment, temperature, length)
            temperature = start * particles * slow / (particles + slow)
        solutions.append((temperature, slow))
    return np.array(solutions).T
