"""Numbers, verdicts and links of the papers at the top. mkdocs checks the links of docs."""

import csv
import re

import pytest

from tests.python.conftest import ROOT

with (ROOT / "docs/gallery/numbers.csv").open(newline="") as file:
    RELEASE = [*csv.DictReader(file)]


def test_front_page_has_the_numbers_of_the_release() -> None:
    """A number with its error in brackets, as 1.26(2), is one of the report, rounded."""
    text = (ROOT / "README.md").read_text().replace("−", "-")
    found = re.findall(r"(-?\d+\.(\d+))\((\d+)\)", text)
    assert found
    for value, decimals, error in found:
        digits = len(decimals)
        assert any(
            f"{float(line['value']):.{digits}f}" == value
            and round(float(line["error"]) * 10**digits) == int(error)
            for line in RELEASE
        ), f"{value}({error})"


def test_front_page_has_the_verdicts_of_the_release() -> None:
    verdicts = {(line["claim"], line["kind"]): line["verdict"] for line in RELEASE}
    literal, intended = (
        [verdict for (_, of), verdict in verdicts.items() if of == kind] for kind in ("literal", "intended")
    )
    sentence = re.search(
        rf"Of {len(literal)} statements, taken literally, {literal.count('reproduced')} hold, "
        rf"{literal.count('undecided')} are undecided, {literal.count('contradicted')} are contradicted \((.*?)\); of "
        rf"{len(intended)} intended meanings that differ, {intended.count('reproduced')} hold, "
        rf"{intended.count('undecided')} are undecided, {intended.count('contradicted')} are contradicted \((.*?)\)\.",
        " ".join((ROOT / "README.md").read_text().split()),
    )
    assert sentence
    for kind, part in zip(("literal", "intended"), sentence.groups(), strict=True):
        refuted = (
            line["claim"] for line in RELEASE if (line["kind"], line["verdict"]) == (kind, "contradicted")
        )
        assert {*re.findall(r"C\d\d", part)} == {number for claim in refuted for number in claim.split()}


def linked(name: str) -> list[str]:
    return re.findall(r"\]\(([^)#\s]+)", (ROOT / name).read_text("utf-8"))


@pytest.mark.parametrize("name", ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"])
def test_every_relative_link_leads_to_a_file(name: str) -> None:
    assert [link for link in linked(name) if "://" not in link and not (ROOT / link).exists()] == []
