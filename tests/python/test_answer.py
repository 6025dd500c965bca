"""The first sentences of the report follow from the judgements."""

from collections.abc import Sequence

from workflow.claims.growth import STRONG
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


def test_growth_is_told_if_every_spacing_shows_it() -> None:
    def heat(value: float) -> str:
        last = [
            Number(f"{STRONG}, spacing {name}", number, 0.01)
            for name, number in (("1/N", 0.2), ("0.1", value))
        ]
        return told(judgement("C24", substance=reading(last[0]), other=reading(last[1])))[2].text

    assert "κ grows with N up to the longest chains" in heat(0.2)
    assert "κ grows with N up to the longest chains" not in heat(0.02)  # two errors above 0


def test_heat_tells_what_the_data_allow() -> None:
    fixed = reading(Number(f"{STRONG}, spacing 0.1", 0.2, 0.01))
    numbers = told(judgement("C24", other=fixed, remark="a finite limit is rejected"))[2].numbers
    assert [*numbers[-2:]] == [
        f"{STRONG}, spacing 0.1: 0.200(10)",
        "a finite limit is rejected",
    ]
    nothing = Judgement(
        {"id": "C24", "quantity": "q", "paper": "p"}, Outcome.NOT_TESTABLE, caveat="Too few sizes."
    )
    assert told(nothing)[2].numbers[1:] == ["Too few sizes"]


def test_the_kinetic_equation_is_told_for_both_couplings() -> None:
    far = reading(Number("γ = N, F_30", 0.2, 0.001))
    *_, (text, numbers, _) = told(judgement("C12", other=far))
    assert "that finite chains tend to it is reproduced" in text
    assert text.endswith("That at γ = N, too, a chain is within 1 % of it is contradicted.")
    assert numbers[-1] == "γ = N, F_30: 0.2000(10)"


def test_what_spreads_is_told_by_verdicts() -> None:
    plain = told()[3].text
    assert "that this is superdiffusion is reproduced; that only energy is conserved is reproduced." in plain
    without_drift = judgement("C20", Outcome.CONTRADICTED, substance=reading(Number("α", 0.9, 0.001)))
    found = told(without_drift, judgement("C22", Outcome.CONTRADICTED))[3].text
    assert "that this is superdiffusion is contradicted, as what is seen is the drift" in found
    assert found.endswith("that only energy is conserved is contradicted, as total momentum is too.")


def test_diffusion_is_told_with_the_relaxed_chain_first() -> None:
    other = reading(Number("t_r = 10", 0.94, 0.003), Number("t_r = 1000", 0.995, 0.003))
    *_, without_drift = told(judgement("C18", other=other))[3].numbers
    assert without_drift == "t_r = 1000: 0.9950(30); before the chain has relaxed 0.9400(30)"
