"""The files that other services read, CODECHECK, CodeMeta and the Citation File Format, agree."""

import json
import tomllib

import pytest
from ruamel.yaml import YAML

from tests.python.conftest import ROOT
from workflow.plan import load_plan

CODECHECK = YAML(typ="safe").load((ROOT / "codecheck.yml").read_text())
CODEMETA = json.loads((ROOT / "codemeta.json").read_text())
CITATION = YAML(typ="safe").load((ROOT / "CITATION.cff").read_text())
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def full_name(person: dict) -> str:
    """Name of a person or a group in CodeMeta or the Citation File Format."""
    given = person.get("givenName") or person.get("given-names")
    family = person.get("familyName") or person.get("family-names")
    return person.get("name") or f"{given} {family}"


def names(people: list[dict]) -> list[str]:
    return [full_name(person) for person in people]


def test_the_manifest_lists_every_panel_once() -> None:
    files = [item["file"] for item in CODECHECK["manifest"]]
    assert sorted(files) == sorted(f"figures/standard/{panel}.png" for panel in load_plan("standard"))
    assert all(item["comment"] for item in CODECHECK["manifest"])


def test_the_manifest_is_a_codecheck_configuration() -> None:
    """Version 2.0: an explicit document with the entries that the authors give; the codechecker adds the others."""
    assert "\n---\n" in (ROOT / "codecheck.yml").read_text(encoding="utf-8")
    assert CODECHECK["version"] == "https://codecheck.org.uk/spec/config/2.0/"
    assert CODECHECK.keys() == {"version", "paper", "manifest"}
    assert CODECHECK["paper"].keys() == {"title", "authors", "reference"}
    assert CODECHECK["paper"]["reference"].startswith("https://")


@pytest.mark.parametrize(
    ("found", "expected"),
    [
        (CODEMETA["name"], CITATION["title"]),
        (names(CODEMETA["author"]), names(CITATION["authors"])),
        (CODEMETA["license"], f"https://spdx.org/licenses/{CITATION['license']}"),
        (CODEMETA["version"], CITATION["version"]),
        (PROJECT["version"], CITATION["version"]),
        (CODEMETA["keywords"], CITATION["keywords"]),
    ],
)
def test_the_software_is_described_alike(found: object, expected: object) -> None:
    assert found == expected


def test_the_paper_is_described_alike() -> None:
    (cited,), described, checked = (
        CITATION["references"],
        CODEMETA["referencePublication"],
        CODECHECK["paper"],
    )
    assert described["name"] == checked["title"] == cited["title"]
    assert described["identifier"] == checked["reference"] == f"https://doi.org/{cited['doi']}"
    assert names(described["author"]) == names(checked["authors"]) == names(cited["authors"])
    assert described["isPartOf"]["name"] == cited["journal"]
    assert described["datePublished"] == str(cited["year"])
