"""Closed chains."""

import numpy as np

ROUNDING = 1e-9  # relative rounding error of times on a logarithmic grid


def persistence_law(sigma: np.ndarray) -> np.ndarray:
    """Persistence for independent Gaussian momenta of particle and scatterer at one temperature."""
    return np.arccos(sigma) / np.pi
