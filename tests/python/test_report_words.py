"""Numbers and strips of the report."""

import math

import pytest

from workflow.claims.verdict import Band, Number, Reading
from workflow.lib.fit import with_error
from workflow.report import words
from workflow.report.strip import WIDTH, strip_of

BAND = Band(-1, 1)


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (Number("", 1.8515, 0.0019), with_error(1.8515, 0.0019)),
        (Number("", 0.6397, 0.0041, systematic=0.0234), f"{with_error(0.6397, 0.0041)} ± 0.023 syst"),
        (Number("", -0.000861, 0.0000168), f"{with_error(-8.61, 0.168)}·10⁻⁴"),
        (Number("", 0.0, 0.0), "0"),
        (Number("", 2e-4, 0.01), "0.000(10)"),
        (Number("", 0.007544, 0.0, systematic=4.61e-12), "0.007544 ± 4.6·10⁻¹² syst"),
        (Number("", 4.4e-16, 0.0, systematic=1.5e-13), "0 to rounding ± 1.5·10⁻¹³"),
        (Number("", 0.5, math.nan), "0.5"),
    ],
)
def test_numbers(number: Number, text: str) -> None:
    assert words.value(number) == text


def test_p_values() -> None:
    assert [words.p_value(p) for p in (1.0, 0.0431, 6.2e-8, 1e-40, 0.0, math.nan)] == [
        "= 1",
        "= 0.043",
        "= 6·10⁻⁸",
        "< 10⁻¹²",
        "< 10⁻¹²",
        "unknown",
    ]


def test_typesetting() -> None:
    assert words.typeset("N^0.1922(37) at 10^-4 <b>, T_N - 3") == (
        "N<sup>0.1922(37)</sup> at 10<sup>−4</sup> &lt;b&gt;, T<sub>N</sub> − 3"
    )


def test_the_replicas_for_an_edge_are_not_estimated() -> None:
    edge = Reading(BAND, (Number("", 1 - 1e-9, 0.1),), 0.05)
    assert words.remedy(edge).startswith("More than 10000 times")


def test_more_replicas_decide_what_chance_leaves_open() -> None:
    """An interval of half width 2 about 0 has to shrink to 1, which takes four times the replicas."""
    open_ = Reading(BAND, (Number("", 0.0, 2 / 1.959964),), 0.05)
    assert words.remedy(open_).startswith("About 4 times")
    bound = Reading(BAND, (Number("", 0.5, 0.1, systematic=0.7),), 0.05)
    assert "do not decide it" in words.remedy(bound)


def test_a_strip_keeps_order_and_stays_in_its_picture() -> None:
    numbers = (Number("", 0.0, 0.1), Number("", 5.0, 0.1), Number("", 0.0, 1e9), Number("", 0.0, math.nan))
    strip = strip_of(Reading(BAND, numbers, 0.05))
    assert len(strip.points) == 3
    assert 0 < strip.band[0] < strip.band[1] < WIDTH
    for low, value, high, _ in strip.points:
        assert 0 <= low <= value <= high <= WIDTH
    assert {(point.value > strip.band[1], point.verdict) for point in strip.points} == {
        (True, "contradicted"),
        (False, "reproduced"),
        (False, "undecided"),
    }
    assert strip_of(Reading(BAND, numbers[3:], 0.05)) is None
    half = strip_of(Reading(Band(0, math.inf), numbers[:1], 0.05))
    assert half.band[1] == WIDTH
