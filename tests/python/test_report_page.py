"""Numbers of the report, and its answer by verdict."""

import pytest

from tests.python.conftest import ROOT
from workflow.claims.data import Data
from workflow.claims.judge import Judgement, read_claims
from workflow.claims.verdict import Band, Estimate, Verdict
from workflow.lib.fit import format_with_error
from workflow.report import typeset
from workflow.report.write import numbers_file, rendered

NUMBERS = (Estimate("first", 0.5, 0.001), Estimate("second", 0.25, 0.002))
BANDS = {"reproduced": Band(0, 1), "contradicted": Band(1, 2), "undecided": Band(0, 0.5)}


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (Estimate("", 0.6397, 0.0041, systematic=0.0234), f"{format_with_error(0.6397, 0.0041)} ± 0.023"),
        (Estimate("", -0.000861, 0.0000168), f"{format_with_error(-8.61, 0.168)}·10⁻⁴"),
        (Estimate("", 0.007544, 0.0, systematic=4.61e-12), "0.007544 ± 4.6·10⁻¹²"),
        (Estimate("", 4.4e-16, 0.0, systematic=1.5e-13), "0 to rounding ± 1.5·10⁻¹³"),
    ],
)
def test_numbers(number: Estimate, text: str) -> None:
    assert typeset.value(number) == text


def judged(verdict: str) -> list[Judgement]:
    return [Judgement(row, Verdict(BANDS[verdict], NUMBERS, 0.05)) for row in read_claims(ROOT)]


@pytest.mark.parametrize(
    ("verdict", "answer"),
    [
        ("reproduced", "The title is right: heat is superdiffusive at all times reached."),
        ("contradicted", "The title is wrong"),
    ],
)
def test_the_answer_follows_from_verdicts_and_has_their_numbers(verdict: str, answer: str) -> None:
    data = Data("smoke", ROOT)
    data.plan = {}
    page = rendered(judged(verdict), data, release=True).decode()
    assert answer in page
    assert "with β = 0.2500(20) to 0.5000(10)" in page
    claims = len(read_claims(ROOT))
    assert page.count(f'class="{verdict}"') == claims
    lines = numbers_file(judged(verdict)).decode().splitlines()
    assert lines[:2] == [
        "claim,kind,verdict,quantity,value,error,systematic",
        f"C01 C02,literal,{verdict},first,0.5,0.001,0",
    ]
    assert len(lines) == 1 + len(NUMBERS) * claims


def test_an_undecided_answer_says_so() -> None:
    data = Data("smoke", ROOT)
    data.plan = {}
    assert rendered(judged("undecided"), data, release=True).count(b": undecided at quality smoke.") == 4
