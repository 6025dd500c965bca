"""make crate: all files with hashes, runs and figures as actions, equal bytes from equal inputs, accepted by the validator.

The validator fetches the JSON-LD context of RO-Crate 1.1. Here it runs offline and finds it in its own HTTP cache. The rocrate
library brings the context of 1.3; of the terms that our crates use, 1.1 maps one differently.
"""

import hashlib
import json
import os
import shutil
import zipfile
from io import BytesIO
from pathlib import Path

import pytest
from requests import Request
from requests.adapters import HTTPAdapter
from requests_cache import CachedSession
from rocrate.vocabs import RO_CRATE
from rocrate_validator.services import validate
from urllib3 import HTTPResponse

from tests.workflow.conftest import Clone, append

FOLDER, ARCHIVE = "build/crate/smoke", "build/crate/fig03.zip"
METADATA = "ro-crate-metadata.json"
CONTEXT = "https://w3id.org/ro/crate/1.1/context"
TERMS_OF_1_1 = {"ComputationalWorkflow": "https://bioschemas.org/ComputationalWorkflow"}
WORKFLOW_RUN = "workflow-run-crate-0.5"  # includes the profiles on which it is based

pytestmark = pytest.mark.filterwarnings("ignore:ConjunctiveGraph:DeprecationWarning")

Entities = dict[str, dict]


def pack(clone: Clone, status: int = 0) -> str:
    command = ("provenance.crate", "--quality", "smoke", "--panel", "fig03", "--archive", ARCHIVE)
    return clone.module(*command, status=status)


@pytest.fixture(scope="module")
def packed(clean: Clone) -> Clone:
    pack(clean)
    return clean


def entities(folder: Path) -> Entities:
    return {entity["@id"]: entity for entity in json.loads((folder / METADATA).read_text())["@graph"]}


def test_every_file_is_there_with_its_hash(packed: Clone) -> None:
    folder = packed.folder / FOLDER
    files = {path: entity for path, entity in entities(folder).items() if "File" in entity["@type"]}
    present = {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}
    assert present == {*files, METADATA}
    assert {path for path in packed.products() if "/fig03/" in path or "/fig03." in path} <= present
    assert {"Makefile", "LICENSE", "uv.lock", "cpp/CMakeLists.txt", "docs/format.md"} <= present
    for path, entity in files.items():
        assert hashlib.sha256((folder / path).read_bytes()).hexdigest() == entity["sha256"]
        assert (folder / path).read_bytes() == (packed.folder / path).read_bytes()
    with zipfile.ZipFile(packed.folder / ARCHIVE) as archive:
        content = {name: archive.read(name) for name in archive.namelist()}
    assert content == {name: (folder / name).read_bytes() for name in present}


def test_every_run_and_figure_is_an_action(packed: Clone) -> None:
    stated = entities(packed.folder / FOLDER)
    actions = {entity["name"]: entity for entity in stated.values() if entity["@type"] == "CreateAction"}
    assert {*actions} == {"workflow", "job/fig03", "job/fig03/paper", "job/fig03/equal", "job/fig03/exchange"}
    run, drawing = actions["job/fig03/paper"], actions["job/fig03"]
    assert run["description"].startswith("boltzmann --sigma 0.5 --gamma 1 --nu-left 220 ")
    assert run["result"] == {"@id": packed.result("fig03/paper")}
    assert drawing["instrument"] == {"@id": "workflow/figures/fig03.py"}
    assert run["result"] in drawing["object"]
    assert len(drawing["result"]) == 5


def test_equal_inputs_give_equal_bytes_that_name_no_folder(packed: Clone) -> None:
    first = [(packed.folder / path).read_bytes() for path in (ARCHIVE, f"{FOLDER}/{METADATA}")]
    assert str(packed.folder).encode() not in first[1]
    for path in ("README.md", "figures/smoke/fig03.csv"):
        os.utime(packed.folder / path, (1e9, 1e9))
    pack(packed)
    assert [(packed.folder / path).read_bytes() for path in (ARCHIVE, f"{FOLDER}/{METADATA}")] == first


def test_a_second_make_crate_does_nothing(kept: Clone) -> None:
    """After a new source the crate is written again, and contains it even if git does not track it."""
    command = (".venv/bin/snakemake", "--config", "quality=smoke", "panel=fig03", "--", "crate")
    kept.run(*command)
    (archive,) = (kept.folder / "build/crate").glob("lorentz-gas-smoke-fig03.*.zip")
    assert "Nothing to be done" in kept.run(*command).stdout
    (kept.folder / "workflow/figures/mine.py").write_text("x = 1\n")
    kept.run(*command)
    (second,) = {*(kept.folder / "build/crate").glob("lorentz-gas-smoke-fig03.*.zip")} - {archive}
    with zipfile.ZipFile(second) as content:
        assert "workflow/figures/mine.py" in content.namelist()


def test_what_has_been_edited_is_not_packed(packed: Clone, kept: Clone) -> None:
    before = (packed.folder / ARCHIVE).read_bytes()
    append("figures/smoke/fig03.csv", "1,2\n")(kept)
    assert "fig03.csv: edited or replaced: it differs from its hash in fig03." in pack(kept, status=1)
    assert (packed.folder / ARCHIVE).read_bytes() == before


@pytest.fixture(scope="module")
def http_cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """HTTP cache with the context of RO-Crate, so that the validator needs no network."""
    path = tmp_path_factory.mktemp("http") / "cache"
    content = json.dumps({"@context": RO_CRATE["@context"] | TERMS_OF_1_1}).encode()
    raw = HTTPResponse(BytesIO(content), {"Content-Type": "application/ld+json"}, 200, preload_content=False)
    with CachedSession(str(path), backend="sqlite") as session:
        session.cache.save_response(HTTPAdapter().build_response(Request("GET", CONTEXT).prepare(), raw))
    return path


def complaints(crate: Path, http_cache: Path) -> list[str]:
    """Faults found by the validator, which must have skipped no check."""
    settings = {
        "rocrate_uri": str(crate),
        "profile_identifier": WORKFLOW_RUN,
        "requirement_severity": "REQUIRED",
    }
    result = validate(settings | {"offline": True, "cache_path": http_cache})
    assert result.executed_checks
    assert not result.skipped_checks
    assert result.passed() == (not result.get_issues())
    return [issue.message for issue in result.get_issues()]


def test_the_validator_accepts_it(packed: Clone, http_cache: Path) -> None:
    assert complaints(packed.folder / FOLDER, http_cache) == []


def test_the_validator_rejects_a_crate_without_instrument(
    packed: Clone, http_cache: Path, tmp_path: Path
) -> None:
    crate = shutil.copytree(packed.folder / FOLDER, tmp_path / "crate")
    content = json.loads((crate / METADATA).read_text())
    {entity["@id"]: entity for entity in content["@graph"]}["#job/fig03/paper"].pop("instrument")
    (crate / METADATA).write_text(json.dumps(content))
    assert any("MUST have an instrument" in found for found in complaints(crate, http_cache))
