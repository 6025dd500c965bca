"""Energy pulses in rings, from either start."""

from collections.abc import Sequence

from workflow.lib import style
from workflow.lib.caption import CHAIN, listed, number, parameters, replicas
from workflow.lib.load import Result

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


def look_of(result: Result) -> style.Look:
    marker, color, face, _ = STARTS[start(result)]
    return style.points(marker, color, face)


def pulse(results: Sequence[Result]) -> str:
    """Text with the parameters and starts. The paper states the start from rest, but not its relaxation time."""
    names = parameters(results, "particles-per-cell", "energy", "pulse-energy")
    time = listed(number(result.parameters["relaxation-time"]) for result in results if start(result) == 0)
    return f"""{parameters(results, *CHAIN)}, {names} per degree of freedom, {replicas(results)}. Start from scatterers at rest, as in the
        paper, relaxed for {time} (our choice), or Gaussian momenta"""
