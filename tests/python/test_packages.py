"""Every file of the installed packages that is not what was installed is noticed, whatever its time stamp says."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from workflow.environment import packages

MODULE = "lib/package/module.py"


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of packages, and a lock; `add` notes what it was asked for."""
    folder = tmp_path / ".venv"
    for name in (MODULE, "lib/package/__pycache__/module.pyc", "bin/tool"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(name)
    (folder / "bin/python").symlink_to("/usr/bin/python3")
    (tmp_path / "a.lock").write_text("numpy")
    (tmp_path / "b.lock").write_text("ruff")
    for name, path in {"ROOT": tmp_path, "FOLDER": folder, "RECORD": folder / "installed.json",
                       "PYTHON": folder / "bin/python"}.items():  # fmt: skip
        monkeypatch.setattr(packages, name, path)
    packages.write({"a.lock": packages.digest(tmp_path / "a.lock")}, packages.state({}))
    return folder


def write(path: str, text: str = "edited") -> Callable[[Path], object]:
    def edit(folder: Path) -> None:
        (folder / path).parent.mkdir(exist_ok=True)
        status = (folder / path).stat() if (folder / path).exists() else None
        (folder / path).write_text(text)
        if status:
            os.utime(folder / path, ns=(status.st_atime_ns, status.st_mtime_ns))

    return edit


def relink(folder: Path) -> None:
    (folder / "bin/python").unlink()
    (folder / "bin/python").symlink_to("/usr/bin/env")


EDITS = {
    "module": (write(MODULE), MODULE),
    "module of the same length": (write(MODULE, MODULE.upper()), MODULE),
    "byte code": (write("lib/package/__pycache__/module.pyc"), "lib/package/__pycache__/module.pyc"),
    "foreign": (write("lib/sitecustomize.py"), "lib/sitecustomize.py"),
    "foreign folder": (write("lib/json/__init__.py"), "lib/json/__init__.py"),
    "link to a folder": (lambda folder: (folder / "lib/link").symlink_to("/usr/lib"), "lib/link"),
    "missing": (lambda folder: (folder / MODULE).unlink(), MODULE),
    "interpreter": (relink, "bin/python"),
    "pipe": (lambda folder: os.mkfifo(folder / "lib/pipe"), "lib/pipe"),
    "record": (lambda folder: (folder / "installed.json").write_text("{"), "installed.json"),
}


@pytest.mark.parametrize("edit", EDITS)
def test_faults(installed: Path, edit: str) -> None:
    assert packages.faults() == []
    change, path = EDITS[edit]
    change(installed)
    assert packages.faults() == [f".venv/{path}"]


def test_a_check_repairs_nothing(installed: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(packages.sys, "argv", ["packages", "--check"])
    with pytest.raises(SystemExit) as left:
        packages.main()
    assert not left.value.code
    write("lib/a.pth")(installed)
    with pytest.raises(SystemExit, match=r"'\.venv/lib/a\.pth' is not what was installed"):
        packages.main()
    assert (installed / "lib/a.pth").exists()


def test_a_file_that_cannot_be_read_is_not_what_was_installed(
    installed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (installed / MODULE).write_text("edited")

    def closed(*_: object) -> None:
        raise PermissionError

    monkeypatch.setattr(Path, "open", closed)
    assert packages.digest(installed / MODULE) == "cannot be read"


@pytest.mark.parametrize("files", ['{"a": 5}', '{"a": []}', "[" * 100_000 + "]" * 100_000, "[]"], ids=len)
def test_a_damaged_record_is_none(installed: Path, files: str) -> None:
    packages.RECORD.write_text(f'{{"locks": {{}}, "files": {files}}}')
    assert packages.record() == {}
    assert packages.faults() == [".venv/installed.json"]


def test_a_file_is_read_again_only_if_it_may_have_changed(
    installed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    known = packages.record()["files"]
    monkeypatch.setattr(packages, "digest", lambda path: f"read {path.name}")
    (installed / MODULE).write_text("edited")
    now = packages.state(known)
    assert [path for path in now if now[path][0].startswith("read")] == [MODULE]


@pytest.fixture
def added(installed: Path, monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """What was installed, each time."""
    calls: list[list[str]] = []
    monkeypatch.setattr(packages, "add", calls.append)
    monkeypatch.setattr(packages.subprocess, "run", lambda *_, **__: installed.mkdir())
    return calls


def test_nothing_is_installed_twice(installed: Path, added: list) -> None:
    packages.install(["a.lock"])
    assert added == []


def test_a_second_lock_is_added(installed: Path, added: list) -> None:
    packages.install(["a.lock", "b.lock"])
    packages.install(["a.lock"])
    assert added == [["b.lock"]]
    assert (installed / MODULE).exists()


@pytest.mark.parametrize("what", ["an older lock", "edited"])
def test_all_is_installed_again(installed: Path, added: list, what: str) -> None:
    if what == "edited":
        (installed / MODULE).write_text("edited")
    else:
        (installed.parent / "a.lock").write_text("numpy==1")
        os.utime(installed.parent / "a.lock", (0, 0))
    packages.install(["a.lock"])
    assert added == [["a.lock"]]
    assert not (installed / MODULE).exists()


@pytest.mark.parametrize("put", [None, os.mkfifo, os.mkdir])
def test_without_a_lock_nothing_is_removed(
    installed: Path, added: list, put: Callable[[Path], object] | None
) -> None:
    lock = installed.parent / "a.lock"
    lock.unlink()
    if put:
        put(lock)
    with pytest.raises(OSError, match=r"a\.lock is no file"):
        packages.install(["a.lock"])
    assert added == []
    assert (installed / MODULE).exists()
