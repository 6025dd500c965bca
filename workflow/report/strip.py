"""The picture of one claim in the summary: the acceptance band, and the numbers with their intervals."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

from workflow.claims.verdict import Outcome, Reading

WIDTH, MARGIN = 200, 8  # of the picture, in its own units
MOST = 24  # numbers drawn; of more, those nearest to an edge or beyond it


class Point(NamedTuple):
    """A number with the ends of its interval; outside: the whole interval lies out of the band."""

    low: float
    value: float
    high: float
    outside: bool


@dataclass(frozen=True)
class Strip:
    """Places along the picture, rounded to a tenth."""

    band: tuple[float, float]
    points: list[Point]


def strip_of(reading: Reading) -> Strip | None:
    """None where no number has an error."""
    intervals = [(*one.interval(reading.share), one.value) for one in reading.numbers]
    known = sorted(
        (one for one in intervals if all(map(math.isfinite, one))), key=lambda one: reach(one, reading)
    )
    if not known:
        return None
    shown = known[-MOST:]
    edges = [edge for edge in (reading.band.low, reading.band.high) if math.isfinite(edge)]
    seen = [*edges, *(one[2] for one in shown), *(end for one in shown for end in clipped(one, edges))]
    low, high = min(seen), max(seen)
    spread = (high - low) or abs(high) or 1.0

    def place(value: float) -> float:
        """What lies outside ends just beyond the frame of the numbers."""
        within = min(max((value - low) / spread, -0.04), 1.04)
        return round(MARGIN + within * (WIDTH - 2 * MARGIN), 1)

    return Strip(
        (place(reading.band.low), place(reading.band.high)),
        [
            Point(
                place(first),
                place(value),
                place(last),
                reading.band.outcome((first, last)) is Outcome.CONTRADICTED,
            )
            for first, last, value in shown
        ],
    )


def reach(interval: tuple[float, float, float], reading: Reading) -> float:
    return max(reading.band.low - interval[0], interval[1] - reading.band.high)


def clipped(interval: tuple[float, float, float], edges: Iterable[float]) -> tuple[float, float]:
    """Ends of an interval, but no farther from its value than thrice the distance to the farthest edge: wide ones run out of the picture."""
    low, high, value = interval
    most = 3 * max((abs(value - edge) for edge in edges), default=0) or math.inf
    return max(low, value - most), min(high, value + most)
