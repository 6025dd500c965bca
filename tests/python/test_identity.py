"""Identities change with what determines a product, and with nothing else."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from workflow.pipeline.sources import code, determines, source_hash

PROGRAMS = sorted(path.stem for path in (ROOT / "cpp/observables").glob("*.cpp"))
SAMPLED = {*PROGRAMS} - {"boltzmann"}


def test_comments_are_removed_as_by_the_preprocessor() -> None:
    sources = sorted(path for kind in ("*.cpp", "*.hpp") for path in (ROOT / "cpp").rglob(kind))
    preprocess = ["c++", "-fpreprocessed", "-dD", "-E", "-P", "-x", "c++"]
    expected = subprocess.run([*preprocess, *sources], capture_output=True, text=True, check=True).stdout
    found = "".join(code(path.read_text(), path.name) for path in sources)
    assert len(found) > 300_000
    bare, preprocessed = ("".join(each.split()).replace("#pragmaonce", "") for each in (found, expected))
    assert bare == preprocessed


@pytest.mark.parametrize("program", PROGRAMS)
def test_all_that_a_program_includes_is_in_its_hash(program: str) -> None:
    """Also what is in the .cpp beside an included header."""
    cpp = ROOT / "cpp"
    included: set[str] = set()
    found = {f"observables/{program}.cpp"}
    while found:
        path = found.pop()
        included.add(path)
        headers = re.findall(r'#include "([^"]+)"', (cpp / path).read_text())
        both = {*headers, *(header.replace(".hpp", ".cpp") for header in headers)}
        found |= {path for path in both if (cpp / path).exists()} - included
    assert all(determines(path, program) for path in included)


@pytest.mark.parametrize(
    "line", ["target_compile_options(displacement PRIVATE -Ofast)", 'set(CMAKE_CXX_FLAGS "-mfma")']
)
def test_flags_that_are_in_no_identity_are_refused(cpp: Path, line: str) -> None:
    with (cpp / "CMakeLists.txt").open("a") as file:
        file.write(f"{line}\n")
    configure = ["cmake", "-S", cpp, "-B", cpp / "build"]
    done = subprocess.run(configure, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "move it to cpp/flags.cmake" in " ".join(done.stderr.split())


@pytest.fixture
def cpp(tmp_path: Path) -> Path:
    return Path(shutil.copytree(ROOT / "cpp", tmp_path / "cpp"))


@pytest.mark.parametrize(
    ("path", "text", "of"),
    [
        ("flags.cmake", "set(X -Ofast)\n", {*PROGRAMS}),
        ("CMakeLists.txt", "set(X)\n", set()),
        ("observables/heat_current/currents.hpp", "int x;\n", {"heat_current"}),
        ("boltzmann/solver.cpp", "int x;\n", {"boltzmann"}),
        ("model/rules/mine.hpp", "int x;\n", SAMPLED),
        ("observables/mine.cpp", "int main() {}\n", set()),
    ],
)
def test_source_hash_changes_for_the_programs_that_use_a_source(
    cpp: Path, path: str, text: str, of: set[str]
) -> None:
    with (cpp / path).open("a") as file:
        file.write(text)
    assert {program for program in PROGRAMS if source_hash(program, cpp) != source_hash(program)} == of
