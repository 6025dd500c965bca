"""make crate: everything in it with its hash and its makers, the same bytes from the same inputs, clear refusals."""

import hashlib
import json
import os
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

from tests.workflow.conftest import CHEAP, Clone
from tests.workflow.tampering import run_module
from workflow.provenance.bill_of_materials import NAME as BILL

FOLDER = "build/crate/standard"
ARCHIVE = "build/crate/lorentz-gas-standard.zip"
METADATA = "ro-crate-metadata.json"


def entities(clone: Clone) -> dict[str, dict]:
    graph = json.loads((clone.folder / FOLDER / METADATA).read_text())["@graph"]
    return {entity["@id"]: entity for entity in graph}


def test_every_file_is_there_with_its_hash(packed: Clone) -> None:
    folder = packed.folder / FOLDER
    files = {path: entity for path, entity in entities(packed).items() if "File" in entity["@type"]}
    present = {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}
    assert present == {*files, METADATA}
    products = {path for path in packed.products() if "/standard/" in path}
    assert products <= present
    assert {"Makefile", "LICENSE", "CITATION.cff", "cpp/CMakeLists.txt", "docs/format.md"} <= present
    for path, entity in files.items():
        assert hashlib.sha256((folder / path).read_bytes()).hexdigest() == entity["sha256"]
        assert int(entity["contentSize"]) == (folder / path).stat().st_size
        assert path == BILL or (folder / path).read_bytes() == (packed.folder / path).read_bytes()
    with zipfile.ZipFile(packed.folder / ARCHIVE) as archive:
        assert {name: archive.read(name) for name in archive.namelist()} == {
            name: (folder / name).read_bytes() for name in present
        }


def test_the_bill_of_materials_names_what_the_panel_was_made_with(packed: Clone) -> None:
    bill = json.loads((packed.folder / FOLDER / BILL).read_text())
    named = {package["name"] for package in bill["packages"]}
    assert {"numpy", "matplotlib", "snakemake", "GSL", "HDF5"} <= named


def test_every_job_of_the_panel_is_an_action(packed: Clone) -> None:
    said = entities(packed)
    lock = json.loads((packed.folder / "data/standard/lock.json").read_text())["jobs"]
    actions = {one["name"]: one for one in said.values() if one["@type"] == "CreateAction"}
    assert {*lock, "make panel PANEL=fig03 QUALITY=standard"} == {*actions}
    run, drawing = actions["fig03/paper"], actions["fig03"]
    assert said[run["instrument"]["@id"]]["version"] == lock["fig03/paper"]["build_id"]
    assert run["description"].startswith("boltzmann --sigma 0.5 --gamma 1 --nu-left 220 ")
    assert run["result"] == {"@id": "data/standard/fig03/paper.h5"}
    assert drawing["instrument"] == {"@id": "workflow/figures/fig03.py"}
    assert run["result"] in drawing["object"]
    assert [one["@id"] for one in drawing["result"]] == sorted(lock["fig03"]["outputs"])


def test_equal_inputs_give_equal_bytes_that_name_no_folder(packed: Clone) -> None:
    first = [(packed.folder / path).read_bytes() for path in (ARCHIVE, f"{FOLDER}/{METADATA}")]
    assert str(packed.folder).encode() not in first[1]
    shutil.rmtree(packed.folder / "build/crate")
    for path in ("README.md", "figures/standard/fig03.csv"):
        os.utime(packed.folder / path, (1e9, 1e9))
    umask = os.umask(0o077)
    try:
        assert packed.make("crate", *CHEAP).returncode == 0
    finally:
        os.umask(umask)
    assert [(packed.folder / path).read_bytes() for path in (ARCHIVE, f"{FOLDER}/{METADATA}")] == first


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("QUALITY=smoke",), ["QUALITY=smoke makes drafts", "choose standard, paper or deep"]),
        ((), ["fig01/paper.h5 is missing", "make figures QUALITY=standard", "PANEL"]),
        (
            ("QUALITY=deep", "PANEL=fig03"),
            ["data/deep/lock.json is missing", "make panel PANEL=fig03 QUALITY=deep"],
        ),
    ],
)
def test_refusals(packed: Clone, arguments: tuple[str, ...], words: list[str]) -> None:
    assert_refused(packed, ("crate", *arguments), words)


def test_an_unknown_panel_is_refused(packed: Clone) -> None:
    """By make, before anything is packed."""
    before = (packed.folder / ARCHIVE).read_bytes()
    made = packed.make("crate", "PANEL=fig99")
    assert made.returncode == 2
    assert "PANEL=fig99 is not known; the nearest is fig09b" in made.stdout
    assert (packed.folder / ARCHIVE).read_bytes() == before


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ("figures/standard/fig03.csv", ["fig03: figures/standard/fig03.csv is not what the job wrote"]),
        ("data/standard/fig03/paper.h5", ["data/standard/fig03/paper.h5 is not what the job wrote"]),
        ("workflow/figures/fig03.py", ["fig03: workflow/figures/fig03.py changed"]),
        ("data/standard/lock.json", ["data/standard/lock.json is damaged"]),
    ],
)
def test_what_has_been_edited_is_not_packed(packed: Clone, path: str, words: list[str]) -> None:
    edited = packed.folder / path
    content = edited.read_bytes()
    edited.write_bytes(content + b"\n#\n")
    try:
        assert_refused(packed, ("crate", *CHEAP), [*words, "make panel PANEL=fig03 QUALITY=standard"])
    finally:
        edited.write_bytes(content)


def test_in_a_repository_it_holds_what_is_tracked_and_the_day_of_the_commit(packed: Clone) -> None:
    untracked = packed.folder / "docs/untracked.md"
    untracked.write_text("Not part of the project\n")
    try:
        assert packed.make("crate", *CHEAP).returncode == 0
    finally:
        untracked.unlink()
    said = entities(packed)
    assert said["./"]["datePublished"] == "2011-02-04"
    assert ".gitignore" in said
    assert "docs/untracked.md" not in said


def audit(clone: Clone, crate: str) -> subprocess.CompletedProcess:
    return run_module(clone, "audit", "--panel", "fig03", "--crate", crate, quality="standard")


@pytest.mark.parametrize("place", [FOLDER, ARCHIVE])
def test_what_was_packed_is_what_is_here(packed: Clone, place: str) -> None:
    assert packed.make("crate", *CHEAP).returncode == 0
    audited = audit(packed, place)
    assert audited.returncode == 0, audited.stdout


def test_a_consistent_forgery_is_found_against_the_crate(packed: Clone, tmp_path: Path) -> None:
    """Sources changed, committed, and everything made again from them: nothing here contradicts anything else."""
    assert packed.make("crate", *CHEAP).returncode == 0
    deposited = shutil.copyfile(packed.folder / ARCHIVE, tmp_path / "deposited.zip")
    script = packed.folder / "workflow/figures/fig03.py"
    text = script.read_text()
    try:
        script.write_text(text.replace("COLUMN", "HEIGHT", 1))
        packed.commit()
        assert packed.make("panel", *CHEAP).returncode == 0
        assert run_module(packed, "audit", "--panel", "fig03", quality="standard").returncode == 0
        audited = audit(packed, str(deposited))
    finally:
        script.write_text(text)
        packed.commit()
        assert packed.make("panel", *CHEAP).returncode == 0
    assert audited.returncode == 1
    for path in ("workflow/figures/fig03.py", "figures/standard/fig03.pdf"):
        assert f"{path}: is not what the crate holds" in audited.stdout
    assert "data/standard/lock.json: names other " in audited.stdout


@pytest.mark.parametrize(
    ("place", "words"),
    [
        ("none.zip", "there is no such file"),
        ("README.md", "is no crate of this project"),
        ("docs", "is no crate of this project"),
    ],
)
def test_what_is_no_crate_is_refused(packed: Clone, place: str, words: str) -> None:
    audited = audit(packed, place)
    assert audited.returncode == 2
    assert words in audited.stdout
    assert audited.stdout.count("\n") == 1


def test_a_damaged_crate_is_told(packed: Clone, tmp_path: Path) -> None:
    assert packed.make("crate", *CHEAP).returncode == 0
    folder = shutil.copytree(packed.folder / FOLDER, tmp_path / "crate")
    (folder / "LICENSE").write_text("none\n")
    audited = audit(packed, str(folder))
    assert audited.returncode == 1
    assert "LICENSE: is damaged or missing in the crate itself" in audited.stdout


def assert_refused(clone: Clone, arguments: tuple[str, ...], words: list[str]) -> None:
    """With these words; what had been packed before is left alone."""
    before = (clone.folder / ARCHIVE).read_bytes()
    made = clone.make(*arguments)
    assert made.returncode != 0
    assert "Error 2" in made.stdout
    assert "Traceback" not in made.stdout
    for word in ["make crate: ", *words]:
        assert word in made.stdout
    assert (clone.folder / ARCHIVE).read_bytes() == before


def test_without_a_repository_the_day_is_that_of_the_makefile(packed: Clone) -> None:
    hidden = (packed.folder / ".git").rename(packed.folder / ".cache/git")
    try:
        for arguments in (("panel", "FRESH=yes"), ("crate",)):
            made = packed.make(*arguments, *CHEAP)
            assert made.returncode == 0, made.stdout
    finally:
        hidden.rename(packed.folder / ".git")
    said = entities(packed)
    assert said["./"]["datePublished"] == "2009-01-01"  # SOURCE_DATE_EPOCH
    assert "cpp/model/collision.hpp" in said
