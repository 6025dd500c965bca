"""Rings in equilibrium."""

import numpy as np

from workflow.lib import style
from workflow.lib.load import Result
from workflow.physics.mode_coupling import Chain, logarithm_at

LOOKS = [
    ("o", style.BLUE),
    ("s", style.VERMILLION),
    ("^", style.ORANGE),
    ("v", style.SKY),
    ("P", style.BLACK),
]


def chain(result: Result, time: float = np.inf) -> Chain:
    """The gas of a ring, with only those slow particles that move within a time."""
    temperature, length, sigma = (result.parameters[name] for name in ("temperature", "cell-length", "sigma"))
    slow = logarithm_at(time, temperature, length) if np.isfinite(time) else np.inf
    zeta = result.parameters["fugacity"] * length
    return Chain(zeta, (1 + sigma) / (1 - sigma), temperature, length, slow)
