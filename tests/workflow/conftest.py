"""A small project of two panels and four short runs, for tests that change it."""

import multiprocessing
import os
import re
import runpy
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from workflow.lib.identity import IDENTITY
from workflow.pipeline import audit, verify

ROOT = Path(__file__).parents[2]
# Imported here, so that each fork has them and what they import already.
PACKAGES = (audit, verify)
PLAN = """panels:
  mu:
    program: persistence
    common: {cells: 4, particles-per-cell: 4, relaxation-time: 1N, observation-time: 5}
    series:
      all: {sigma: [-0.5, 0.5]}
  energy:
    uses: [mu]
    series:
      ageing: {program: displacement, cells: 4, particles-per-cell: 4, observation-time: 5}
      few: {program: displacement, cells: 4, particles-per-cell: 2, observation-time: 5}
"""
SCRIPT = '''"""A panel of a test."""

import matplotlib.pyplot as plt
import pandas as pd

TITLE = "A panel, $t^{2}$"


def draw(results):
    figure, _ = plt.subplots()
    return figure, pd.DataFrame({"replicas": [result.replicas for result in results]}), "A test."
'''
EFFORT = "default: {replicas: 4}\npanels:\n  energy: {replicas: 4}\n"
PRODUCT = re.compile(rf"([^/\s]+/[^/\s]+)\.{IDENTITY}\.(h5|json)")
Done = subprocess.CompletedProcess[str]


@dataclass
class Project:
    """A folder with sources, programs and environment of this project, and a plan of its own."""

    folder: Path

    def run(self, *command: str | Path, status: int = 0, **environment: str) -> Done:
        """Runs a command with PATH and the variables given."""
        done = subprocess.run(
            command,
            cwd=self.folder,
            env=plain() | environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        assert done.returncode == status, done.stdout
        return done

    def workflow(self, *words: str, status: int = 0, path: str = os.environ["PATH"]) -> str:
        """Output of `python -m workflow`, in a fork of this process, which has imported the packages: 0.1
        s in place of 2 s."""
        with tempfile.TemporaryFile("w+") as output:
            arguments = (self.folder, words, output.fileno(), plain() | {"PATH": path})
            fork = multiprocessing.get_context("fork").Process(target=_workflow, args=arguments)
            fork.start()
            fork.join()
            output.seek(0)
            printed = output.read()
        assert fork.exitcode == status, printed
        return printed

    def entry(self, *words: str, status: int = 0) -> str:
        """Output of a target at smoke quality."""
        return self.workflow(*words, "QUALITY=smoke", status=status)

    def snakemake(self, *words: str, status: int = 0, **environment: str) -> str:
        """Output of a bare snakemake."""
        command = (".venv/bin/snakemake", *words, "--config", "quality=smoke")
        return self.run(*command, status=status, **environment).stdout

    def stale(self) -> set[str]:
        """What would be made: `panel/run` or `panel`."""
        return named(self.entry("figures", "DRY=yes"))

    def files(self, *folders: str) -> dict[str, bytes]:
        """Content by path."""
        paths = [path for folder in folders for path in (self.folder / folder).rglob("*") if path.is_file()]
        return {str(path.relative_to(self.folder)): path.read_bytes() for path in paths}

    def products(self) -> dict[str, bytes]:
        """Results and figures, without records, which have the commit."""
        files = self.files("data/smoke", "figures/smoke")
        return {path: content for path, content in files.items() if not path.endswith((".json", ".log"))}

    def one(self, pattern: str) -> Path:
        (path,) = self.folder.glob(pattern)
        return path

    def edit(self, path: str, change: Callable[[str], str]) -> None:
        before = (self.folder / path).read_text()
        assert change(before) != before
        (self.folder / path).write_text(change(before))


def plain() -> dict[str, str]:
    """Environment of a command."""
    return {"PATH": os.environ["PATH"], "HOME": os.environ.get("HOME", "/")}


def _workflow(folder: Path, words: tuple[str, ...], output: int, environment: dict[str, str]) -> None:
    """Executes the entry of the project in a folder, with its own modules."""
    for descriptor in (1, 2):
        os.dup2(output, descriptor)
    sys.stdout, sys.stderr = (os.fdopen(descriptor, "w", buffering=1) for descriptor in (1, 2))
    os.environ.clear()
    os.environ.update(environment)
    os.chdir(folder)
    for name in [name for name in sys.modules if name.startswith("workflow")]:
        del sys.modules[name]
    sys.path.insert(0, str(folder))
    sys.argv = ["workflow", *words]
    runpy.run_module("workflow", run_name="__main__", alter_sys=True)


def named(text: str) -> set[str]:
    """Results and figures that a text names: `panel/run` or `panel`."""
    return {name if kind == "h5" else name.partition("/")[2] for name, kind in PRODUCT.findall(text)}


def new_project(folder: Path) -> Project:
    ignored = shutil.ignore_patterns("__pycache__", "config", "[ef]*[0-9]*.py", "study.yaml")
    for name in ("workflow", "cpp", "profiles"):
        shutil.copytree(ROOT / name, folder / name, ignore=ignored)
    for name in ("Snakefile", "Makefile", "uv.lock", "CITATION.cff"):
        shutil.copy(ROOT / name, folder / name)
    (folder / "data").mkdir()
    (folder / "workflow/config/quality").mkdir(parents=True)
    (folder / "workflow/config/paper.yaml").write_text(PLAN)
    for quality in ("smoke", "standard", "paper"):
        (folder / f"workflow/config/quality/{quality}.yaml").write_text(EFFORT)
    for panel in ("mu", "energy"):
        (folder / f"workflow/figures/{panel}.py").write_text(SCRIPT)
    (folder / "build/bin").mkdir(parents=True)
    for source in (folder / "cpp/observables").glob("*.cpp"):
        if source.stem in ("persistence", "displacement"):
            (folder / "build/bin" / source.stem).symlink_to(ROOT / "build/bin" / source.stem)
        else:
            source.unlink()
    for script in ("setup.sh", "build.sh"):  # the programs are those of this project
        (folder / "workflow/pipeline/environment" / script).write_text("exit 0\n")
    share_packages(folder)
    (folder / ".cache").mkdir()
    (ROOT / ".cache/matplotlib").mkdir(parents=True, exist_ok=True)
    (folder / ".cache/matplotlib").symlink_to(ROOT / ".cache/matplotlib")  # its table of fonts
    return Project(folder)


def whole_project(folder: Path) -> Project:
    """A copy of this project without results and programs, which shares packages."""
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    for name in filter(None, subprocess.check_output(command, cwd=ROOT, text=True).split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / name)
    share_packages(folder)
    (folder / "build").mkdir()
    (folder / "workflow/pipeline/environment/setup.sh").write_text("exit 0\n")
    return Project(folder)


def share_packages(folder: Path) -> None:
    """An environment with the interpreter and the packages of this one, that imports the modules of the
    folder."""
    (folder / ".venv/bin").mkdir(parents=True)
    (folder / ".venv/bin/python").symlink_to(Path(sys.executable).resolve())
    (folder / ".venv/lib").symlink_to(ROOT / ".venv/lib")
    for name in ("pyvenv.cfg", "bin/snakemake"):
        shutil.copy(ROOT / ".venv" / name, folder / ".venv" / name)


@pytest.fixture(scope="session")
def made(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The small project with its figures. Its path has a space. Not to be changed."""
    project = new_project(tmp_path_factory.mktemp("a project"))
    project.entry("figures")
    return project


@pytest.fixture
def project(made: Project, tmp_path: Path) -> Project:
    """A copy of the small project with its figures."""
    return Project(Path(shutil.copytree(made.folder, tmp_path / "a copy", symlinks=True)))
