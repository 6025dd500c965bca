"""The rules of the verdicts on numbers with known true values: how often a verdict is wrong, and its
power."""

import math

import numpy as np
import pytest
from scipy.stats import binom

from workflow.lib.text import format_with_error
from workflow.study.verdict import Band, Estimate, Outcome, Verdict, critical, level_of_each, with_systematic

BAND = Band(-1, 1)
LEVEL = 0.1
TRIALS, REPLICAS = 20000, 12


def measured(truth: float, spread: float, numbers: int = 1) -> list[Verdict]:
    """One verdict per trial, with numbers and estimated errors from normal replicas."""
    replicas = np.random.default_rng(1).normal(truth, spread, (TRIALS, numbers, REPLICAS))
    mean, error = replicas.mean(axis=2), replicas.std(axis=2, ddof=1) / math.sqrt(REPLICAS)
    return [
        Verdict(BAND, tuple(Estimate("", *one, REPLICAS - 1) for one in zip(*pair, strict=True)), LEVEL)
        for pair in zip(mean, error, strict=True)
    ]


def share(verdicts: list[Verdict], outcome: Outcome) -> int:
    return sum(verdict.outcome is outcome for verdict in verdicts)


def within(count: int, probability: float) -> bool:
    low, high = binom.interval(1 - 1e-6, TRIALS, probability)
    return low <= count <= high


@pytest.mark.parametrize("wrong", [Outcome.CONTRADICTED, Outcome.REPRODUCED])
def test_wrong_verdicts_at_the_edge_are_as_frequent_as_the_level(wrong: Outcome) -> None:
    """If the true value is on the edge of the band, each of both verdicts occurs with half of the
    two-sided level, and is wrong."""
    assert within(share(measured(1, 0.2), wrong), LEVEL / 2)


def test_many_numbers_share_the_level() -> None:
    each = LEVEL / 5 / 2
    assert within(share(measured(1, 0.2, 5), Outcome.CONTRADICTED), 1 - (1 - each) ** 5)


@pytest.mark.parametrize(
    ("number", "outcome"),
    [
        (Estimate("exact and inside", 1.0, 0.0), Outcome.REPRODUCED),
        (Estimate("exact and outside", 1.001, 0.0), Outcome.CONTRADICTED),
        (Estimate("its bound crosses the edge", 0.99, 0.0, systematic=0.02), Outcome.UNDECIDED),
        (Estimate("its bound takes it back", 1.1, 0.01, systematic=0.2), Outcome.UNDECIDED),
        (Estimate("beyond its bound", 1.5, 0.01, systematic=0.2), Outcome.CONTRADICTED),
        (Estimate("error unknown", 5.0, math.nan, 9), Outcome.UNDECIDED),
        (Estimate("value unknown", math.nan, 0.1, 9), Outcome.UNDECIDED),
        (Estimate("one replica", 5.0, 0.1, 0), Outcome.UNDECIDED),
        (Estimate("two replicas", 4.0, 0.5, 1), Outcome.UNDECIDED),
        (Estimate("many replicas", 5.0, 0.5, 1000), Outcome.CONTRADICTED),
    ],
    ids=lambda value: getattr(value, "label", ""),
)
def test_verdict_of_one_number_follows_from_its_interval(number: Estimate, outcome: Outcome) -> None:
    verdict = Verdict(BAND, (number,), LEVEL)
    assert verdict.outcome is outcome


@pytest.mark.parametrize(
    ("value", "error", "outcome"),
    [
        (0.5, 0.01, Outcome.REPRODUCED),
        (1.5, 0.01, Outcome.NEARLY),
        (1.0, 0.1, Outcome.NEARLY),  # across the edge of the band, and in any case within the wider one
        (2.0, 0.1, Outcome.UNDECIDED),
        (3.0, 0.1, Outcome.CONTRADICTED),
    ],
)
def test_a_wider_band_of_nearly_reproduced_statements(value: float, error: float, outcome: Outcome) -> None:
    assert Verdict(BAND, (Estimate("", value, error),), LEVEL, Band(-2, 2)).outcome is outcome


def test_one_contradiction_outweighs_what_is_open_and_what_agrees() -> None:
    inside, open_, outside = Estimate("a", 0, 0.01), Estimate("b", 1, 0.5), Estimate("c", 2, 0.01)
    assert Verdict(BAND, (inside, open_), LEVEL).outcome is Outcome.UNDECIDED
    verdict = Verdict(BAND, (inside, open_, outside), LEVEL)
    assert verdict.outcome is Outcome.CONTRADICTED
    assert verdict.decisive is outside
    near, far = Estimate("", 0.1, 0.001), Estimate("", 0.5, 0.01)
    assert Verdict(Band(0, math.inf), (far, near), LEVEL).decisive is near  # not in units of the errors


def test_bands_as_they_are_written() -> None:
    assert Band.parse("-0.5 to 1e-3") == Band(-0.5, 0.001)
    assert Band.parse("above 0") == Band(0, math.inf)
    assert Band.parse("below -2") == Band(-math.inf, -2)
    with pytest.raises(ValueError, match="is not an acceptance band"):
        Band.parse("over 3")


def test_level_of_each_claim_and_systematic_bound() -> None:
    assert 34 * level_of_each(34) == pytest.approx(0.05)
    assert critical(0.05, math.inf) == pytest.approx(1.959964)
    moved = with_systematic(Estimate("", 1.0, 0.1, systematic=0.5), [0.7, 1.1])
    assert moved.systematic == pytest.approx(0.8)


@pytest.mark.parametrize("others", [[math.nan], [1.0, math.nan], [math.nan, 1.0], [math.inf]])
def test_an_unknown_systematic_error_decides_nothing(others: list[float]) -> None:
    for value in (0.5, 7.0):  # inside and outside
        number = with_systematic(Estimate("", value, 0.001), others)
        for band in (BAND, Band(0, math.inf)):
            assert Verdict(band, (number,), LEVEL).outcome is Outcome.UNDECIDED
        assert "∞" in format_with_error(number.value, number.error, number.systematic)


def test_wider_band_keeps_its_centre_or_its_open_side() -> None:
    """Detected mistakes: edges are scaled about 0; the open side of a band becomes NaN."""
    assert Band(0.95, 1.05).wider(2) == Band(pytest.approx(0.9), pytest.approx(1.1))
    assert Band.parse("above 0.5").wider(2) == Band(0.5, math.inf)
