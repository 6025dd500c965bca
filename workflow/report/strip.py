"""The picture of one claim: the acceptance band, and the numbers with their intervals."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

from workflow.claims.verdict import Reading

WIDTH, MARGIN = 200, 8  # of the picture, in its own units
MOST = 24  # numbers in a picture; of more, those closest to an edge of the band or beyond it


class Point(NamedTuple):
    """A number with the ends of its interval. verdict: on this number."""

    low: float
    value: float
    high: float
    verdict: str


@dataclass(frozen=True)
class Strip:
    """Positions in the picture, rounded to a tenth."""

    band: tuple[float, float]
    points: list[Point]


def strip_of(reading: Reading) -> Strip | None:
    """None where no number has an error."""
    intervals = [(*one.interval(reading.share), one.value) for one in reading.numbers]
    finite = [one for one in intervals if all(map(math.isfinite, one))]
    if not finite:
        return None
    shown = sorted(finite, key=lambda one: max(reading.band.low - one[0], one[1] - reading.band.high))[-MOST:]
    edges = [edge for edge in (reading.band.low, reading.band.high) if math.isfinite(edge)]
    seen = [*edges, *(one[2] for one in shown), *(end for one in shown for end in clipped(one, edges))]
    low, high = min(seen), max(seen)
    spread = (high - low) or abs(high) or 1.0

    def position(value: float) -> float:
        """Values outside are put just beyond the frame of the numbers."""
        within = min(max((value - low) / spread, -0.04), 1.04)
        return round(MARGIN + within * (WIDTH - 2 * MARGIN), 1)

    return Strip(
        (position(reading.band.low), position(reading.band.high)),
        [
            Point(
                position(first),
                position(value),
                position(last),
                reading.band.outcome((first, last)).name.lower(),
            )
            for first, last, value in shown
        ],
    )


def clipped(interval: tuple[float, float, float], edges: Iterable[float]) -> tuple[float, float]:
    """Ends of an interval, at most thrice as far from its value as the farthest edge is: wide intervals leave the picture."""
    low, high, value = interval
    most = 3 * max((abs(value - edge) for edge in edges), default=0) or math.inf
    return max(low, value - most), min(high, value + most)
