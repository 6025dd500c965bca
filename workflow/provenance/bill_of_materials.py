"""Bill of materials of a crate, as SPDX 2.3 has it: this project, the locked Python packages, the linked libraries.

The hashes of the packages' files stand in the lock, which is in the crate; here are versions, licences and names by which
others find them.
"""

import json
import re
from collections.abc import Iterable
from datetime import date
from importlib.metadata import PackageNotFoundError, metadata
from typing import Any

from workflow.lib.citation import citation
from workflow.lib.parents import PACKAGES
from workflow.provenance.repository import ROOT

NAME = "bill-of-materials.spdx.json"
UNKNOWN = "NOASSERTION"
DOCUMENT, PROJECT = "SPDXRef-DOCUMENT", "SPDXRef-Package-lorentz-gas"
LOCKED = re.compile(r"^([\w.-]+)==([^\s;\\]+)", re.MULTILINE)
# What packages that state no SPDX expression say of their licence in their classifiers, where that is one licence.
CLASSIFIERS = {
    "Apache Software License": "Apache-2.0",
    "ISC License (ISCL)": "ISC",
    "MIT License": "MIT",
    "Mozilla Public License 2.0 (MPL 2.0)": "MPL-2.0",
    "Python Software Foundation License": "PSF-2.0",
}
IDENTIFIERS = {*CLASSIFIERS.values(), "BSD-2-Clause", "BSD-3-Clause"}
LIBRARIES = {  # linked or included
    "CLI11": "BSD-3-Clause",
    "Eigen": "MPL-2.0",
    "GSL": "GPL-3.0-or-later",
    "HDF5": "BSD-3-Clause",
    "SLEEF": "BSL-1.0",
    "fmt": "MIT",
}


def bill_of_materials(name: str, day: date, libraries: Iterable[str]) -> str:
    """libraries: of each build, as `GSL 2.7.1, HDF5 1.10.8`. Raises KeyError for one whose licence nobody has written here."""
    cited = citation(ROOT)
    project = _package("lorentz-gas", cited["version"], cited["license"]) | {"SPDXID": PROJECT}
    locked = LOCKED.findall((ROOT / PACKAGES).read_text())
    linked = sorted({tuple(one.rsplit(" ", 1)) for build in libraries for one in build.split(", ")})
    packages = [
        *(_package(one, version, licence_of(one), f"pkg:pypi/{one}@{version}") for one, version in locked),
        *(_package(one, version, LIBRARIES[one]) for one, version in linked),
    ]
    used = [
        {"spdxElementId": PROJECT, "relationshipType": "DEPENDS_ON", "relatedSpdxElement": one["SPDXID"]}
        for one in packages
    ]
    described = {"spdxElementId": DOCUMENT, "relationshipType": "DESCRIBES", "relatedSpdxElement": PROJECT}
    document = {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": DOCUMENT,
        "name": name,
        "documentNamespace": f"https://spdx.org/spdxdocs/{name}-{cited['version']}-{day}",
        "creationInfo": {"created": f"{day}T00:00:00Z", "creators": ["Tool: lorentz-gas make crate"]},
        "packages": [project, *packages],
        "relationships": [described, *used],
    }
    return json.dumps(document, indent=1) + "\n"


def licence_of(package: str) -> str:
    """As the installed package states it: an SPDX expression, in the field of today or of before, or a classifier."""
    try:
        stated = metadata(package)
    except PackageNotFoundError:  # on this system it is not needed
        return UNKNOWN
    for text in (*stated.get_all("License-Expression", []), *stated.get_all("License", [])):
        if text in IDENTIFIERS or "License-Expression" in stated:
            return str(text)
    classifiers = (
        one.rpartition(" :: ")[2] for one in stated.get_all("Classifier", []) if one.startswith("License")
    )
    return " AND ".join(sorted({CLASSIFIERS[one] for one in classifiers if one in CLASSIFIERS})) or UNKNOWN


def _package(name: str, version: str, licence: str, locator: str = "") -> dict[str, Any]:
    package = {
        "name": name,
        "SPDXID": f"SPDXRef-Package-{re.sub('[^A-Za-z0-9.-]', '-', f'{name}-{version}')}",
        "versionInfo": version,
        "downloadLocation": UNKNOWN,
        "filesAnalyzed": False,
        "licenseConcluded": UNKNOWN,
        "licenseDeclared": licence,
        "copyrightText": UNKNOWN,
    }
    reference = {"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": locator}
    return package | ({"externalRefs": [reference]} if locator else {})
