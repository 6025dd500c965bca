"""The bill of materials is valid SPDX 2.3 as far as its rules reach without a library, and complete."""

import json
import re
from datetime import date

import pytest

from tests.python.conftest import ROOT
from workflow.provenance import bill_of_materials as bill

LIBRARIES = ["Eigen 3.4.0, GSL 2.7.1", "GSL 2.7.1"]  # of two builds


@pytest.fixture
def document() -> dict:
    return json.loads(bill.bill_of_materials("lorentz-gas-paper", date(2026, 1, 2), LIBRARIES))


def test_it_has_what_spdx_asks_for(document: dict) -> None:
    assert document["spdxVersion"] == "SPDX-2.3"
    assert document["dataLicense"] == "CC0-1.0"
    assert document["creationInfo"]["created"] == "2026-01-02T00:00:00Z"
    identifiers = [package["SPDXID"] for package in document["packages"]]
    assert len({*identifiers}) == len(identifiers)
    assert all(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", one) for one in identifiers)
    related = {(one["relationshipType"], one["relatedSpdxElement"]) for one in document["relationships"]}
    assert related == {
        ("DESCRIBES", bill.PROJECT),
        *(("DEPENDS_ON", one) for one in identifiers if one != bill.PROJECT),
    }


def test_every_locked_package_and_linked_library_is_there_once(document: dict) -> None:
    lock = (ROOT / "requirements.lock").read_text()
    locked = {
        tuple(line.split(" ")[0].split("==")) for line in lock.splitlines() if re.match(r"[\w.-]+==", line)
    }
    listed = [(package["name"], package["versionInfo"]) for package in document["packages"][1:]]
    assert sorted(listed) == sorted({*locked, ("Eigen", "3.4.0"), ("GSL", "2.7.1")})


def test_licences_are_those_that_packages_state(document: dict) -> None:
    stated = {package["name"]: package["licenseDeclared"] for package in document["packages"]}
    assert stated["lorentz-gas"] == "MIT"
    assert stated["numpy"].startswith("BSD-3-Clause")
    assert stated["GSL"] == "GPL-3.0-or-later"
    assert bill.licence_of("a package that is not installed") == bill.UNKNOWN


def test_a_library_whose_licence_is_unknown_is_refused() -> None:
    with pytest.raises(KeyError, match="glibc"):
        bill.bill_of_materials("x", date(2026, 1, 2), ["glibc 2.36"])
