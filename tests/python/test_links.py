"""Relative links of the papers at the top; mkdocs checks those of docs."""

import re

import pytest

from tests.python.conftest import ROOT


def linked(name: str) -> list[str]:
    return re.findall(r"\]\(([^)#\s]+)", (ROOT / name).read_text("utf-8"))


@pytest.mark.parametrize("name", ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"])
def test_every_relative_link_leads_to_a_file(name: str) -> None:
    assert [link for link in linked(name) if "://" not in link and not (ROOT / link).exists()] == []


def test_readme_links_every_page() -> None:
    pages = {path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").glob("*.md")}
    assert pages <= {*linked("README.md")}
