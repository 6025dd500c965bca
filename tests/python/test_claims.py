"""The table of claims, its messages, and how a claim is judged."""

import re
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest
import yaml

import tests.python.claim_truths_closed  # noqa: F401  # adds its cases
from tests.python.claim_truths import CASES, World
from tests.python.conftest import ROOT
from tests.python.known_results import Known, truth
from workflow.claims import judge
from workflow.claims.data import Data, Evidence, MissingError, combination, ratio
from workflow.claims.verdict import Number, Outcome
from workflow.configuration import ConfigurationError
from workflow.plan import data_of, load_plan
from workflow.report import numbers

CLAIMS = judge.read_claims(ROOT)
CLAIM = {"id": "C01", "literal": "-1 to 1", "intended": "-2 to 2", "alternative": ""}


def test_every_claim_is_there_once_and_has_a_judge() -> None:
    assert [claim["id"] for claim in CLAIMS] == [f"C{number:02}" for number in range(1, 36)]
    assert judge.FUNCTIONS.keys() == {claim["id"] for claim in CLAIMS}
    assert sum(len(module.CLAIMS) for module in judge.MODULES) == len(CLAIMS)


def test_rows_are_complete() -> None:
    panels = load_plan("standard")
    for claim in CLAIMS:
        assert all(claim[name] for name in ("panel", "place", "quantity", "paper", "criterion", "literal"))
        assert claim["panel"] in panels


@pytest.mark.parametrize(
    "damage",
    [
        lambda text: "",
        lambda text: text[: text.rindex("\nC35") + 1],
        lambda text: text.replace("-0.1 to 0.1", "0.1 to -0.1", 1),
        lambda text: text.replace("C02", "C99", 1),
        lambda text: text.encode().replace(b"Changes", b"Chang\xe9s", 1),
    ],
)
def test_a_damaged_table_is_reported_in_one_line(
    tmp_path: Path, damage: Callable[[str], str | bytes]
) -> None:
    path = tmp_path / judge.CLAIMS_FILE
    path.parent.mkdir()
    content = damage((ROOT / judge.CLAIMS_FILE).read_text())
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(ConfigurationError, match=r"data/claims\.csv: "):
        judge.read_claims(tmp_path)


def test_misprints_name_claims_and_numbers() -> None:
    misprints = yaml.safe_load((ROOT / "workflow/report/misprints.yaml").read_text())
    documented = (ROOT / "docs/model.md").read_text().partition("\n## 7.")[2].partition("\n## ")[0]
    assert len(misprints) == len(re.findall(r"^\| \d+ \|", documented, re.MULTILINE))
    assert {row["claim"] for row in misprints if "claim" in row} <= {claim["id"] for claim in CLAIMS}
    assert all(callable(getattr(numbers, row["number"])) for row in misprints if "number" in row)


def judged(monkeypatch: pytest.MonkeyPatch, evidence: Evidence | Exception) -> judge.Judgement:
    def claim(_: Data) -> Evidence:
        if isinstance(evidence, Exception):
            raise evidence
        return evidence

    monkeypatch.setitem(judge.FUNCTIONS, "C01", claim)
    return judge.judge(CLAIM, Data("smoke", ROOT), 0.05)


def test_what_is_missing_is_not_testable(monkeypatch: pytest.MonkeyPatch) -> None:
    judgement = judged(monkeypatch, MissingError("there are no runs"))
    assert (judgement.outcome, judgement.caveat) == (Outcome.NOT_TESTABLE, "there are no runs.")
    assert judgement.deciding is None


def test_readings_share_the_level_and_the_alternative_one_does_not_count(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    number = Number("", 1.5, 0.1)
    both = judged(monkeypatch, Evidence([number], [number]))
    assert both.outcome is Outcome.IN_MEANING
    assert both.deciding is both.intended
    assert both.literal.level == both.intended.level == 0.025
    alone = judged(monkeypatch, Evidence([number]))
    assert (alone.outcome, alone.literal.level) == (Outcome.CONTRADICTED, 0.05)


def test_damaged_results_are_missing(tmp_path: Path) -> None:
    with pytest.raises(MissingError, match="there is no panel"):
        Data("smoke", tmp_path).of("fig00")
    path = tmp_path / data_of(load_plan("smoke"), "fig05", "smoke")[0]
    path.parent.mkdir(parents=True)
    with h5py.File(path, "w"):
        pass
    with pytest.raises(MissingError, match="missing, damaged or unreadable"):
        Data("smoke", tmp_path).of("fig05")


def judged_in(
    claim: str, world: World, quality: str = "paper", converged: str = "no target"
) -> judge.Judgement:
    fills = {panel: truth(given, 1e-6) for panel, given in world.items()}
    row = CLAIMS[int(claim[1:3]) - 1]
    return judge.judge(row, Known(fills, quality, converged), 0.05)


def test_no_claim_is_judged_without_its_runs() -> None:
    for claim in CLAIMS:
        judgement = judged_in(claim["id"], {})
        assert judgement.outcome is Outcome.NOT_TESTABLE
        assert "data/paper/" in judgement.caveat


def test_what_is_not_stationary_does_not_count() -> None:
    for name in ("C23", "C24"):
        moving = {panel: {**given, "stationary": 0} for panel, given in CASES[name].world.items()}
        assert judged_in(name, moving).outcome is Outcome.NOT_TESTABLE


def test_runs_that_did_not_reach_their_target_are_reported() -> None:
    judgement = judged_in("C14", CASES["C14"].world, converged="not reached")
    assert "2 runs stopped before their target error" in judgement.caveat
    assert [path.partition(".")[0] for path in judgement.data] == [
        "data/paper/fig04a/rare",
        "data/paper/fig04b/deterministic",
    ]


def test_errors_of_ratios_and_sums() -> None:
    first, second = Number("", 4.0, 0.3, 7, 0.1), Number("", 2.0, 0.2, 9, 0.0)
    result = ratio(first, second, "r")
    assert (result.value, result.freedom) == (2, 7)
    assert result.error == pytest.approx(2 * (0.075**2 + 0.1**2) ** 0.5)
    assert result.systematic == pytest.approx(0.05)
    vanishing = ratio(Number("", 0.0, 0.3, 5, 0.1), Number("", -2.0, 0.5, 4, 0.2), "r")
    assert (vanishing.value, vanishing.error, vanishing.systematic, vanishing.freedom) == (0, 0.15, 0.05, 4)
    total = combination([first, second], [1, -2], "d", 1)
    assert (total.value, total.freedom, total.systematic) == (-1, 7, 0.1)
    assert total.error == pytest.approx(0.5)
    scaled = first.over(-2, 1)
    assert (scaled.value, scaled.error, scaled.systematic) == (-3, 0.15, 0.05)
