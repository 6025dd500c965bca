"""Numbers and verdicts of the front page, and links of all pages."""

import csv
import re
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from workflow.lib.caption import BATHS
from workflow.physics.paper import PAPER
from workflow.pipeline.described import options_of_programs

with (ROOT / "docs/gallery/numbers.csv").open(newline="") as file:
    RELEASE = [*csv.DictReader(file)]


def test_front_page_has_the_numbers_of_the_release() -> None:
    """A number with its errors in brackets, as 0.299(8)(52), is one of the report, rounded. Detected
    mistake: a systematic error that is not negligible is missing."""
    text = (ROOT / "README.md").read_text().replace("−", "-")
    found = re.findall(r"(-?\d+\.(\d+))\((\d+)\)(?:\((\d+)\))?", text)
    assert found
    for value, decimals, *errors in found:
        digits = len(decimals)
        assert any(
            f"{float(line['value']):.{digits}f}" == value
            and [round(float(line[kind]) * 10**digits) for kind in ("error", "systematic")]
            == [int(error or 0) for error in errors]
            for line in RELEASE
        ), (value, errors)


def test_front_page_has_the_verdicts_of_the_release() -> None:
    verdicts = [*{(line["claim"], line["kind"]): line["claim_verdict"] for line in RELEASE}.values()]
    held, failed, undecided = map(verdicts.count, ("reproduced", "contradicted", "undecided"))
    count = f"{held} of {len(verdicts)} readings hold, {failed} do not, {undecided} (?:is|are) open"
    text = (ROOT / "README.md").read_text()
    assert re.search(count, text)
    assert "@" not in text  # a number that is not filled in


def test_the_version_is_that_of_the_citation() -> None:
    of_project, of_citation = (
        re.search(r"^version(?: =|:) \"?([\d.]+)", (ROOT / name).read_text(), re.MULTILINE)
        for name in ("pyproject.toml", "CITATION.cff")
    )
    assert of_project
    assert of_citation
    assert of_project[1] == of_citation[1]


def test_the_papers_baths_are_the_defaults_of_the_programs() -> None:
    options = options_of_programs()["conductivity"]
    defaults = [options[name.replace("_", "-")]["default"] for name in BATHS]
    assert defaults == pytest.approx([float(PAPER["fig02"][name][0]) for name in BATHS], rel=1e-5)


@pytest.mark.parametrize(
    "page", [*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md")], ids=lambda page: page.name
)
def test_every_relative_link_leads_to_a_file(page: Path) -> None:
    text = re.sub(r"```.*?```", "", page.read_text("utf-8"), flags=re.DOTALL)
    links = re.findall(r"\]\(([^)#\s]+)", text)
    assert [link for link in links if "://" not in link and not (page.parent / link).exists()] == []
