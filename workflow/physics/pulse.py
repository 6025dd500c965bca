"""Energy pulses in rings: starts, and looks of the runs."""

from collections.abc import Sequence

import numpy as np

from workflow.lib import style
from workflow.lib.load import Result
from workflow.lib.text import format_number

# By run: marker, colour, which is none of style.SEQUENCE, and fill colour; the paper's start is first.
LOOKS = {
    "rest": ("s", style.GREEN, "white"),
    "gaussian": ("o", style.PURPLE, style.PURPLE),
    "long": ("^", style.PURPLE, "white"),
}


def start(result: Result) -> str | float:
    return result.parameters["scatterer_temperature"]


def named_start(result: Result) -> str:
    """The start in words."""
    words = {"particles": "warm", 0: "at rest"}
    state = words.get(start(result)) or f"at T = {format_number(float(start(result)))}"
    return f"scatterers start {state}"


def look(result: Result) -> tuple[str, str, str]:
    """Marker, colour and fill colour."""
    return LOOKS.get(result.run, ("P", style.BLACK, style.BLACK))


def in_order(results: Sequence[Result]) -> list[Result]:
    names = [*LOOKS]
    return sorted(results, key=lambda result: names.index(result.run) if result.run in LOOKS else len(names))


def label(result: Result) -> str:
    """Start, relaxation and size, the paper's start marked; runs of the user's own have their name."""
    if result.run not in LOOKS:
        return result.run
    time = float(result.parameters["relaxation_time"])
    relaxed = f", relaxed for {format_number(time)}" if time else ""
    paper = " (paper)" if start(result) == 0 else ""
    size = f", $N = {result.parameters['cells']}$" if result.run == "long" else ""
    return named_start(result) + paper + relaxed + size


def look_of(result: Result) -> style.Look:
    return style.points(*look(result))


def resolved(values: np.ndarray) -> np.ndarray:
    """Indices of the times with a moving peak, at the others the values are NaN."""
    return np.flatnonzero(np.isfinite(values))
