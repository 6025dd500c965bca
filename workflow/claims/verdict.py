"""Rules that give the verdict on a claim from numbers: pure functions, which read no files.

A claim has an acceptance band. A measurement is an interval: the value, plus and minus the systematic error and as
many standard errors as the level requires. The claim is reproduced if the interval lies inside the band, contradicted
if it lies outside, and undecided if it reaches across an edge. So neither verdict is wrong more often than the level.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cache

from scipy.special import stdtr, stdtrit  # scipy.stats takes half a second to import

FAMILY_LEVEL = 0.05  # probability that any of the claims gets a wrong verdict by chance
POWER = 0.95  # probability of detecting a deviation as large as the stated one


class Outcome(StrEnum):
    REPRODUCED = "reproduced"
    IN_MEANING = "reproduced in meaning"
    CONTRADICTED = "contradicted"
    UNDECIDED = "undecided at this precision"
    NOT_TESTABLE = "not testable"


@dataclass(frozen=True)
class Number:
    """A measured number. error: standard error with `freedom` degrees of freedom; systematic: bound on the systematic error."""

    label: str
    value: float
    error: float
    freedom: float = math.inf
    systematic: float = 0.0

    def over(self, unit: float, minus: float = 0) -> "Number":
        """The number value/unit - minus, with its errors divided by |unit|."""
        size = abs(unit)
        return replace(
            self, value=self.value / unit - minus, error=self.error / size, systematic=self.systematic / size
        )

    def interval(self, level: float) -> tuple[float, float]:
        """Interval that contains the true value with the probability 1 - level."""
        half = critical(level, self.freedom) * self.error + self.systematic if self.error else self.systematic
        return self.value - half, self.value + half

    def p_value(self, band: "Band") -> float:
        """Two-sided p-value of the hypothesis that the true value is in the band. It is below a level exactly if the interval of this level is
        outside the band."""
        beyond = max(band.low - self.value, self.value - band.high) - self.systematic
        if not beyond > 0:
            return math.nan if math.isnan(beyond) else 1.0
        return float(2 * stdtr(self.freedom, -beyond / self.error)) if self.error else 0.0

    def detectable(self, level: float) -> float:
        """Distance of a true value from the band at which the band is contradicted with the probability POWER."""
        spread = critical(level, self.freedom) + critical(2 * (1 - POWER), self.freedom)
        return spread * self.error + self.systematic if self.error else self.systematic


@dataclass(frozen=True)
class Band:
    """Acceptance band of a claim."""

    low: float
    high: float

    @classmethod
    def of(cls, text: str) -> "Band":
        """Parses a band as written in the table of claims: `0.95 to 1.05`, `above 0`, `below -0.5`."""
        match text.split():
            case ["above", low]:
                return cls(float(low), math.inf)
            case ["below", high]:
                return cls(-math.inf, float(high))
            case [low, "to", high] if float(low) < float(high):
                return cls(float(low), float(high))
        raise ValueError(f"'{text}' is not an acceptance band: write '0.95 to 1.05', 'above 0' or 'below 1'")

    def outcome(self, interval: tuple[float, float]) -> Outcome:
        low, high = interval
        if self.low <= low and high <= self.high:
            return Outcome.REPRODUCED
        return Outcome.CONTRADICTED if high < self.low or low > self.high else Outcome.UNDECIDED


@dataclass(frozen=True)
class Reading:
    """One way to read a claim: all its numbers lie in the band. A reading without numbers cannot be tested."""

    band: Band
    numbers: tuple[Number, ...]
    level: float  # significance level of the reading; each number is tested at an equal fraction of it

    @property
    def share(self) -> float:
        """Significance level of each number, by Bonferroni."""
        return self.level / max(1, len(self.numbers))

    @property
    def outcome(self) -> Outcome:
        outcomes = {self.band.outcome(number.interval(self.share)) for number in self.numbers}
        order = (Outcome.CONTRADICTED, Outcome.UNDECIDED, Outcome.REPRODUCED)
        return next((outcome for outcome in order if outcome in outcomes), Outcome.NOT_TESTABLE)

    @property
    def p_value(self) -> float:
        """Bonferroni-corrected p-value of the most significant number."""
        return min(
            (min(1.0, len(self.numbers) * number.p_value(self.band)) for number in self.numbers),
            default=math.nan,
        )

    @property
    def worst(self) -> Number:
        """The number that is shown: the one farthest outside the band, else the one whose interval reaches farthest across an edge
        or is closest to it. Distances are in the unit of the band, which the numbers of a reading have in common."""

        def reach(number: Number) -> tuple[bool, float]:
            low, high = number.interval(self.share)
            beyond = max(self.band.low - high, low - self.band.high)
            far = max(self.band.low - low, high - self.band.high)
            return (True, beyond) if beyond > 0 else (False, math.inf if math.isnan(far) else far)

        return max(self.numbers, key=reach)

    @property
    def detectable(self) -> float:
        return max(number.detectable(self.share) for number in self.numbers)


def combined(literal: Outcome, intended: Outcome | None) -> Outcome:
    """Verdict from the literal statement and from the intended meaning, if it differs. A literal statement that holds is contradicted by a
    refuted meaning: a number may come out for another reason than the one claimed."""
    if intended in (None, Outcome.NOT_TESTABLE):
        return literal
    if literal is Outcome.REPRODUCED and intended is not Outcome.CONTRADICTED:
        return literal
    return Outcome.IN_MEANING if intended is Outcome.REPRODUCED else intended


def level_of_each(claims: int) -> float:
    """Significance level of each claim by Bonferroni: the probability of any wrong verdict is at most FAMILY_LEVEL."""
    return FAMILY_LEVEL / claims


@cache
def critical(level: float, freedom: float) -> float:
    return -float(stdtrit(freedom, level / 2))


def with_systematic(number: Number, others: Sequence[float]) -> Number:
    """Adds the largest distance from the values of other settings to the bound on the systematic error."""
    differences = [abs(other - number.value) for other in others if math.isfinite(other)]
    return replace(number, systematic=number.systematic + max(differences, default=0.0))
