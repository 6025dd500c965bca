"""Mistakes that tests in C++ must find: each patch of tests/mutants is applied to a copy of the sources,
whose tests then fail. Its first line states the mistake and, after a semicolon, the source and the names of
the tests.

The copy is built once in a folder of its own; for a patch only what it changes is compiled.
"""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.python.conftest import ROOT

PATCHES = sorted((ROOT / "tests/mutants").glob("*.patch"))
HEAD = re.compile(r"(?P<mistake>.+); (?P<source>\S+_test\.cpp) (?P<tests>\S+)")
FAILED = "[  FAILED  ] "


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


def test_every_patch_applies() -> None:
    subprocess.run(["git", "apply", "--check", *PATCHES], cwd=ROOT, check=True)


@pytest.mark.long
@pytest.mark.parametrize("patch", PATCHES, ids=lambda patch: patch.stem)
def test_the_mistake_is_found(tree: Tree, patch: Path) -> None:
    tree.run("git", "apply", str(patch))
    try:
        done = tree.test(head(patch)["tests"])
    finally:
        tree.run("git", "apply", "--reverse", str(patch))
    assert done.returncode == 1, f"no test finds {head(patch)['mistake']}"
    assert FAILED in done.stdout, done.stdout + done.stderr
