"""The lock file contains exactly the files that its jobs name."""

import json
import os
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path

import pytest

from workflow.provenance import repository, stale
from workflow.provenance.build_id import IDENTITY
from workflow.provenance.chain import difference_of
from workflow.provenance.job import Job
from workflow.provenance.lock import (
    FORMAT,
    Lock,
    LockError,
    changing,
    checksum_of,
    collect,
    configuration_files,
    record,
    record_path,
    records,
)

KEPT = "a" * 64
STATED = {"configuration": configuration_files("smoke"), "pipeline": ["Makefile", "Snakefile"]}
BUILD = dict.fromkeys(IDENTITY, "") | {"build_id": KEPT, "sources": {}}


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for module in (repository, stale):
        monkeypatch.setattr(module, "ROOT", tmp_path)
    return tmp_path


@pytest.fixture
def job() -> Job:
    options = {"sigma": 0.1, "cells": 11, "zero-total-momentum": True, "gamma": "N"}
    hashes = {name: dict.fromkeys(paths, KEPT) for name, paths in STATED.items()}
    return Job("persistence", options, {}, **hashes, commit=None, dirty=None, machine="", exit=0, build_id=KEPT,
               executable=KEPT)  # fmt: skip


def test_a_build_leaves_with_the_last_run_of_it(root: Path, job: Job) -> None:
    with changing("smoke") as lock:
        lock.builds = {KEPT: BUILD, "0" * 64: BUILD | {"build_id": "0" * 64}}
        lock.jobs["fig05/all"] = job
    assert Lock.read("smoke").builds == {KEPT: BUILD}
    stale.retire("smoke", stale.unasked("smoke", {}))
    assert Lock.read("smoke").builds == {}


def test_an_emptied_folder_leaves_with_its_last_product(root: Path, job: Job) -> None:
    paths = [f"data/smoke/{name}.h5" for name in ("fig05/all", "fig06/all", "fig06/other")]
    for path in paths:
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text("")
    with changing("smoke") as lock:
        for path in paths[:2]:
            name = path.removeprefix("data/smoke/").removesuffix(".h5")
            lock.jobs[name] = replace(job, outputs={path: KEPT})
    stale.retire("smoke", ["fig05/all", "fig06/all"])
    assert not (root / "data/smoke/fig05").exists()
    assert [path.name for path in (root / "data/smoke/fig06").iterdir()] == ["other.h5"]


def test_options_keep_their_types(root: Path, job: Job) -> None:
    with changing("smoke") as lock:
        lock.jobs["fig05/all"] = job
    read = Lock.read("smoke").jobs["fig05/all"]
    assert read == job
    assert {name: type(value) for name, value in read.options.items()} == {
        name: type(value) for name, value in job.options.items()
    }
    assert difference_of(read.options, job.options) is None
    assert difference_of(job.options, job.options | {"gamma": 1}) == "--gamma from N to 1"


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"persistence"', '"conductivity"', "its checksum does not fit"),
        ('"tool"', '"tol"', "is damaged"),
        ('"quality": "smoke"', '"quality": "smoke", "more": 1', "nobody here writes 'more' into it"),
        ('"sources": {}', '"sources": {}, "more": 1', "entries of build"),
        ('"build_id": "aa', '"build_id": "ab', "is damaged"),
        ('"version": 3', '"version": 2', "is of version 2, not 3"),
    ],
)
def test_another_lock_is_refused(root: Path, job: Job, old: str, new: str, words: str) -> None:
    with changing("smoke") as lock:
        lock.builds[KEPT], lock.jobs["fig05/all"] = BUILD, job
    text = Lock.path("smoke").read_text()
    assert old in text
    Lock.path("smoke").write_text(text.replace(old, new))
    with pytest.raises(LockError, match=words):
        Lock.read("smoke")


@pytest.mark.parametrize(
    ("part", "value"),
    [
        ("tool", []), ("machine", None), ("exit", 1), ("exit", False), ("exit", "0"), ("commit", ""), ("commit", 5),
        ("commit", "a" * 40), ("dirty", False), ("options", None), ("outputs", ["x"]), ("outputs", {"x": "y"}),
        ("outputs", {"a\0": KEPT}), ("outputs", {"\ud800": KEPT}), ("configuration", {}), ("pipeline", {}),
        ("inputs", 5), ("inputs", {"x": KEPT}), ("python", "3.11"), ("build_id", "x"), ("executable", None),
    ],
)  # fmt: skip
def test_a_forged_entry_is_refused(root: Path, job: Job, part: str, value: object) -> None:
    seal({"fig05/all": job})
    Lock.read("smoke")
    forged = {"fig05/all": replace(job, **{part: value})}
    with pytest.raises(LockError, match="it cannot hold"), changing("smoke") as lock:
        lock.jobs = forged
    assert Lock.read("smoke").jobs == {"fig05/all": job}
    seal(forged)
    with pytest.raises(LockError, match="is damaged"):
        Lock.read("smoke")


def test_a_name_that_stands_twice_is_damage(root: Path, job: Job) -> None:
    """The checksum is that of what was read, and readers differ in which of the two they take."""
    with changing("smoke") as lock:
        lock.builds, lock.jobs = {KEPT: BUILD}, {"fig05/all": job}
    path = Lock.path("smoke")
    path.write_text(path.read_text().replace('"quality"', '"quality": "evil",\n "quality"', 1))
    with pytest.raises(LockError, match="'quality' stands twice"):
        Lock.read("smoke")


def seal(jobs: dict[str, Job], quality: str = "smoke") -> None:
    """A lock whose checksum fits, whatever it holds."""
    entries = {name: asdict(job) for name, job in jobs.items()}
    content = FORMAT | {"quality": quality, "builds": {}, "jobs": entries}
    Lock.path("smoke").parent.mkdir(parents=True, exist_ok=True)
    Lock.path("smoke").write_text(json.dumps(content | {"checksum": checksum_of(content)}))


@pytest.mark.parametrize("name", ["../precious", "fig05/..", "fig05/a/b", "/fig05", "fig05/", "."])
def test_a_name_leads_nowhere_else(root: Path, job: Job, name: str) -> None:
    seal({name: job})
    with pytest.raises(LockError, match="is damaged: name"):
        Lock.read("smoke")


def leave(name: str, job: Job) -> Path:
    path = record_path("smoke", name)
    path.parent.mkdir(parents=True, exist_ok=True)
    Lock("smoke", {name: job}, {KEPT: BUILD}).write(path)
    return path


def test_records_are_read_and_collected(root: Path, job: Job) -> None:
    """Also where there is no lock yet, and over what it says."""
    path = leave("fig05/all", job)
    assert Lock.read("smoke").jobs == {"fig05/all": job}
    collect("smoke")
    assert not path.exists()
    leave("fig05/all", replace(job, machine="another"))
    leave("fig06/all", job)
    expected = {"fig05/all": replace(job, machine="another"), "fig06/all": job}
    assert Lock.read("smoke").jobs == expected
    collect("smoke")
    assert Lock.read("smoke").jobs == expected
    assert Lock.read("smoke").builds == {KEPT: BUILD}
    assert records("smoke") == []


@pytest.mark.parametrize(
    "damage", [lambda text: text[:-9], lambda text: text.replace("persis", "Persis"), lambda text: ""]
)
def test_a_damaged_record_says_nothing(root: Path, job: Job, damage: Callable[[str], str]) -> None:
    leave("fig05/all", job)
    path = leave("fig06/all", job)
    path.write_text(damage(path.read_text()))
    assert Lock.read("smoke").jobs == {"fig05/all": job}


def test_a_record_speaks_of_its_own_job_alone(root: Path, job: Job) -> None:
    seal({"fig05/all": job})
    other = leave("fig06/all", replace(job, machine="another"))
    place = record_path("smoke", "fig05/all")
    place.parent.mkdir(parents=True)
    other.rename(place)
    assert Lock.read("smoke").jobs == {"fig05/all": job}


def test_a_damaged_lock_keeps_its_records(root: Path, job: Job) -> None:
    path = leave("fig05/all", job)
    Lock.path("smoke").parent.mkdir(parents=True)
    Lock.path("smoke").write_text("{")
    with pytest.raises(LockError):
        collect("smoke")
    assert path.exists()
    assert stale.set_damaged_lock_aside("smoke")
    assert Lock.read("smoke").jobs == {"fig05/all": job}


def test_the_lock_of_another_quality_is_refused(root: Path, job: Job) -> None:
    """It would be written to the place of that quality."""
    seal({"fig05/all": job}, "../elsewhere")
    with pytest.raises(LockError, match=r"lock\.json is that of another quality"):
        Lock.read("smoke")


def test_what_a_lock_says_is_moved_only_where_the_job_writes(root: Path, job: Job) -> None:
    own, others = "data/smoke/zzz/a.h5", (".git/HEAD", "README.md", "data/smoke/fig05/all.h5")
    for path in (own, *others):
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text("")
    seal({"zzz/a": replace(job, outputs=dict.fromkeys((".git", "../precious", *others, own), KEPT))})
    (root.parent / "precious").write_text("")
    stale.retire("smoke", stale.unasked("smoke", {}))
    assert all((root / path).exists() for path in (*others, "../precious"))
    assert not (root / own).parent.exists()
    assert (root / stale.REPLACED / own).is_file()
    assert Lock.read("smoke").jobs == {}


@pytest.mark.parametrize("make", [Path.mkdir, os.mkfifo, lambda path: path.symlink_to("..")])
def test_only_files_are_moved(root: Path, job: Job, make: Callable[[Path], object]) -> None:
    seal({"zzz/a": job})
    place = root / "data/smoke/zzz/a.h5"
    place.parent.mkdir()
    make(place)
    with pytest.raises(OSError, match="lies where a file belongs"):
        stale.retire("smoke", ["zzz/a"])
    assert os.path.lexists(place)
    assert {*Lock.read("smoke").jobs} == {"zzz/a"}


def test_records_are_not_looked_for_behind_a_link(root: Path) -> None:
    (root / "build").mkdir(exist_ok=True)
    (root / "build/records").symlink_to("/")
    with pytest.raises(OSError, match="a link lies where a folder belongs"):
        Lock.read("smoke")


def test_what_lies_behind_a_link_is_not_recorded(root: Path, job: Job) -> None:
    seal({"fig05/all": job})
    (root / "elsewhere").mkdir()
    (root / "elsewhere/all.h5").write_text("")
    (root / "data/smoke/fig06").symlink_to(root / "elsewhere")
    with pytest.raises(OSError, match="a link lies where a folder belongs"):
        record("smoke", "fig06/all", {"data/smoke/fig06/all.h5": "a"}, {"tool": "", "options": {}, "exit": 0})
    assert Lock.read("smoke").jobs == {"fig05/all": job}
