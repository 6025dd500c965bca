"""A source is built again if its content differs, and an executable linked again; times decide nothing."""

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from workflow.environment import build_by_content

SOURCE, PROGRAM = "cpp/model/a.cpp", "cpp/observables/fake.cpp"


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for path in (SOURCE, PROGRAM, "cpp/CMakeLists.txt", "build/build.ninja", "build/bin/fake", "build/id/fake.json",
                 "build/bin/cpp_tests"):  # fmt: skip
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(path)
        os.utime(tmp_path / path, (0, 0))
    (tmp_path / "build/id/fake.json").write_text(
        '{"sources": {"observables/fake.cpp": "", "model/a.hpp": ""}}'
    )
    (tmp_path / PROGRAM).write_text('#include "model/a.hpp"\n')
    (tmp_path / "cpp/model/a.hpp").write_text("")
    digest = build_by_content.hash_of(tmp_path / "build/bin/fake")
    (tmp_path / "build/id/fake.sha256").write_text(f"{digest}  fake\n")
    for name, path in {"ROOT": "", "BUILD": "build", "RECORD": "build/built_from.json"}.items():
        monkeypatch.setattr(build_by_content, name, tmp_path / path)
    build_by_content.main()  # the first time all is new
    (tmp_path / "build/build.ninja").write_text("rules")
    build_by_content.main(["--built"])
    (tmp_path / "build/bin/fake").write_text("build/bin/fake")
    os.utime(tmp_path / SOURCE, (0, 0))
    return tmp_path


def test_an_old_time_does_not_hide_another_content(root: Path) -> None:
    build_by_content.main()
    assert (root / SOURCE).stat().st_mtime == 0
    (root / SOURCE).write_text("edited")
    os.utime(root / SOURCE, (0, 0))
    build_by_content.main()
    assert (root / SOURCE).stat().st_mtime > 0


def test_another_compiler_configures_again(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    now = build_by_content.present() | {"compiler": "another"}
    monkeypatch.setattr(build_by_content, "present", lambda: now)
    build_by_content.main()
    assert not (root / "build/build.ninja").exists()


@pytest.mark.parametrize(
    "file", ["build.ninja", "CMakeFiles/rules.ninja", "CMakeFiles/3.25.1/CMakeCXXCompiler.cmake"]
)
def test_edited_rules_are_written_again(root: Path, file: str) -> None:
    path = root / "build" / file
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("rules")
    build_by_content.main(["--built"])
    build_by_content.main()
    assert path.exists()
    build_by_content.main(["--built"])
    path.write_text("other rules")
    build_by_content.main()
    assert not path.exists()
    assert not (root / "build/build.ninja").exists()


def test_a_build_that_was_killed_is_not_configured_again(root: Path) -> None:
    """Nor after a second kill, which leaves no objects if CMake is at work then."""
    for _ in range(3):
        build_by_content.main()
    assert (root / "build/build.ninja").exists()
    (root / "build/build.ninja").write_text("other rules")
    build_by_content.main()
    assert not (root / "build/build.ninja").exists()


@pytest.mark.parametrize("added", ["cpp/observables/model/a.hpp", "cpp/model/a.cpp"])
def test_a_program_whose_includes_lead_elsewhere_is_built_again(root: Path, added: str) -> None:
    """A header that hides another, or the source beside a header: ninja's list of prerequisites does not have it."""
    (root / "cpp/model/a.cpp").unlink()
    build_by_content.main(["--built"])
    os.utime(root / PROGRAM, (0, 0))
    build_by_content.main()
    assert (root / PROGRAM).stat().st_mtime == 0
    (root / added).parent.mkdir(exist_ok=True)
    (root / added).write_text("")
    build_by_content.main()
    assert (root / PROGRAM).stat().st_mtime > 0


@pytest.mark.parametrize("make", [Path.mkdir, os.mkfifo])
@pytest.mark.parametrize("file", ["build/id/fake.json", "build/id/fake.sha256", "build/built_from.tmp"])
def test_what_is_no_file_is_named(root: Path, file: str, make: Callable[[Path], object]) -> None:
    """The linker and this would wait for ever for someone who reads from a pipe."""
    (root / file).unlink(missing_ok=True)
    make(root / file)
    with pytest.raises(OSError, match="lies where a file belongs; move it away") as caught:
        build_by_content.main()
    assert caught.value.filename == str(root / file)
    assert (root / "build/bin/fake").exists()


@pytest.mark.parametrize("text", ["{", "[]", "5", "[" * 100_000 + "]" * 100_000], ids=len)
def test_a_damaged_identity_is_written_again(root: Path, text: str) -> None:
    (root / "build/id/fake.json").write_text(text)
    build_by_content.main()
    assert not (root / "build/id/fake.json").exists()


@pytest.mark.parametrize("content", [b"{", b"[[1, 2]]", b"[" * 100_000, b"\xff"], ids=len)
def test_a_damaged_record_hinders_nothing(root: Path, content: bytes) -> None:
    build_by_content.main()
    for path in ("build/built_from.json", "build/id/fake.sha256"):
        (root / path).write_bytes(content)
    build_by_content.main()
    assert json.loads((root / "build/built_from.json").read_text())


@pytest.mark.parametrize("file", ["build/bin/fake", "build/id/fake.sha256"])
def test_an_executable_that_is_not_as_linked_leaves(root: Path, file: str) -> None:
    build_by_content.main()
    assert (root / "build/bin/fake").exists()
    (root / file).write_text("edited")
    build_by_content.main()
    assert not (root / "build/bin/fake").exists()
    assert (root / "build/bin/cpp_tests").exists()  # it makes no product
