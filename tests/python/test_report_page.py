"""Numbers of the report, and its answer by verdict."""

from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from workflow.claims.judge import Judgement, changed, read_claims
from workflow.claims.verdict import Band, Estimate, Outcome, Verdict
from workflow.lib.fit import format_with_error
from workflow.report import typeset
from workflow.report.planned import Planned
from workflow.report.write import GALLERY, numbers_file, rendered

NUMBERS = (Estimate("first", 0.5, 0.001), Estimate("second", 0.25, 0.002))
BANDS = {"reproduced": Band(0, 1), "contradicted": Band(1, 2), "undecided": Band(0, 0.5)}


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (Estimate("", 0.6397, 0.0041, systematic=0.0234), "0.6397(41)(234)"),
        (Estimate("", 0.6397, 0.0041, systematic=0.00004), "0.6397(41)"),
        (Estimate("", 745.04, 8.21, systematic=3.14), "745.0(8.2)(3.1)"),
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
    data = Planned("smoke", ROOT)
    data.plan = {}
    page = rendered(judged(verdict), data, release=True).decode()
    assert answer in page
    assert "with β = 0.2500(20) to 0.5000(10)" in page
    claims = len(read_claims(ROOT))
    assert page.count(f'<td class="{verdict}"') == claims
    lines = numbers_file(judged(verdict)).decode().splitlines()
    assert lines[:2] == [
        "claim,kind,claim_verdict,quantity,value,error,systematic,number_verdict",
        f"C01,literal,{verdict},first,0.5,0.001,0,{verdict}",
    ]
    assert len(lines) == 1 + len(NUMBERS) * claims


def test_an_answer_with_several_quantities_labels_them() -> None:
    """Of κ by size, and of the difference in chains and in rings. Detected mistake: the largest and the
    smallest value without labels."""
    data = Planned("smoke", ROOT)
    data.plan = {}
    page = rendered(judged("contradicted"), data, release=True).decode()
    assert page.count("(first: 0.5000(10); second: 0.2500(20))") == 2


def test_an_undecided_answer_says_so() -> None:
    data = Planned("smoke", ROOT)
    data.plan = {}
    page = rendered(judged("undecided"), data, release=True).decode()
    assert page.count("Undecided at quality smoke: ") == 4
    assert "at quality paper:" not in page


def test_the_verdict_of_the_release_beside_an_undecided_one(tmp_path: Path) -> None:
    """Detected mistakes: the verdict of the number in place of that of the claim; rows that are decided
    here have it, too."""
    (tmp_path / GALLERY).mkdir(parents=True)
    (tmp_path / GALLERY / "numbers.csv").write_bytes(numbers_file(judged("contradicted")))
    data = Planned("smoke", tmp_path)
    data.plan = {}
    page = rendered(judged("undecided"), data, release=False).decode()
    assert page.count("At quality paper: contradicted, 0.2500(20) to 0.5000(10).") == 4
    assert page.count("(at quality paper: contradicted)") == len(read_claims(ROOT))
    assert "at quality paper:" not in rendered(judged("reproduced"), data, release=False).decode()


def test_verdicts_with_other_bands() -> None:
    """Detected mistakes: the factor is inverted; verdicts that stay are listed."""
    row = {"numbers": "C01", "kind": "literal"}
    near, far = (
        Judgement(row, Verdict(Band(-1, 1), (Estimate("", value, 0.01),), 0.05)) for value in (0.7, 0.1)
    )
    assert changed([near, far], 0.5) == [(near, Outcome.CONTRADICTED)]
    assert changed([near, far], 2) == []
