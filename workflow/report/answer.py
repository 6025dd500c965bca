"""The answer in five sentences, each with the numbers that it rests on."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from workflow.claims.judge import Judgement
from workflow.claims.verdict import FAMILY_LEVEL, Band, Number, Outcome, Reading
from workflow.report import words

Claims = Mapping[str, Judgement]  # by id
NOT_MEASURED = "not measured"


class Sentence(NamedTuple):
    """panels: those that show it."""

    text: str
    numbers: Sequence[str] = ()
    panels: Sequence[str] = ()


def answer(judgements: Sequence[Judgement], quality: str) -> list[Sentence]:
    claims = {one.claim["id"]: one for one in judgements}
    return [
        verdicts(judgements, quality),
        contradictions(judgements),
        heat(claims),
        particles(claims),
        kinetic(claims),
    ]


def verdicts(judgements: Sequence[Judgement], quality: str) -> Sentence:
    counts = Counter(one.outcome for one in judgements)
    remark = {Outcome.UNDECIDED: _left_open(judgements)}
    listed = ", ".join(f"{counts[one]} {one.value}{remark.get(one, '')}" for one in Outcome)
    return Sentence(
        f"Of {len(judgements)} claims, at quality {quality}: {listed}. The probability that noise makes any verdict wrong is at "
        f"most {FAMILY_LEVEL:.0%}, given the acceptance bands in data/claims.csv: an interval is "
        "about four standard errors to either side."
    )


def _left_open(judgements: Iterable[Judgement]) -> str:
    """How many of the open verdicts more replicas would not decide."""
    readings = [one.deciding for one in judgements if one.outcome is Outcome.UNDECIDED]
    bounded = sum(one is not None and not words.decidable(one) for one in readings)
    return f" ({bounded} of these by systematic errors, not by noise)" if bounded else ""


def contradictions(judgements: Iterable[Judgement]) -> Sentence:
    against = [one.claim for one in judgements if one.outcome is Outcome.CONTRADICTED]
    listed = [f"{one['quantity']} ({one['id']}; the paper: {one['paper']})" for one in against]
    text = f"Contradicted: {'; '.join(listed)}." if listed else "At this quality no claim is contradicted."
    return Sentence(text)


def heat(claims: Claims) -> Sentence:
    rare, deterministic = claims["C23"], claims["C24"]
    return Sentence(
        f"Heat: κ ∼ N at γ = 1 is {rare.outcome.value}. At γ = N, where every scatterer scatters, κ ∼ N^(1/3) is "
        f"{deterministic.outcome.value} at the paper's spacing 1/N (C24), where size and density change "
        f"together{_through(deterministic)}.{_at_fixed_density(deterministic)}",
        [_worst(rare.deciding), *_exponents(deterministic)],
        ["fig08", "ext09", "ext02", "ext11", "ext12", "ext13"],
    )


def _through(judgement: Judgement) -> str:
    """Whether the exponent is above the band in smaller and below it in larger chains."""
    readings = [one for one in (judgement.literal,) if one]
    intervals = [(number.interval(one.share), one.band) for one in readings for number in one.numbers]
    above = any(low > band.high for (low, _), band in intervals)
    below = any(high < band.low for (_, high), band in intervals)
    return ": the exponent falls through 1/3" if above and below else ""


def _at_fixed_density(judgement: Judgement) -> str:
    fixed = judgement.intended
    return f" At fixed density it is {fixed.outcome.value}." if fixed else ""


def _exponents(judgement: Judgement) -> list[str]:
    """The numbers of all readings with the acceptance band, or why there are none."""
    readings = [one for one in (judgement.literal, judgement.intended, judgement.alternative) if one]
    return [_with_band(number, one.band) for one in readings for number in one.numbers] or [
        judgement.caveat.rstrip(".")
    ]


def particles(claims: Claims) -> Sentence:
    spreading, superdiffusive, conserved = claims["C18"], claims["C20"], claims["C22"]
    drift = (
        ", as what is seen is the drift of the particles with a random total momentum: without it they do not spread faster "
        "than by diffusion in the paper's ring of few cells"
        if superdiffusive.intended and superdiffusive.intended.outcome is Outcome.CONTRADICTED
        else ""
    )
    total = ", as total momentum is too" if conserved.outcome is Outcome.CONTRADICTED else ""
    return Sentence(
        f"Particles: that ⟨x²⟩ of a tagged particle grows with the paper's exponent over its times is {spreading.outcome.value}; that this "
        f"is superdiffusion is {superdiffusive.outcome.value}{drift}; that only energy is conserved is {conserved.outcome.value}{total}.",
        [_worst(spreading.literal), _relaxed(spreading.alternative)],
        ["fig07", "ext01"],
    )


def _relaxed(reading: Reading | None) -> str:
    """The exponents without drift that are nearest to diffusion and farthest from it, where noise does not decide which these are."""
    if not reading or reading.outcome is not Outcome.CONTRADICTED:
        return _worst(reading)
    *_, last = numbers = sorted(reading.numbers, key=lambda one: one.value)
    return f"{words.told(last)}; before the chain has relaxed {words.value(numbers[0])} (superdiffusion: {words.acceptance(reading.band)})"


def kinetic(claims: Claims) -> Sentence:
    limit, small = claims["C12"], claims["C10"]
    relative, deterministic = (
        one.alternative.outcome.value if one.alternative else NOT_MEASURED for one in (small, limit)
    )
    return Sentence(
        "Kinetic equation: at γ = 1, where a particle scatters about once on its way, that finite chains tend to it is "
        f"{limit.outcome.value}; that they differ by less than 0.1 % is {small.outcome.value} if F integrates to one, as is printed, and "
        f"{relative} relative to the largest F. Alternative reading, at γ = N: that a chain is within 1 % of it is {deterministic}.",
        [_worst(one) for one in (limit.deciding, small.deciding, small.alternative, limit.alternative)],
        ["fig03_inset", "fig04a", "fig04b"],
    )


def _worst(reading: Reading | None) -> str:
    """The number that decides."""
    return _with_band(reading.worst, reading.band) if reading else NOT_MEASURED


def _with_band(number: Number, band: Band) -> str:
    return f"{words.told(number)} (acceptance band {words.acceptance(band)})"
