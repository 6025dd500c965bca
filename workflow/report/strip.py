"""The picture of one claim: the acceptance band, and the numbers with their intervals."""

import math
from dataclasses import dataclass
from typing import NamedTuple

from workflow.claims.verdict import Reading

WIDTH = 200  # width of the picture in SVG units
BORDER = 0.15  # space beside the values, in units of their range
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
    """Picture of a reading; None if no number has a finite interval."""
    intervals = [(*number.interval(reading.share), number.value) for number in reading.numbers]
    finite = [entry for entry in intervals if all(map(math.isfinite, entry))]
    if not finite:
        return None
    shown = sorted(finite, key=lambda entry: max(reading.band.low - entry[0], entry[1] - reading.band.high))[
        -MOST:
    ]
    edges = [edge for edge in (reading.band.low, reading.band.high) if math.isfinite(edge)]
    seen = [*edges, *(value for *_, value in shown)]
    low, high = min(seen), max(seen)
    spread = (high - low) or 1.0

    def position(value: float) -> float:
        """The frame contains the values and the edges; longer intervals end at its border."""
        within = min(max((value - low) / spread, -BORDER), 1 + BORDER)
        return round(WIDTH * (within + BORDER) / (1 + 2 * BORDER), 1)

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
