"""Energy pulses in rings: starts, and looks of the runs."""

from collections.abc import Sequence

import numpy as np

from workflow.lib import style
from workflow.lib.load import Result

# By run: marker, colour, fill colour and label; in the order of the legends, the paper's start first.
LOOKS = {
    "rest": ("s", style.VERMILLION, "white", "from rest, as in the paper"),
    "gaussian": ("o", style.BLUE, style.BLUE, "Gaussian start"),
    "long": ("^", style.SKY, style.SKY, "Gaussian, $N = {cells}$"),
}


def start(result: Result) -> str | float:
    return result.parameters["scatterer_temperature"]


def look(result: Result) -> tuple[str, str, str, str]:
    """Marker, colour, fill colour and label; runs of the user's own have their name."""
    return LOOKS.get(result.run, ("P", style.BLACK, style.BLACK, result.run))


def in_order(results: Sequence[Result]) -> list[Result]:
    names = [*LOOKS]
    return sorted(results, key=lambda result: names.index(result.run) if result.run in LOOKS else len(names))


def label(result: Result) -> str:
    return look(result)[3].format(cells=result.parameters["cells"])


def look_of(result: Result) -> style.Look:
    marker, color, face, _ = look(result)
    return style.points(marker, color, face)


def resolved(values: np.ndarray) -> np.ndarray:
    """Indices of the times with a moving peak, at the others the values are NaN."""
    return np.flatnonzero(np.isfinite(values))
