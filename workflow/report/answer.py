"""The answer in five sentences, each with the numbers that it rests on."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from workflow.claims.growth import STRONG
from workflow.claims.judge import Judgement
from workflow.claims.verdict import FAMILY_LEVEL, Outcome, Reading
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
        f"most {FAMILY_LEVEL:.0%}, given the bands that this report lets each claim admit."
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
    fixed = deterministic.other
    at_fixed = f", and {fixed.outcome.value} at fixed density" if fixed else ""
    at_fixed_density = [*map(words.told, fixed.numbers), deterministic.remark] if fixed else []
    return Sentence(
        f"Heat: κ ∼ N at γ = 1 is {rare.outcome.value}. At γ = N, where every scatterer scatters, {_growth(deterministic)}κ ∼ N^(1/3) is "
        f"{deterministic.outcome.value} at the paper's spacing 1/N, where size and density change together{at_fixed}.",
        [
            _worst(rare.deciding),
            *_readings(deterministic),
            *filter(None, at_fixed_density),
        ],
        ["fig08", "ext09", "ext02", "ext11", "ext12"],
    )


def _growth(judgement: Judgement) -> str:
    """Whether kappa still grows between the largest sizes of ext09 at every spacing."""
    readings = [one for one in (judgement.substance, judgement.other) if one]
    lowest = [
        one.interval(reading.share)[0]
        for reading in readings
        for one in reading.numbers
        if one.label.startswith(STRONG)
    ]
    if not lowest or min(lowest) <= 0:
        return ""
    return "κ grows with N up to the longest chains at every spacing, as is expected of chains that conserve momentum; "


def particles(claims: Claims) -> Sentence:
    spreading, superdiffusive, conserved = claims["C18"], claims["C20"], claims["C22"]
    drift = (
        ", as what is seen is the drift of the particles with a random total momentum: without it they do not spread faster "
        "than by diffusion in the paper's ring of few cells"
        if superdiffusive.substance and superdiffusive.substance.outcome is Outcome.CONTRADICTED
        else ""
    )
    total = ", as total momentum is too" if conserved.outcome is Outcome.CONTRADICTED else ""
    return Sentence(
        f"Particles: that ⟨x²⟩ of a tagged particle grows with the paper's exponent over its times is {spreading.outcome.value}; that this "
        f"is superdiffusion is {superdiffusive.outcome.value}{drift}; that only energy is conserved is {conserved.outcome.value}{total}.",
        [_worst(spreading.literal), _relaxed(spreading.other)],
        ["fig07", "ext01"],
    )


def _relaxed(reading: Reading | None) -> str:
    """The exponents without drift that are nearest to diffusion and farthest from it, where noise does not decide which these are."""
    if not reading or reading.outcome is not Outcome.CONTRADICTED:
        return _worst(reading)
    *_, last = numbers = sorted(reading.numbers, key=lambda one: one.value)
    return f"{words.told(last)}; before the chain has relaxed {words.value(numbers[0])}"


def kinetic(claims: Claims) -> Sentence:
    limit, small = claims["C12"], claims["C10"]
    relative, deterministic = (
        one.other.outcome.value if one.other else NOT_MEASURED for one in (small, limit)
    )
    return Sentence(
        "Kinetic equation: at γ = 1, where a particle scatters about once on its way, that finite chains tend to it is "
        f"{limit.outcome.value}, and that they differ by less than 0.1 % is {small.outcome.value} in the printed normalisation, and "
        f"relative to the largest F {relative}. That at γ = N, too, a chain is within 1 % of it is {deterministic}.",
        [_worst(one) for one in (limit.deciding, small.deciding, small.other, limit.other)],
        ["fig03_inset", "fig04a", "fig04b"],
    )


def _worst(reading: Reading | None) -> str:
    """The number that decides."""
    return words.told(reading.worst) if reading else NOT_MEASURED


def _readings(judgement: Judgement) -> list[str]:
    """The numbers of both readings, or why there are none."""
    readings = [one for one in (judgement.literal, judgement.substance) if one]
    found = [words.told(number) for reading in readings for number in reading.numbers]
    return found or [judgement.caveat.rstrip(".")]
