"""Numbers and verdicts as the report prints them."""

import math
import re
from collections.abc import Callable
from typing import TypeVar

from markupsafe import Markup, escape

from workflow.claims.data import Data, MissingError
from workflow.claims.judge import Judgement
from workflow.claims.verdict import POWER, Band, Number, Outcome, Reading
from workflow.lib.caption import power_of_ten, scientific
from workflow.lib.fit import with_error

SIGNS = {
    Outcome.REPRODUCED: "✓",
    Outcome.IN_MEANING: "≈",
    Outcome.CONTRADICTED: "✗",
    Outcome.UNDECIDED: "?",
    Outcome.NOT_TESTABLE: "–",
}
READINGS = {
    "literal": "literal statement",
    "intended": "intended meaning",
    "alternative": "alternative reading (not counted)",
}
T = TypeVar("T")
MOST = 10_000  # largest factor of replicas that is estimated
SMALLEST = -12  # power of ten; smaller p-values are not distinguished
BOUND = " ± "
MINUS = "\N{MINUS SIGN}"


def typeset(text: str) -> Markup:
    """Text as HTML, with superscripts after ^, subscripts after _, and typographic minus signs."""
    power = r"\^(?:\(([^)]*)\)|([-−]?\d+\.\d+(?:\(\d+\))?|[-−]?\w+))"
    text = re.sub(
        power, lambda match: f"<sup>{match[1] or match[2]}</sup>", str(escape(text)).replace("&#39;", "'")
    )
    text = re.sub(r"_(\w+)", r"<sub>\1</sub>", text)
    return Markup(re.sub(r"(?<![\w)])-(?=\d)|(?<=\s)-(?=\s)", MINUS, text))


def cell(text: str) -> str:
    """Text as the content of a cell of a Markdown table."""
    return typeset(text).replace("|", r"\|")


def acceptance(band: Band) -> str:
    low, high = (f"{edge:g}".replace("-", MINUS) for edge in (band.low, band.high))
    if math.isinf(band.high):
        return f"above {low}"
    return f"below {high}" if math.isinf(band.low) else f"{low} to {high}"


def value(number: Number) -> str:
    """Number with its standard error in units of the last digit, and the bound on its systematic error."""
    if not number.error and abs(number.value) < number.systematic:
        return f"0 to rounding{BOUND}{short(number.systematic)}"
    size = max(abs(number.value), number.error, number.systematic)
    if 0 < size < 1e-3:
        power = math.floor(math.log10(size))
        scaled = value(number.over(10.0**power))
        return f"({scaled})·{power_of_ten(power)}" if BOUND in scaled else f"{scaled}·{power_of_ten(power)}"
    bound = f"{BOUND}{short(number.systematic)} syst" if number.systematic > 0.05 * number.error else ""
    return f"{with_error(number.value, number.error)}{bound}"


def value_or_text(shown: Number | str) -> str:
    """The number as by value(); a text unchanged."""
    return shown if isinstance(shown, str) else value(shown)


def or_reason(text: Callable[[T], str], number: Callable[[Data], T], data: Data) -> str:
    """The text of a number, or why there is none."""
    try:
        return text(number(data))
    except MissingError as error:
        return f"not measured ({error})"


def short(size: float) -> str:
    """Two digits, with a power of ten where there would be many zeros."""
    if not 0 < size < 1e-3:
        return f"{size:.2g}"
    return scientific(size)


def named(number: Number) -> str:
    return f"{number.label}: {value(number)}"


def p_value(p: float) -> str:
    if math.isnan(p):
        return "unknown"
    if p >= 1e-3:
        return f"= {p:.2g}"
    power = math.floor(math.log10(p)) if p else -math.inf
    return f"< {power_of_ten(SMALLEST)}" if power < SMALLEST else f"= {scientific(p, 1)}"


def which(reading: Reading) -> str:
    """Label of the number that decides, and which of several it is."""
    kind = (
        "farthest outside the band"
        if reading.outcome is Outcome.CONTRADICTED
        else "closest to the band's edge"
    )
    several = f"; of {len(reading.numbers)} numbers the one {kind}" if len(reading.numbers) > 1 else ""
    return f"{reading.worst.label}{several}"


def consequence(judgement: Judgement) -> str:
    """Sentence on the power of a decided test, or on the effort that would decide an undecided one."""
    reading = judgement.deciding
    if reading is None:
        return ""
    if judgement.outcome in (Outcome.REPRODUCED, Outcome.IN_MEANING):
        return f"Detectable at {POWER:.0%} power: {short(reading.detectable)} beyond the band."
    return remedy(reading) if judgement.outcome is Outcome.UNDECIDED else ""


def remedy(reading: Reading) -> str:
    """The replicas that would decide an open reading at unchanged values."""
    factor = max(_factor(number, reading) for number in reading.numbers)
    if not math.isfinite(factor):
        return "More replicas alone do not decide it: the systematic error is too large, or the value is on the band's edge."
    if factor > MOST:
        return f"More than {MOST} times the replicas would decide it: the value is close to the band's edge."
    return f"About {max(2, math.ceil(factor))} times the replicas would decide it, at unchanged values."


def _factor(number: Number, reading: Reading) -> float:
    """Factor by which the replicas must grow to decide the reading; 1 if it is decided."""
    low, high = number.interval(reading.share)
    if reading.band.outcome((low, high)) is not Outcome.UNDECIDED:
        return 1.0
    distance = (
        min(abs(number.value - edge) for edge in (reading.band.low, reading.band.high)) - number.systematic
    )
    half = (high - low) / 2 - number.systematic
    return (half / distance) ** 2 if distance > 0 else math.inf
