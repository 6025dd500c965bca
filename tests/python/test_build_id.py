"""The build id changes if and only if an input of the build changes."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from workflow.provenance.build_id import built, include_closure

from tests.python.conftest import ROOT
from tests.python.test_mutants import Tree

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


def identify(tree: Path, flags: str = "-O3", version: str = "1") -> dict:
    command = [sys.executable, "-I", str(SCRIPT), "--root", "cpp", "--source", "observables/a.cpp"]
    command += ["--version", version, "--compiler", "g 1", f"--flags={flags}", "--libraries", "l 1"]
    subprocess.run([*command, "--output", "out/a", "--depfile", "out.d"], cwd=tree, check=True)
    return json.loads((tree / "out/a.json").read_text())


def test_closure(tree: Path) -> None:
    expected = ["engine/own.hpp", "engine/x.cpp", "engine/x.hpp", "model/y.hpp", "observables/a.cpp"]
    assert include_closure(tree / "cpp", "observables/a.cpp") == expected


def test_a_source_may_have_bytes_that_are_no_text(tree: Path) -> None:
    """Compilers accept such bytes in comments."""
    before = include_closure(tree / "cpp", "observables/a.cpp")
    with (tree / "cpp/engine/x.hpp").open("ab") as file:
        file.write(b"// caf\xe9\n")
    assert include_closure(tree / "cpp", "observables/a.cpp") == before


def test_a_header_beside_the_source_comes_before_that_of_the_root(tree: Path) -> None:
    """The order of the search is that of the compiler."""
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
    assert (tree / "out/a.json").stat().st_mtime_ns == stamp  # the file was not written again
    assert identify(tree, flags="-O2")["build_id"] != first["build_id"]
    assert identify(tree, version="2")["build_id"] == first["build_id"]  # a release keeps results
    (tree / "cpp/engine/own.hpp").write_text("// changed\n")
    assert identify(tree)["source_hash"] != first["source_hash"]


def test_id_names_no_place(tree: Path) -> None:
    identify(tree)
    for name in ("out/a.json", "out/a.cpp"):
        assert str(tree) not in (tree / name).read_text()


def test_the_libraries_and_definitions_that_change_results_are_named() -> None:
    identity = built("boltzmann")
    libraries = {library.split()[0] for library in identity["libraries"].split(", ")}
    assert libraries == {"CLI11", "Eigen", "HDF5", "Random123", "SLEEF", "fmt"}
    assert "-DEIGEN_DONT_VECTORIZE" in identity["flags"].split()
    assert re.fullmatch(
        r"(GNU|Clang|AppleClang) [0-9.]+", identity["compiler"]
    )  # the name does not contain the processor


def test_another_compiler_or_a_failure_starts_a_new_configuration(tmp_path: Path) -> None:
    def compiler(cxx: str = "") -> str:
        """Name of the compiler in the identity; the message of a failure."""
        environment = {"PATH": os.environ["PATH"], "BUILD": str(tmp_path)} | ({"CXX": cxx} if cxx else {})
        command = ["bash", "workflow/environment/build.sh", "id/persistence.json"]
        done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return done.stderr
        return json.loads((tmp_path / "id/persistence.json").read_text())["compiler"].split()[0]

    usual = compiler()
    clang = compiler("clang++")
    assert clang == "Clang" or (re.search(r"is Clang \d+", clang) and "make build CXX=g++" in clang)
    assert compiler() == usual
    assert "the compiler CXX=no-such-compiler is not installed; install it" in compiler("no-such-compiler")
    assert "compiler identification is unknown" in compiler("true")
    assert compiler() == usual


@pytest.mark.skipif(not shutil.which("ccache"), reason="ccache is not installed")
def test_a_copy_depends_on_its_own_sources(tmp_path: Path) -> None:
    """The copy takes object files of the original, whose path has a space, from ccache, but not its list of dependencies."""
    for name in ("an original", "copy"):
        tree = Tree(tmp_path / name, tmp_path / "cache")
        tree.run("ninja", "-C", "build", "libnumerics.a")
    used = tree.run("env", f"CCACHE_DIR={tmp_path / 'cache'}", "ccache", "--print-stats").stdout
    assert re.search(r"direct_cache_hit\t[1-9]", used)
    source = tree.folder / "cpp/numerics/gmres.cpp"
    source.write_text("#error changed\n" + source.read_text())
    assert "#error changed" in tree.run("ninja", "-C", "build", "libnumerics.a", status=1).stdout


def test_every_source_that_programs_link_is_in_a_closure() -> None:
    """A source file that no header pairs with would be linked without a trace in any build id."""
    cpp = ROOT / "cpp"
    programs = sorted(path.relative_to(cpp).as_posix() for path in cpp.glob("observables/*.cpp"))
    known = set().union(*(include_closure(cpp, program) for program in programs))
    linked = {path.relative_to(cpp).as_posix() for path in cpp.rglob("*.cpp") if path.parent.name != "bench"}
    assert linked == {path for path in known if path.endswith(".cpp")}
    listed = {*re.findall(r"[a-z_]+(?:/\w+)+\.cpp", (cpp / "CMakeLists.txt").read_text())}
    assert listed == linked - {*programs}
