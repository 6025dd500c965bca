"""The crate itself and its files: whose it is, what it conforms to, and the sha256 of everything in it."""

import hashlib
from datetime import date
from io import StringIO
from pathlib import Path
from typing import Any

from rocrate.model import ContextEntity, Entity
from rocrate.rocrate import ROCrate

from workflow.lib.citation import citation
from workflow.lib.parents import file_hash
from workflow.lib.places import regular
from workflow.provenance.repository import ROOT

PROFILES = {
    "https://w3id.org/ro/wfrun/process/0.5": "Process Run Crate",
    "https://w3id.org/ro/wfrun/workflow/0.5": "Workflow Run Crate",
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0": "Workflow RO-Crate",
}
# Beside the terms of RO-Crate; as the context of Workflow Run Crate has it.
TERMS = {"sha256": "https://w3id.org/ro/terms/workflow-run#sha256"}
TYPES = {
    ".csv": "text/csv",
    ".html": "text/html",
    ".h5": "application/x-hdf5",
    ".json": "application/json",
    ".md": "text/markdown",
    ".pdf": "application/pdf",
    ".png": "image/png",
    ".svg": "image/svg+xml",
}
WORKFLOW = "Snakefile"


def new_crate(description: str, day: date) -> ROCrate:
    """A crate without files; name, authors, version and licence are those of CITATION.cff and LICENSE."""
    cited = citation(ROOT)
    licence = regular(ROOT / "LICENSE").read_text()
    terms = {"@type": "CreativeWork", "name": licence.partition("\n")[0], "description": licence}
    crate = ROCrate(version="1.1")
    crate.metadata.extra_terms |= TERMS
    crate.name = cited["title"]
    crate.description = description
    crate.datePublished = day
    crate.license = add(crate, f"https://spdx.org/licenses/{cited['license']}", terms)
    root = crate.root_dataset
    root["version"] = cited["version"]
    root["author"] = compact(
        [_author(crate, number, author) for number, author in enumerate(cited["authors"], start=1)]
    )
    root["conformsTo"] = [
        add(crate, url, {"@type": "CreativeWork", "name": name, "version": url.rpartition("/")[2]})
        for url, name in PROFILES.items()
    ]
    return crate


def add_files(crate: ROCrate, paths: set[str], scripts: set[str]) -> dict[str, Entity]:
    """The files by path; those among the scripts, and the workflow, are also source code that can be run."""
    files = {path: _file(crate, path, path in scripts) for path in sorted(paths)}
    for path in {WORKFLOW, *scripts}:
        files[path]["version"] = crate.root_dataset["version"]
    files["README.md"]["about"] = crate.root_dataset
    return files


def add_text(crate: ROCrate, path: str, text: str) -> Entity:
    """A file that the crate alone has."""
    properties = {
        "name": path,
        "sha256": hashlib.sha256(text.encode()).hexdigest(),
        "encodingFormat": TYPES[Path(path).suffix],
        "contentSize": str(len(text.encode())),
    }
    return crate.add_file(StringIO(text), path, properties=properties)


def add(crate: ROCrate, identifier: str, properties: dict[str, Any]) -> Entity:
    return crate.add(ContextEntity(crate, identifier, properties))


def compact(values: list[Entity]) -> Entity | list[Entity]:
    """RO-Crate wants no list where there is one value."""
    return values[0] if len(values) == 1 else values


def _author(crate: ROCrate, number: int, author: dict[str, Any]) -> Entity:
    """By CITATION.cff a person has a family name, and a group a name only."""
    kind = "Person" if "family-names" in author else "Organization"
    name = author.get("name") or f"{author['given-names']} {author['family-names']}"
    return add(crate, author.get("orcid", f"#author-{number}"), {"@type": kind, "name": name})


def _file(crate: ROCrate, path: str, is_script: bool) -> Entity:
    properties: dict[str, Any] = {
        "name": path,
        "sha256": file_hash(ROOT / path),
        "encodingFormat": TYPES.get(Path(path).suffix, "text/plain"),
    }
    if path == WORKFLOW:
        described = {"properties": properties, "main": True, "lang": "snakemake", "record_size": True}
        return crate.add_workflow(ROOT / path, path, **described)
    if is_script:
        properties |= {"@type": ["File", "SoftwareSourceCode"], "programmingLanguage": "Python"}
    return crate.add_file(ROOT / path, path, properties=properties, record_size=True)
