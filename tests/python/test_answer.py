"""The first sentences of the report follow from the judgements."""

from collections.abc import Sequence

from workflow.claims.judge import Judgement
from workflow.claims.verdict import Band, Number, Outcome, Reading
from workflow.report.answer import Sentence, answer

LEVEL = 0.001


def reading(*numbers: Number, low: float = -0.1, high: float = 0.1) -> Reading:
    return Reading(Band(low, high), numbers, LEVEL)


def judgement(
    claim: str, outcome: Outcome = Outcome.REPRODUCED, remark: str = "", **readings: Reading
) -> Judgement:
    given = {"literal": reading(Number("found", 0.0, 0.001))} | readings
    return Judgement({"id": claim, "quantity": "q", "paper": "p"}, outcome, remark=remark, **given)


def told(*others: Judgement) -> Sequence[Sentence]:
    """Answer with what is given in place of claims that are reproduced."""
    given = {one.claim["id"]: one for one in others}
    ids = sorted({"C10", "C12", "C18", "C20", "C22", "C23", "C24", *given})
    return answer([given.get(claim) or judgement(claim) for claim in ids], "paper")


def test_open_verdicts_are_told_by_what_leaves_them_open() -> None:
    noisy = judgement("C01", Outcome.UNDECIDED, literal=reading(Number("a", 0.05, 0.1)))
    bounded = judgement("C02", Outcome.UNDECIDED, literal=reading(Number("b", 0.05, 0.001, systematic=0.2)))
    first = told(noisy, bounded)[0].text
    assert "2 undecided at this precision (1 of these by systematic errors, not by noise)" in first
    assert "by systematic errors" not in told(noisy)[0].text


def kappa(value: float, name: str = "b") -> Number:
    return Number(name, value, 0.01)


def heat(deterministic: Judgement) -> Sentence:
    return told(deterministic)[2]


def test_growth_at_fixed_density_is_told_if_every_spacing_shows_it() -> None:
    def at_fixed_density(value: float, remark: str = "") -> str:
        other = reading(kappa(0.2), kappa(value))
        return heat(judgement("C24", alternative=other, remark=remark)).text.partition(" At fixed density ")[
            2
        ]

    assert at_fixed_density(0.2) == (
        "it is contradicted: κ grows up to the longest chains, as is expected of chains that conserve momentum."
    )
    assert at_fixed_density(0.2, "how laws fit").endswith(
        "and a limit that is approached as N^(-1/3) is rejected."
    )
    assert at_fixed_density(0.02, "how laws fit") == "it is contradicted."  # two errors above 0


def test_an_exponent_that_falls_through_the_band_is_told() -> None:
    def falls(*last: float) -> bool:
        numbers = judgement(
            "C24", literal=reading(kappa(0.5), kappa(0.0)), intended=reading(*map(kappa, last))
        )
        return "the exponent falls through 1/3" in heat(numbers).text

    assert falls(-0.5)
    assert not falls(0.0)


def test_numbers_have_their_acceptance_band_or_the_reason_why_there_are_none() -> None:
    given = judgement("C24", alternative=reading(kappa(0.2)), remark="how laws fit")
    assert heat(given).numbers[-2:] == ["b: 0.200(10) (acceptance band −0.1 to 0.1)", "how laws fit"]
    nothing = Judgement(
        {"id": "C24", "quantity": "q", "paper": "p"}, Outcome.NOT_TESTABLE, caveat="Too few sizes."
    )
    assert heat(nothing).numbers[1:] == ["Too few sizes"]


def test_the_kinetic_equation_is_told_for_both_couplings() -> None:
    far = reading(Number("γ = N, F_30", 0.2, 0.001))
    *_, (text, numbers, _) = told(judgement("C12", alternative=far))
    assert "that finite chains tend to it is reproduced" in text
    assert text.endswith("at γ = N: that a chain is within 1 % of it is contradicted.")
    assert numbers[-1] == "γ = N, F_30: 0.2000(10) (acceptance band −0.1 to 0.1)"


def test_what_spreads_is_told_by_verdicts() -> None:
    plain = told()[3].text
    assert "that this is superdiffusion is reproduced; that only energy is conserved is reproduced." in plain
    without_drift = judgement("C20", Outcome.CONTRADICTED, intended=reading(Number("α", 0.9, 0.001)))
    found = told(without_drift, judgement("C22", Outcome.CONTRADICTED))[3].text
    assert "that this is superdiffusion is contradicted, as what is seen is the drift" in found
    assert found.endswith("that only energy is conserved is contradicted, as total momentum is too.")


def test_diffusion_is_told_with_the_relaxed_chain_first() -> None:
    other = reading(Number("t_r = 10", 0.94, 0.003), Number("t_r = 1000", 0.995, 0.003))
    *_, without_drift = told(judgement("C18", alternative=other))[3].numbers
    assert without_drift == (
        "t_r = 1000: 0.9950(30); before the chain has relaxed 0.9400(30) (superdiffusion: −0.1 to 0.1)"
    )
