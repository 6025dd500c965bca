"""Links of all pages, version and defaults."""

import re
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from tests.python.described import options_of_programs
from workflow.physics.paper import BATHS, PAPER


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
