"""Identities change with what determines a product, and with nothing else."""

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from workflow.identity import code, named_identity, source_hash, stated, statement

PROGRAMS = sorted(path.stem for path in (ROOT / "cpp/observables").glob("*.cpp"))


def test_comments_are_removed_as_by_the_preprocessor() -> None:
    sources = sorted(path for kind in ("*.cpp", "*.hpp") for path in (ROOT / "cpp").rglob(kind))
    preprocess = ["c++", "-fpreprocessed", "-dD", "-E", "-P", "-x", "c++"]
    expected = subprocess.run([*preprocess, *sources], capture_output=True, text=True, check=True).stdout
    found = "".join(code(path.read_text(), path.name) for path in sources)
    assert len(found) > 300_000
    bare, preprocessed = ("".join(each.split()).replace("#pragmaonce", "") for each in (found, expected))
    assert bare == preprocessed


@pytest.mark.parametrize(
    ("text", "bare"),
    [
        ("a; // b\n\n\nc;", "a;\nc;"),
        ("a; /* b\n */ c;", "a;   c;"),
        ('"// a" \'"\' // b', '"// a" \'"\''),
        ("1'000; // it's", "1'000;"),
        ('R"x(/* " */)x" /* a */ b', 'R"x(/* " */)x"   b'),
    ],
)
def test_code_is_a_source_without_comments_and_empty_lines(text: str, bare: str) -> None:
    assert code(text, "a.cpp") == bare


@pytest.fixture
def cpp(tmp_path: Path) -> Path:
    return Path(shutil.copytree(ROOT / "cpp", tmp_path / "cpp"))


@pytest.mark.parametrize(
    ("path", "text", "of"),
    [
        ("statistics/fit.hpp", "int x;\n", {*PROGRAMS}),
        ("statistics/fit.hpp", "// caf\udce9\n", set()),
        ("flags.cmake", "set(X -Ofast)\n", {*PROGRAMS}),
        ("CMakeLists.txt", "set(X)\n", set()),
        ("bench/event_benchmark.cpp", "int x;\n", set()),
        ("observables/correlation/sound_peak.hpp", "int x;\n", {"correlation"}),
        ("observables/mine.cpp", "int main() {}\n", {"mine"}),
        ("program/.hpp.swp", "x", set()),
    ],
)
def test_a_change_of_a_source(cpp: Path, path: str, text: str, of: set[str]) -> None:
    with (cpp / path).open("a", errors="surrogateescape") as file:
        file.write(text)
    present = {
        program for program in (*PROGRAMS, "mine") if source_hash(program, cpp) != source_hash(program)
    }
    assert present - {"mine"} == of - {"mine"}


def test_the_hash_of_the_sources_is_written_only_if_it_changes(cpp: Path, tmp_path: Path) -> None:
    (tmp_path / "template").write_text('"SOURCE_HASH"')
    command = ["python3", "-I", ROOT / "workflow/identity.py", cpp, tmp_path]
    subprocess.run(command, check=True)
    written = tmp_path / "ageing.cpp"
    assert written.read_text() == f'"{source_hash("ageing")}"'
    before = written.stat().st_mtime_ns
    subprocess.run(command, check=True)
    assert written.stat().st_mtime_ns == before


def test_identities_in_names_and_statements() -> None:
    assert named_identity("data/smoke/fig05/a_sigma=0.5.0123456789ab.h5") == "0123456789ab"
    assert named_identity("build/figures/smoke/fig05.0123456789ab") == "0123456789ab"
    assert named_identity("fig05.pdf") == named_identity("a.0123456789abc.h5") == ""
    line = statement("fig05", "smoke_error=0.01", "0123456789ab")
    assert stated(b"<x>" + line.encode() + b"</x>") == ("fig05", "smoke_error=0.01", "0123456789ab")
    assert stated(b"a picture") is None
