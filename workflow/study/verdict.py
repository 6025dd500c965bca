"""The verdict on a statement from its numbers and its acceptance band.

A measurement is an interval: the value, plus and minus the systematic error and as many standard errors as
the level requires. The statement is reproduced if all its intervals are inside the band, contradicted if one
is outside, and undecided otherwise, also if nothing was measured. So neither of the first two verdicts is
wrong more often than the level. A statement may have a wider band of deviations that no eye sees in a figure:
it is nearly reproduced if all intervals are inside that one, and contradicted only if one is outside.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cache

from scipy.special import stdtrit  # scipy.stats takes half a second to import

FAMILY_LEVEL = 0.05  # probability that any statement gets a wrong verdict by chance


class Outcome(StrEnum):
    REPRODUCED = "reproduced"
    NEARLY = "nearly reproduced"
    CONTRADICTED = "contradicted"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Estimate:
    """A measured number. error: standard error with `dof` degrees of freedom; systematic: bound on the
    systematic error."""

    label: str
    value: float
    error: float
    dof: float = math.inf
    systematic: float = 0.0

    def __truediv__(self, unit: float) -> "Estimate":
        size = abs(unit)
        return replace(
            self, value=self.value / unit, error=self.error / size, systematic=self.systematic / size
        )

    def __sub__(self, expected: float) -> "Estimate":
        return replace(self, value=self.value - expected)

    def interval(self, level: float) -> tuple[float, float]:
        """Interval that contains the true value with the probability 1 - level."""
        half = critical(level, self.dof) * self.error + self.systematic if self.error else self.systematic
        return self.value - half, self.value + half


@dataclass(frozen=True)
class Band:
    """Acceptance band of a statement."""

    low: float
    high: float

    @classmethod
    def parse(cls, text: str) -> "Band":
        """Parses a band as written in the table of statements: `0.95 to 1.05`, `above 0`, `below -0.5`."""
        match text.split():
            case ["above", low]:
                return cls(float(low), math.inf)
            case ["below", high]:
                return cls(-math.inf, float(high))
            case [low, "to", high] if float(low) < float(high):
                return cls(float(low), float(high))
        raise ValueError(f"'{text}' is not an acceptance band: write '0.95 to 1.05', 'above 0' or 'below 1'")

    def contains(self, low: float, high: float) -> bool:
        return self.low <= low and high <= self.high

    def excludes(self, low: float, high: float) -> bool:
        return high < self.low or low > self.high

    def wider(self, factor: float) -> "Band":
        """Band with the same centre; a band with one edge stays as it is."""
        if math.isinf(self.low) or math.isinf(self.high):
            return self
        centre, half = (self.low + self.high) / 2, factor * (self.high - self.low) / 2
        return Band(centre - half, centre + half)


@dataclass(frozen=True)
class Verdict:
    """Verdict on a statement that all its numbers lie in the band. level: significance level, shared equally
    by the numbers; nearly: the wider band, if there is one."""

    band: Band
    numbers: tuple[Estimate, ...]
    level: float
    nearly: Band | None = None

    def outcome_of(self, number: Estimate) -> Outcome:
        """Verdict on one of the numbers."""
        low, high = number.interval(self.level / len(self.numbers))
        if self.band.contains(low, high):
            return Outcome.REPRODUCED
        widest = self.nearly or self.band
        if widest.contains(low, high):
            return Outcome.NEARLY
        return Outcome.CONTRADICTED if widest.excludes(low, high) else Outcome.UNDECIDED

    @property
    def outcome(self) -> Outcome:
        outcomes = {self.outcome_of(number) for number in self.numbers} or {Outcome.UNDECIDED}
        order = (Outcome.CONTRADICTED, Outcome.UNDECIDED, Outcome.NEARLY, Outcome.REPRODUCED)
        return next(outcome for outcome in order if outcome in outcomes)

    @property
    def decisive(self) -> Estimate:
        """The number farthest outside the band; without one, the number whose interval reaches farthest
        across an edge or is closest to it. Distances are in the unit of the band."""

        def reach(number: Estimate) -> tuple[bool, float]:
            low, high = number.interval(self.level / len(self.numbers))
            beyond = max(self.band.low - high, low - self.band.high)
            far = max(self.band.low - low, high - self.band.high)
            return (True, beyond) if beyond > 0 else (False, math.inf if math.isnan(far) else far)

        return max(self.numbers, key=reach)


def level_of_each(statements: int) -> float:
    """Significance level of each statement by Bonferroni: the probability of any wrong verdict is at most
    FAMILY_LEVEL."""
    return FAMILY_LEVEL / statements


@cache
def critical(level: float, dof: float) -> float:
    return -float(stdtrit(dof, level / 2))


def with_systematic(number: Estimate, others: Sequence[float]) -> Estimate:
    """Adds the largest distance from the values of other settings to the bound on the systematic error. An
    unknown value makes the bound infinite, so that nothing is decided."""
    differences = [abs(other - number.value) for other in others]
    known = all(map(math.isfinite, differences))
    return replace(
        number, systematic=number.systematic + max(differences, default=0.0) if known else math.inf
    )
