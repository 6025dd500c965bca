"""Numbers of the report, and its answer by verdict."""

import re
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from workflow.lib.load import FormatError
from workflow.lib.text import format_with_error
from workflow.pipeline.plan import Plan
from workflow.study import typeset
from workflow.study.judge import Judgement, changed, read_claims
from workflow.study.report import inches, numbers_file, rendered
from workflow.study.verdict import Band, Estimate, Outcome, Verdict

NUMBERS = (Estimate("first", 0.5, 0.001), Estimate("second", 0.25, 0.002))
WITHOUT_PANELS = Plan("smoke")
WITHOUT_PANELS.panels = {}
VERDICTS = {
    "reproduced": Verdict(Band(0, 1), NUMBERS, 0.05),
    "nearly reproduced": Verdict(Band(0, 0.3), NUMBERS, 0.05, Band(0, 1)),
    "contradicted": Verdict(Band(1, 2), NUMBERS, 0.05),
    "undecided": Verdict(Band(0, 0.5), NUMBERS, 0.05),
}


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
def test_typeset_numbers_have_both_errors(number: Estimate, text: str) -> None:
    assert typeset.value(number) == text


def judged(verdict: str) -> list[Judgement]:
    return [Judgement(row, VERDICTS[verdict]) for row in read_claims(ROOT)]


@pytest.mark.parametrize("verdict", VERDICTS)
def test_the_answer_follows_from_verdicts_and_has_their_numbers(verdict: str, tmp_path: Path) -> None:
    page = rendered(judged(verdict), WITHOUT_PANELS, tmp_path, release=False).decode()
    style = VERDICTS[verdict].outcome.name.lower()
    answer = page[page.index('<ul id="answer">') :].partition("</ul>")[0]
    assert answer.count(f'<span class="{style}">{verdict}</span>') == 6
    claims = len(read_claims(ROOT))
    assert page.count(f'<td class="{style}"') == claims
    lines = numbers_file(judged(verdict)).decode().splitlines()
    assert lines[:2] == [
        "claim,kind,claim_verdict,quantity,value,error,systematic,number_verdict",
        f"C01,as printed,{verdict},first,0.5,0.001,0,{VERDICTS[verdict].outcome_of(NUMBERS[0])}",
    ]
    assert len(lines) == 1 + len(NUMBERS) * claims


ROWS = {(row["number"], row["kind"]): row for row in read_claims(ROOT)}


def test_the_gallery_has_the_verdict_of_every_statement_and_their_count() -> None:
    """Detected mistakes: a row is missing; the verdict of another row; the count of another verdict."""
    verdicts = {
        ("C03", "as printed"): "contradicted",
        ("C02", "as printed"): "undecided",
        ("C09", "as printed"): "undecided",
        ("C23", "as meant"): "contradicted",
        ("C29", "as printed"): "undecided",
        ("C05", "as printed"): "nearly reproduced",
    }
    judgements = [Judgement(row, VERDICTS[verdicts.get(key, "reproduced")]) for key, row in ROWS.items()]
    page = rendered(judgements, WITHOUT_PANELS, ROOT, release=True).decode()
    signs = dict(re.findall(r'^\|<a id="([\w-]+)">.*\|(.)\|$', page, re.MULTILINE))
    assert len(signs) == len(ROWS)
    others = {"c02": "?", "c03": "✗", "c05": "≈", "c09": "?", "c23-as-meant": "✗", "c29": "?"}
    assert {row: sign for row, sign in signs.items() if sign != "✓"} == others
    printed, meant = ([kind for _, kind in ROWS].count(kind) for kind in ("as printed", "as meant"))
    counts = f"{printed} statements as printed: {printed - 5} reproduced (✓), 1 nearly reproduced (≈), "
    counts += f"1 contradicted (✗) and 3 undecided (?). {meant} of them as probably meant: "
    assert f"{counts}{meant - 1} reproduced (✓) and 1 contradicted (✗)." in page
    assert all(ROWS[key]["caveat"] in page for key in (("C23", "as meant"), ("C32", "as printed")))


def test_pictures_have_one_scale() -> None:
    assert inches(b'<svg width="244.8pt" height="489.6pt" viewBox="0 0 1 1">') == pytest.approx(3.4)
    with pytest.raises(FormatError, match="states no size"):
        inches(b'<svg width="100%">')


def test_verdicts_with_other_bands() -> None:
    """Detected mistakes: the factor is inverted; verdicts that stay are listed."""
    row = {"number": "C01", "kind": "as printed"}
    near, far = (
        Judgement(row, Verdict(Band(-1, 1), (Estimate("", value, 0.01),), 0.05)) for value in (0.7, 0.1)
    )
    assert changed([near, far], 0.5) == [(near, Outcome.CONTRADICTED)]
    assert changed([near, far], 2) == []
