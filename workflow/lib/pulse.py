"""Energy pulses in rings, from either start."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import CHAIN, listed, number, parameters, replicas
from workflow.lib.load import Result

CLOSED = 0.02  # energy opposite to the pulse over the largest energy, above which the ring has closed
FAINT = 0.45
# Marker, colour, fill colour and label by the initial temperature of the scatterers; the paper's start first.
STARTS = {
    0: ("s", style.VERMILLION, "white", "from rest, as in the paper"),
    "particles": ("o", style.BLUE, style.BLUE, "Gaussian start"),
}


def start(result: Result) -> str | float:
    return result.parameters["scatterer-temperature"]


def gaussian_start(results: Sequence[Result]) -> Result:
    """The run whose scatterers start at the temperature of the particles."""
    return next(result for result in results if start(result) == "particles")


def paper_first(results: Sequence[Result]) -> list[Result]:
    return sorted(results, key=lambda result: list(STARTS).index(start(result)))


def ring_closed(result: Result) -> np.ndarray:
    """At every time, whether the two sides of the pulse overlap where they meet, opposite to it."""
    difference = result["energy_difference"].mean
    opposite = difference[:, [0, 1, -2, -1]].mean(axis=1)
    return opposite > CLOSED * difference.max(axis=1)


def look_of(result: Result) -> style.Look:
    marker, color, face, _ = STARTS[start(result)]
    return style.points(marker, color, face)


def draw_marked(
    axes: Axes, time: np.ndarray, values: tuple[np.ndarray, np.ndarray], closed: np.ndarray, **look: Any
) -> None:
    """Values with errors; faint where the ring has closed."""
    for part, alpha in ((~closed, 1), (closed, FAINT)):
        axes.errorbar(time[part], values[0][part], values[1][part], alpha=alpha, **look)
        look.pop("label", None)


def pulse(results: Sequence[Result]) -> str:
    """Text with the parameters and starts. The paper states the start from rest, but not its relaxation time."""
    names = parameters(results, "particles-per-cell", "energy", "pulse-energy")
    time = listed(number(result.parameters["relaxation-time"]) for result in results if start(result) == 0)
    return f"""{parameters(results, *CHAIN)}, {names} per degree of freedom, {replicas(results)}. Start from scatterers at rest, as in the
        paper, relaxed for {time} (our choice), or Gaussian momenta"""
