"""Numbers and verdicts as the report writes them."""

import math
import re

from markupsafe import Markup, escape

from workflow.claims.judge import Judgement
from workflow.claims.verdict import POWER, Band, Number, Outcome, Reading
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
    "alternative": "alternative reading, does not count",
}
MOST = 10_000  # times the replicas that are foretold
SMALLEST = -12  # power of ten; p-values below are not told apart


BOUND = " ± "
MINUS = "\N{MINUS SIGN}"


def set_mathematics(text: str, raised: str, lowered: str) -> str:
    """Powers after ^ and indices after _, in these forms, and minus signs."""
    power = r"\^(?:\(([^)]*)\)|(-?\d+\.\d+(?:\(\d+\))?|-?\w+))"
    text = re.sub(power, lambda found: raised.format(found[1] or found[2]), text)
    text = re.sub(r"_(\w+)", lambda found: lowered.format(found[1]), text)
    return re.sub(r"(?<![\w)])-(?=\d)|(?<=\s)-(?=\s)", MINUS, text)


def typeset(text: str) -> Markup:
    """As HTML."""
    return Markup(set_mathematics(str(escape(text)), "<sup>{}</sup>", "<sub>{}</sub>"))


def linked(text: str, link: str) -> str:
    """With a link at the name of every claim: {0} of it stands for the name, {1} for that in small letters."""
    found = re.sub(r"\bC\d\d\b", lambda name: link.format(name[0], name[0].lower()), text)
    return type(text)(found)


def acceptance(band: Band) -> str:
    """As in the table of claims."""
    low, high = (f"{edge:g}".replace("-", MINUS) for edge in (band.low, band.high))
    if math.isinf(band.high):
        return f"above {low}"
    return f"below {high}" if math.isinf(band.low) else f"{low} to {high}"


def value(number: Number) -> str:
    """With the standard error in units of the last digit, and the systematic bound apart."""
    if not number.error and abs(number.value) < number.systematic:
        return f"0 to rounding{BOUND}{short(number.systematic)}"
    size = max(abs(number.value), number.error, number.systematic)
    if 0 < size < 1e-3:
        power = math.floor(math.log10(size))
        scaled = value(number.over(10.0**power))
        return f"({scaled})·10^{power}" if BOUND in scaled else f"{scaled}·10^{power}"
    bound = f"{BOUND}{short(number.systematic)} syst" if number.systematic > 0.05 * number.error else ""
    return f"{with_error(number.value, number.error)}{bound}"


def short(size: float) -> str:
    """Two digits, with a power of ten where there would be many zeros."""
    if not 0 < size < 1e-3:
        return f"{size:.2g}"
    power = math.floor(math.log10(size))
    return f"{size / 10.0**power:.2g}·10^{power}"


def told(number: Number) -> str:
    return f"{number.label}: {value(number)}"


def told_all(reading: Reading) -> str:
    return "; ".join(map(told, reading.numbers))


def p_value(p: float) -> str:
    if math.isnan(p):
        return "unknown"
    if p >= 1e-3:
        return f"{p:.2g}"
    power = math.floor(math.log10(p)) if p else -math.inf
    return f"< 10^{SMALLEST}" if power < SMALLEST else f"{p / 10.0**power:.0f}·10^{power}"


def result(reading: Reading) -> str:
    """The number that decides, and how many were looked at: of a reading that is contradicted, the clearest."""
    kind = "clearest" if reading.outcome is Outcome.CONTRADICTED else "least certain"
    several = f", the {kind} of {len(reading.numbers)}" if len(reading.numbers) > 1 else ""
    return f"{told(reading.worst)}{several}"


def power(reading: Reading) -> str:
    return f"A deviation of {short(reading.detectable)} beyond the band would have been seen with {POWER:.0%}"


def decidable(reading: Reading) -> bool:
    """Whether more replicas would decide an open reading, if the values stay what they are."""
    return math.isfinite(_replicas(reading))


def _replicas(reading: Reading) -> float:
    """Factor of them."""
    return max(map(lambda one: _factor(one, reading), reading.numbers), default=math.inf)


def remedy(reading: Reading) -> str:
    """How much more would decide an open reading, if the values stay what they are."""
    factor = _replicas(reading)
    if not math.isfinite(factor):
        return "The systematic error, or a value on the edge of the band, leaves it open: more replicas alone do not decide"
    if factor > MOST:
        return f"More than {MOST} times the replicas would be needed to decide, if the values stay: it lies on the edge of the band"
    return f"About {max(2, math.ceil(factor))} times the replicas would decide, if the values stay"


def _factor(number: Number, reading: Reading) -> float:
    """Of the replicas; 1 where the interval lies on one side of every edge."""
    low, high = number.interval(reading.share)
    if reading.band.outcome((low, high)) is not Outcome.UNDECIDED:
        return 1.0
    room = min(abs(number.value - edge) for edge in (reading.band.low, reading.band.high)) - number.systematic
    half = (high - low) / 2 - number.systematic
    return (half / room) ** 2 if room > 0 else math.inf


def consequence(judgement: Judgement) -> str:
    """What the verdict could have missed, or what it wants."""
    reading = judgement.deciding
    if reading is None:
        return ""
    if judgement.outcome in (Outcome.REPRODUCED, Outcome.IN_MEANING):
        return power(reading)
    return remedy(reading) if judgement.outcome is Outcome.UNDECIDED else ""
