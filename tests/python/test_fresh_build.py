"""A fresh build uses the sources alone, and tells which of a program's roots is not the one that the lock names."""

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest

from workflow.provenance import fresh_build, verify
from workflow.provenance.fresh_build import BuildError, FreshBuild
from workflow.provenance.job import Job
from workflow.provenance.repository import machine

SOURCES = {"observables/tool.cpp": "a", "model/collision.hpp": "b"}
# In the place of a compiler: the program is its source, and the name of the cache that could have given it.
PROJECT = """
cmake_minimum_required(VERSION 3.20)
project(little NONE)
set(COMPILER_CACHE shared CACHE STRING "")
configure_file(tool.json id/tool.json COPYONLY)
foreach(name tool other)
  add_custom_target(${name} COMMAND ${CMAKE_COMMAND} -E make_directory bin
    COMMAND ${CMAKE_COMMAND} -E cat ${CMAKE_SOURCE_DIR}/${name}.cpp > bin/${name}
    COMMAND ${CMAKE_COMMAND} -E echo ${COMPILER_CACHE} >> bin/${name})
endforeach()
"""
PROGRAM = b"int main() {}\nnone\n"
ELSEWHERE = "another processor"


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    cpp = tmp_path / "cpp"
    cpp.mkdir()
    (cpp / "CMakeLists.txt").write_text(PROJECT)
    (cpp / "tool.cpp").write_text("int main() {}\n")
    (cpp / "tool.json").write_text(json.dumps({"build_id": "id", "sources": SOURCES}))
    (tmp_path / "build/bin").mkdir(parents=True)
    (tmp_path / "build/bin/tool").write_text("something else\n")
    monkeypatch.setattr(fresh_build, "ROOT", tmp_path)
    return tmp_path


def job(outputs: Iterable[str] = (), **differing: Any) -> Job:
    told = {
        "executable": hashlib.sha256(PROGRAM).hexdigest(),
        "build_id": "id",
        "machine": machine(),
        **differing,
    }
    return Job(
        "tool", {}, dict.fromkeys(outputs, ""), {}, commit=None, dirty=None, exit=0, pipeline={}, **told
    )


def test_the_programs_asked_for_are_built_without_cache_or_former_build(project: Path) -> None:
    built = FreshBuild.of(["tool"], project / "fresh")
    assert {path.name: path.read_bytes() for path in built.programs.iterdir()} == {"tool": PROGRAM}


@pytest.mark.parametrize(
    ("made", "sources", "fault"),
    [
        (job(), SOURCES, None),
        (job(), SOURCES | {"model/collision.hpp": "c"}, "cpp/model/collision.hpp is not what tool was built from"),
        (job(), SOURCES | {"model/gone.hpp": "d"}, "cpp/model/gone.hpp is not what tool was built from"),
        (job(), {}, "cpp/model/collision.hpp is not what tool was built from"),
        (job(executable="other"), SOURCES, "the executable that made it is not what its sources give: tool"),
        (job(executable="other", build_id="of another compiler"), SOURCES, None),
        (job(executable="other", machine=ELSEWHERE), SOURCES, None),
    ],
)  # fmt: skip
def test_what_differs_is_named(project: Path, made: Job, sources: dict[str, str], fault: str | None) -> None:
    assert FreshBuild.of(["tool"], project / "fresh").fault(made, {"sources": sources}) == fault


def test_sources_that_give_no_program_are_told(project: Path) -> None:
    (project / "cpp/tool.cpp").unlink()
    with pytest.raises(BuildError, match=r"ninja ended with status 1: .*tool\.cpp"):
        FreshBuild.of(["tool"], project / "fresh")


@pytest.mark.parametrize(
    ("executable", "again", "verdict"),
    [
        ({}, "result", (True, "the same bytes")),
        ({}, "another", (False, "other bytes in out.h5")),
        ({"executable": "other"}, "result", (False, "the executable that made it is not what its sources give: tool")),
    ],
)  # fmt: skip
def test_a_run_is_made_again_by_the_program_that_was_built(
    project: Path, monkeypatch: pytest.MonkeyPatch, executable: dict, again: str, verdict: tuple[bool, str]
) -> None:
    (project / "out.h5").write_text("result")

    def simulate(_: Job, programs: Path, folder: Path) -> Path:
        assert programs == project / "fresh/bin"
        (folder / "again.h5").write_text(again)
        return folder / "again.h5"

    monkeypatch.setattr(verify, "ROOT", project)
    monkeypatch.setattr(verify, "simulate", simulate)
    built = FreshBuild.of(["tool"], project / "fresh")
    made = job(["out.h5"], **executable)
    assert verify.run_verdict(made, built, {"sources": SOURCES}, project) == verdict
