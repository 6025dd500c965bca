"""`make provenance` says what it could not read, and refuses in one line what is no file."""

import sys
from dataclasses import replace
from pathlib import Path

import pytest

from workflow.provenance import repository, tree
from workflow.provenance.job import Job
from workflow.provenance.lock import Lock, configuration_files

KEPT = "a" * 64
NAME = "a\x1b[2J.csv"


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for module in (repository, tree):
        monkeypatch.setattr(module, "ROOT", tmp_path)
    (tmp_path / NAME).write_text("")
    return tmp_path


def status(monkeypatch: pytest.MonkeyPatch, file: Path) -> int | str | None:
    monkeypatch.setattr(sys, "argv", ["tree", str(file)])
    with pytest.raises(SystemExit) as left:
        tree.main()
    return left.value.code


def test_only_what_a_job_of_a_quality_writes_is_its_product(root: Path) -> None:
    """Neither a copy of a lock under another name vouches for anything, nor an output that no such job has."""
    output, forged = "figures/smoke/fig03.pdf", "b" * 64
    job = replace(a_drawing(), outputs={output: KEPT, "README.md": forged})
    for quality in ("smoke", "smoke_old"):
        Lock.path(quality).parent.mkdir(parents=True)
        Lock(quality, {"fig03": job}).write()
    assert tree.makers(KEPT)[0] == ["job fig03 of quality smoke wrote (commit None, no repository)"]
    assert tree.makers(forged)[0] == []


def a_drawing() -> Job:
    stated = {"configuration": configuration_files("smoke"), "pipeline": ["Makefile", "Snakefile"]}
    hashes = {name: dict.fromkeys(paths, KEPT) for name, paths in stated.items()}
    made_by = {
        "tool": "workflow/figures/fig03.py",
        "options": {"configuration": KEPT},
        "outputs": {},
        "python": "3",
    }
    inputs = {"workflow/figures/fig03.py": KEPT, "requirements.lock": KEPT}
    return Job(**made_by, **hashes, inputs=inputs, commit=None, dirty=None, machine="", exit=0)


def test_a_lock_that_cannot_be_looked_at_is_said(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert tree.makers("0") == ([], [])
    Lock("smoke").path("smoke").parent.mkdir(parents=True)
    Lock("smoke").write()
    (root / "data/README.md").write_text("")
    assert tree.makers("0") == ([], [])

    def closed(path: Path) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    with monkeypatch.context() as other_user:
        other_user.setattr(tree.os, "stat", closed)
        assert tree.makers("0")[1][-1] == "skipped data/smoke: Permission denied"
        other_user.setattr(tree.os, "listdir", closed)
        assert tree.makers("0") == ([], ["skipped data: Permission denied"])


def test_what_cannot_be_opened_is_refused(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    for name, words in {"b" * 300: "File name too long", "": "is not a file", "\x1b": "No such file"}.items():
        assert status(monkeypatch, root / name) == tree.BAD_INPUT
        said = capsys.readouterr().err
        assert words in said
        assert said.count("\n") == 1
        assert said.strip().isprintable()


def test_the_name_of_a_file_does_not_command_the_terminal(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    code = status(monkeypatch, root / NAME)
    said = f"{capsys.readouterr().out}{code}"
    assert "\\x1b[2J" in said
    assert "\x1b" not in said
    monkeypatch.setattr(tree, "makers", lambda _: ([], ["skipped data: closed"]))
    monkeypatch.setattr(tree.Ancestry, "product", lambda *_: "")
    assert status(monkeypatch, root / NAME) == tree.NOT_CHECKED
