"""The build id changes if and only if an input of the build changes."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from workflow.provenance.build_id import include_closure

SCRIPT = ROOT / "workflow/provenance/build_id.py"

SOURCES = {
    "observables/a.cpp": '#include <vector>\n#include "engine/x.hpp"\nint main() {}\n',
    "engine/x.hpp": '  #  include "model/y.hpp"\n#include "library/z.h"\n',
    "engine/x.cpp": '#include "engine/x.hpp"\n#include "engine/own.hpp"\n',
    "engine/own.hpp": "",
    "model/y.hpp": '#include "engine/x.hpp"\n',  # a cyclic include must not cause an infinite loop
    "model/unused.hpp": "",
}


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    for name, text in SOURCES.items():
        (tmp_path / "cpp" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "cpp" / name).write_text(text)
    return tmp_path


def identify(tree: Path, flags: str = "-O3") -> dict:
    command = [sys.executable, "-I", str(SCRIPT), "--root", "cpp", "--source", "observables/a.cpp"]
    command += ["--version", "1", "--compiler", "g 1", f"--flags={flags}", "--libraries", "l 1"]
    subprocess.run([*command, "--output", "out/a", "--depfile", "out.d"], cwd=tree, check=True)
    return json.loads((tree / "out/a.json").read_text())


def test_closure(tree: Path) -> None:
    expected = ["engine/own.hpp", "engine/x.cpp", "engine/x.hpp", "model/y.hpp", "observables/a.cpp"]
    assert include_closure(tree / "cpp", "observables/a.cpp") == expected


def test_a_source_may_have_bytes_that_are_no_text(tree: Path) -> None:
    """Compilers accept them in comments."""
    before = include_closure(tree / "cpp", "observables/a.cpp")
    with (tree / "cpp/engine/x.hpp").open("ab") as file:
        file.write(b"// caf\xe9\n")
    assert include_closure(tree / "cpp", "observables/a.cpp") == before


def test_a_header_beside_the_source_comes_before_that_of_the_root(tree: Path) -> None:
    """As for the compiler."""
    (tree / "cpp/engine/model").mkdir()
    (tree / "cpp/engine/model/y.hpp").write_text("")
    closure = include_closure(tree / "cpp", "observables/a.cpp")
    assert "engine/model/y.hpp" in closure
    assert "model/y.hpp" not in closure


def test_id_follows_sources_and_flags_only(tree: Path) -> None:
    first = identify(tree)
    stamp = (tree / "out/a.json").stat().st_mtime_ns
    (tree / "cpp/model/unused.hpp").write_text("// changed\n")
    (tree / "cpp/engine/x.hpp").touch()
    assert identify(tree) == first
    assert (tree / "out/a.json").stat().st_mtime_ns == stamp  # not rewritten
    assert identify(tree, flags="-O2")["build_id"] != first["build_id"]
    (tree / "cpp/engine/own.hpp").write_text("// changed\n")
    assert identify(tree)["source_hash"] != first["source_hash"]


def test_id_names_no_place(tree: Path) -> None:
    identify(tree)
    for name in ("out/a.json", "out/a.cpp"):
        assert str(tree) not in (tree / name).read_text()


def test_every_source_that_programs_link_is_in_a_closure() -> None:
    """A source file that no header pairs with would be linked without a trace in any build id."""
    cpp = ROOT / "cpp"
    programs = sorted(path.relative_to(cpp).as_posix() for path in cpp.glob("observables/*.cpp"))
    known = set().union(*(include_closure(cpp, program) for program in programs))
    linked = {path.relative_to(cpp).as_posix() for path in cpp.rglob("*.cpp") if path.parent.name != "bench"}
    assert linked == {path for path in known if path.endswith(".cpp")}
    listed = {*re.findall(r"[a-z_]+(?:/\w+)+\.cpp", (cpp / "CMakeLists.txt").read_text())}
    assert listed == linked - {*programs}
