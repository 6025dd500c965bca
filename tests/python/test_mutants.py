"""Mistakes that tests must find: each patch of tests/mutants, or of a folder `mutants` beside tests of
Python, is
applied to a copy of the sources, whose tests then fail. Its first line states the mistake and, after a
semicolon, the source and the names of the C++ tests, or the file and the name of a test of Python.

The copy is built once in a folder of its own; for a patch only what it changes is compiled.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.python.conftest import ROOT

PATCHES = sorted((ROOT / "tests/mutants").glob("*.patch"))
PYTHON_PATCHES = sorted((ROOT / "tests").glob("*/mutants/*.patch"))
HEAD = re.compile(r"(?P<mistake>.+); (?P<source>\S+_test\.cpp|test_\w+\.py) (?P<tests>\S+)")
FAILED = "[  FAILED  ] "

pytestmark = pytest.mark.long


def head(patch: Path) -> re.Match[str]:
    found = HEAD.fullmatch(patch.read_text().partition("\n")[0])
    assert found, f"{patch.name}: its first line is not 'mistake; source tests'"
    return found


class Tree:
    """A copy of the C++ sources with a build of the tests that the patches name."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name in ("cpp", "tests/cpp"):
            shutil.copytree(ROOT / name, folder / name)
        shutil.copy(ROOT / "pyproject.toml", folder)
        (folder / "workflow/pipeline").mkdir(parents=True)
        shutil.copy(ROOT / "workflow/pipeline/sources.py", folder / "workflow/pipeline")
        tests = ";".join(sorted({head(patch)["source"] for patch in PATCHES}))
        self.run("cmake", "-S", "cpp", "-B", "build", "-G", "Ninja", f"-DTESTS={tests}")

    def run(self, *command: str, status: int | None = 0) -> subprocess.CompletedProcess[str]:
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        assert status in (None, done.returncode), done.stdout + done.stderr
        return done

    def test(self, names: str) -> subprocess.CompletedProcess[str]:
        """Builds and runs the tests."""
        self.run("ninja", "-C", "build", "--quiet", "cpp_tests")
        return self.run("build/bin/cpp_tests", f"--gtest_filter={names}", "--gtest_brief=1", status=None)


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Tree:
    """Copy of the sources, whose tests pass without a patch."""
    tree = Tree(tmp_path_factory.mktemp("mutants"))
    done = tree.test(":".join(head(patch)["tests"] for patch in PATCHES))
    assert done.returncode == 0, done.stdout
    return tree


@pytest.mark.parametrize("patch", PATCHES, ids=lambda patch: patch.stem)
def test_the_mistake_is_found(tree: Tree, patch: Path) -> None:
    tree.run("git", "apply", str(patch))
    try:
        done = tree.test(head(patch)["tests"])
    finally:
        tree.run("git", "apply", "--reverse", str(patch))
    assert done.returncode == 1, f"no test finds {head(patch)['mistake']}"
    assert FAILED in done.stdout, done.stdout + done.stderr


@pytest.mark.parametrize("patch", PYTHON_PATCHES, ids=lambda patch: patch.stem)
def test_the_mistake_in_python_is_found(patch: Path, tmp_path: Path) -> None:
    mistake, source, test = head(patch).groups()
    for name in ("workflow", "tests", "cpp"):
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        (tmp_path / name).parent.mkdir(exist_ok=True)
        copy(ROOT / name, tmp_path / name)
    (tmp_path / "build").mkdir()
    (tmp_path / "build/bin").symlink_to(ROOT / "build/bin")  # tests read what the programs declare
    command = [sys.executable, "-m", "pytest", "-q", patch.parents[1].relative_to(ROOT) / source, "-k", test]
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}

    def run() -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )

    done = run()
    assert done.returncode == 0, f"{test} fails without the mistake: {done.stdout}"
    subprocess.run(["git", "apply", "--unsafe-paths", "-p1", patch], cwd=tmp_path, check=True)
    done = run()
    assert done.returncode == 1, f"no test finds that {mistake}: {done.stdout}"
    assert re.search(rf"^FAILED .*::{test}\b", done.stdout, re.MULTILINE), done.stdout
