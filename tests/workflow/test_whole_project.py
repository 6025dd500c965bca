"""Copies of this project with its programs: without the study, and every target of `make help`."""

import re
import shutil
from pathlib import Path

import pytest

from tests.workflow.conftest import ROOT, whole_project

pytestmark = pytest.mark.long


def test_figures_and_tests_without_the_study(smoke: Path, tmp_path: Path) -> None:
    """As of a colleague who needs the figures alone. Detected mistake: something of the order imports the
    study, or names what it has."""
    project = whole_project(tmp_path / "a copy")
    for name in ("build", "data/smoke"):
        shutil.copytree(smoke / name, project.folder / name, symlinks=True, dirs_exist_ok=True)
    for name in ("workflow/study", "tests/study"):
        shutil.rmtree(project.folder / name)
    setup = "workflow/pipeline/environment/setup.sh"
    shutil.copy(ROOT / setup, project.folder / setup)
    before = project.files("data/smoke")
    project.entry("figures")
    assert project.files("data/smoke") == before
    project.run(".venv/bin/python", "-I", "-m", "pytest", "-n", "2", "--dist", "loadfile")


CONFIGURATION = """panels:
  fig05:
    program: persistence
    common: {cells: 4, particles-per-cell: 4, relaxation-time: 1N, observation-time: 5}
    series:
      paper: {sigma: [-0.5, 0.5]}
"""
KEPT = ("numerics", "support", "reference", "build_info.cpp", "CMakeLists.txt")  # of tests/cpp
OF_A_QUALITY = {"figures", "panel", "report", "gallery", "audit", "status", "verify"}
ARGUMENTS = {
    "panel": ["PANEL=fig05"],
    "verify": ["PANEL=fig05"],
    "provenance": ["FILE=figures/smoke/fig05.pdf"],
}


def test_every_target_of_make_help(tmp_path: Path) -> None:
    """In their order, in a copy with one panel, one program and few tests. Detected mistakes: a target
    that does not compile, or calls a former script or option."""
    project = whole_project(tmp_path)
    for path in [*(tmp_path / "cpp/observables").glob("*.cpp"), *(tmp_path / "tests/cpp").iterdir()]:
        if path.name not in (*KEPT, "persistence.cpp"):
            shutil.rmtree(path) if path.is_dir() else path.unlink()
    for path in (tmp_path / "tests").glob("*/test_*.py"):
        if path.name != "test_fit.py":
            path.unlink()
    (tmp_path / "workflow/study/study.yaml").unlink()
    (tmp_path / "workflow/config/paper.yaml").write_text(CONFIGURATION)
    for path in (tmp_path / "workflow/config/quality").iterdir():
        path.write_text("default: {replicas: 4}\n")
    for name in ("clang-format", "ruff", "mypy", "snakefmt"):
        shutil.copy(ROOT / ".venv/bin" / name, tmp_path / ".venv/bin")
    for words in (["init", "--quiet"], ["add", "--all", "--force", "cpp", "tests", "workflow", "Snakefile"]):
        project.run("git", *words)
    targets = re.findall(r"^make (\S+)", project.run("make", "help").stdout, re.MULTILINE)
    assert {"figures", "verify", "test", "clean"} <= {*targets}
    # The gallery first: reports state its numbers.
    for target in sorted(targets, key=lambda one: one != "gallery"):
        project.run("make", target, *ARGUMENTS.get(target, []), *["QUALITY=smoke"] * (target in OF_A_QUALITY))
