"""What git is asked is what its commit holds, whatever is configured or put in the place of its objects."""

import os
import subprocess
import zlib
from pathlib import Path

import pytest

from workflow.provenance import repository
from workflow.provenance.repository import (
    DamagedError,
    FileHashes,
    files_at,
    no_history,
    state,
    stored_at,
    untracked,
)

TRUE, FALSE = "true\n", "false\n"


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository with one commit that holds `a`."""
    monkeypatch.setattr(repository, "ROOT", tmp_path)
    run(tmp_path, "init", "--quiet")
    (tmp_path / "a").write_text(TRUE)
    run(tmp_path, "add", "a")
    run(tmp_path, "commit", "--quiet", "--message", "true")
    assert files_at("HEAD", "a") == {"a": TRUE.encode()}
    return tmp_path


def run(root: Path, *arguments: str, given: str = "") -> str:
    author = ["-c", "user.name=Nobody", "-c", "user.email=nobody@example.org"]
    command = ["git", *author, *arguments]
    return subprocess.run(
        command, cwd=root, input=given, stdout=subprocess.PIPE, text=True, check=True
    ).stdout.strip()


def test_a_replacement_is_not_followed(root: Path) -> None:
    forged = run(root, "hash-object", "-w", "--stdin", given=FALSE)
    run(root, "replace", run(root, "rev-parse", "HEAD:a"), forged)
    assert run(root, "show", "HEAD:a") == FALSE.strip()
    assert files_at("HEAD", "a") == {"a": TRUE.encode()}


def test_a_filter_is_not_applied(root: Path) -> None:
    run(root, "config", "filter.forge.smudge", "echo false")
    (root / ".git/info/attributes").write_text("a filter=forge\n")
    assert files_at("HEAD", "a") == {"a": TRUE.encode()}


def test_an_object_that_is_not_what_its_name_says_is_none(root: Path) -> None:
    name = run(root, "rev-parse", "HEAD:a")
    place = root / ".git/objects" / name[:2] / name[2:]
    place.chmod(0o644)
    place.write_bytes(zlib.compress(f"blob {len(FALSE)}\0{FALSE}".encode()))
    with pytest.raises(DamagedError, match=f"git fsck complains: .*{name[2:]}"):
        files_at("HEAD", "a")


def test_a_commit_that_lacks_a_file_has_none(root: Path) -> None:
    name = run(root, "rev-parse", "HEAD:a")
    (root / ".git/objects" / name[:2] / name[2:]).unlink()
    assert stored_at("HEAD", "a") is None
    with pytest.raises(DamagedError, match=r"git fsck complains: (broken link|missing blob)"):
        files_at("HEAD", "a")


def test_no_pipe_is_waited_for(root: Path) -> None:
    (root / ".git/HEAD").unlink()
    os.mkfifo(root / ".git/HEAD")
    with pytest.raises(OSError, match="a pipe lies where a file belongs"):
        state()


def test_only_a_commit_has_files(root: Path) -> None:
    assert files_at(run(root, "rev-parse", "HEAD^{tree}")) is None
    assert files_at(run(root, "rev-parse", "HEAD:a")) is None
    assert files_at("0" * 40) is None


@pytest.mark.parametrize("decides", ["workflow/lib/fit.py", "CITATION.cff"])
def test_what_git_is_told_of_changes_is_not_believed(root: Path, decides: str) -> None:
    """A monitor that the repository names says that no file has changed; git would run it, and believe it."""
    (root / decides).parent.mkdir(parents=True, exist_ok=True)
    (root / decides).write_text("1\n")
    run(root, "add", "--all")
    run(root, "commit", "--quiet", "--message", "more")
    monitor = root / ".git/monitor"
    monitor.write_text("#!/bin/sh\ntouch .git/ran\nprintf 'tok\\0'\n")
    monitor.chmod(0o755)
    run(root, "config", "core.fsmonitor", str(monitor))
    run(root, "status")
    run(root, "status")
    (root / ".git/ran").unlink()
    assert state()["dirty"] is False
    (root / decides).write_text("2\n")
    assert state()["dirty"] is True
    assert not (root / ".git/ran").exists()


def test_an_index_that_lies_does_not_hide_a_change(root: Path) -> None:
    """By the times that it has of a file git does not read it again."""
    (root / "CITATION.cff").write_text("1\n")
    run(root, "add", "--all")
    run(root, "commit", "--quiet", "--message", "more")
    run(root, "config", "core.trustctime", "false")
    run(root, "config", "core.checkStat", "minimal")
    before = (root / "CITATION.cff").stat()
    os.utime(root / "CITATION.cff", ns=(0, 0))
    run(root, "update-index", "--refresh")
    (root / "CITATION.cff").write_text("2\n")
    os.utime(root / "CITATION.cff", ns=(0, 0))
    assert (root / "CITATION.cff").stat().st_size == before.st_size
    assert run(root, "status", "--porcelain") == ""
    assert state()["dirty"] is True


@pytest.mark.parametrize("mark", ["--assume-unchanged", "--skip-worktree"])
def test_a_file_that_git_is_told_not_to_look_at_may_have_changed(root: Path, mark: str) -> None:
    assert state()["dirty"] is False
    run(root, "update-index", mark, "a")
    (root / "a").write_text(FALSE)
    assert run(root, "status", "--porcelain") == ""
    assert state()["dirty"] is True


@pytest.mark.parametrize("path", ["cpp/sleef.h", "workflow/lib/plan/__init__.py", "GNUmakefile"])
@pytest.mark.parametrize("hidden", ["not", "ignored", "staged"])
def test_a_file_that_no_commit_has_is_named_among_the_code(root: Path, path: str, hidden: str) -> None:
    assert untracked() == []
    for name in (path, "notes.txt", "workflow/lib/__pycache__/plan.pyc"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(FALSE)
    if hidden == "ignored":
        (root / ".git/info/exclude").write_text("*\n")
    if hidden == "staged":
        run(root, "add", path)
    assert untracked() == [path]
    assert state()["dirty"] is True


def test_a_submodule_and_a_name_that_is_no_text_are_read(root: Path) -> None:
    name = os.fsdecode(b"\xff")
    (root / name).write_text(TRUE)
    run(root, "add", name)
    run(root, "update-index", "--add", "--cacheinfo", f"160000,{run(root, 'rev-parse', 'HEAD')},sub")
    run(root, "commit", "--quiet", "--message", "more")
    assert files_at("HEAD") == {"a": TRUE.encode(), name: TRUE.encode()}


def test_what_keeps_git_from_reading_is_told_apart(
    root: Path, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert no_history() is None
    with monkeypatch.context() as other_user:
        other_user.setenv("GIT_TEST_ASSUME_DIFFERENT_OWNER", "1")
        remedy = f"git config --global --add safe.directory {root}"
        assert no_history() == f"the repository is another user's, which git reads after: {remedy}"
    (root / ".git/shallow").write_text(run(root, "rev-parse", "HEAD"))
    assert no_history() == "the repository is shallow"
    monkeypatch.setattr(repository, "ROOT", tmp_path_factory.mktemp("empty"))
    assert no_history() == "this is no repository that git reads"
    monkeypatch.setenv("PATH", str(root))
    assert no_history() == "git is not installed"


def test_what_lies_behind_a_link_is_no_file_of_the_project(root: Path) -> None:
    (root / "elsewhere").mkdir()
    (root / "elsewhere/b").write_text(TRUE)
    (root / "link").symlink_to("a")
    (root / "folder").symlink_to("elsewhere")
    (root / "data").symlink_to("elsewhere")  # a larger disk
    hashes = FileHashes()
    assert hashes["a"] == hashes["elsewhere/b"] == hashes["data/b"]
    assert [hashes[path] for path in ("link", "folder/b", "none", "elsewhere", "a" * 300)] == [None] * 5


@pytest.mark.parametrize(("setting", "value"), [("core.bare", "true"), ("core.worktree", "/")])
def test_settings_do_not_hide_the_files_that_are_here(root: Path, setting: str, value: str) -> None:
    run(root, "config", setting, value)
    assert no_history() is None
    assert state()["dirty"] is False
    (root / "cpp").mkdir()
    (root / "cpp/sleef.h").write_text("")
    assert untracked() == ["cpp/sleef.h"]
    assert state()["dirty"] is True


def test_a_git_that_fails_is_no_clean_tree(root: Path) -> None:
    (root / ".git/index").write_bytes(b"no index")
    assert no_history() == "git does not list the files here"
    assert state()["dirty"] is True
