"""Copies of the project in folders of their own, with every figure at smoke quality, for tests that change them."""

import contextlib
import fcntl
import os
import re
import shutil
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from workflow.lib.record import records_of

from workflow.identity import IDENTITY

ROOT = Path(__file__).parents[2]
MADE = ("data/smoke", "figures/smoke", "build/bin", "build/id")
NETWORK = re.compile(r"SSL_CERT_|UV_|PIP_|(https?|all|no)_proxy$", re.IGNORECASE)
OUTPUT = re.compile(rf"^\s*output: \w+/\w+/(.*)\.{IDENTITY}\.\w+$", re.MULTILINE)
Done = subprocess.CompletedProcess[str]


@dataclass
class Clone:
    """A copy of the project with an environment of its own."""

    folder: Path

    def run(self, *command: str, status: int | None = 0, **environment: str) -> Done:
        """Runs a command with PATH, HOME and the variables given. status: the expected one, None for any."""
        network = {name: value for name, value in os.environ.items() if NETWORK.match(name)}
        plain = {
            "PATH": f"{os.defpath}:{ROOT / '.cache/uv/bin'}",
            "HOME": os.environ.get("HOME", "/"),
        } | network
        done = subprocess.run(
            command,
            cwd=self.folder,
            env=plain | environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=900,
            check=False,
        )
        assert status in (None, done.returncode), done.stdout
        return done

    def make(self, *arguments: str, status: int | None = 0, **environment: str) -> Done:
        return self.run("/usr/bin/make", *arguments, status=status, **environment)

    def snakemake(self, *arguments: str, status: int | None = 0) -> str:
        """Output of snakemake, called without make."""
        command = (".venv/bin/snakemake", *arguments, "--config", "quality=smoke")
        return self.run(*command, status=status, TERM="dumb").stdout

    def module(self, name: str, *arguments: str, status: int | None = 0) -> str:
        """Output of `python -m workflow.NAME`."""
        return self.run(".venv/bin/python", "-P", "-m", f"workflow.{name}", *arguments, status=status).stdout

    def stale(self, target: str = "figures") -> set[str]:
        """Jobs that would run, as `panel/run` or `panel`."""
        return {*OUTPUT.findall(self.snakemake("--dry-run", target))}

    def stale_path(self, panel: str) -> str:
        """Path of the record that a stale panel will have."""
        listed = self.snakemake("--dry-run", "figures")
        (path,) = {*re.findall(rf"output: (figures/smoke/{panel}\.{IDENTITY}\.json)", listed)}
        return path

    def result(self, run: str) -> str:
        """Path of the result of `panel/run`, of which there is one."""
        found = [
            path
            for path in self.products()
            if re.fullmatch(rf"data/smoke/{re.escape(run)}\.{IDENTITY}\.h5", path)
        ]
        assert len(found) == 1
        return found[0]

    def record(self, panel: str) -> str:
        (path,) = records_of(self.folder / "figures/smoke" / panel)
        return str(path.relative_to(self.folder))

    def git(self, *arguments: str) -> None:
        author = ["-c", "user.name=Nobody", "-c", "user.email=nobody@example.org"]
        subprocess.run(["git", *author, *arguments], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)

    def commit(self) -> None:
        self.git("add", "--all")
        self.git("commit", "--quiet", "--allow-empty", "--message", "all")

    def keep_only(self, *panels: str) -> None:
        """Deletes results and figures of the other panels, as a check renders every panel again."""
        for path in [*self.folder.glob("data/smoke/*"), *self.folder.glob("figures/smoke/*.*")]:
            if path.name.partition(".")[0] not in panels:
                shutil.rmtree(path) if path.is_dir() else path.unlink()

    def products(self) -> dict[str, bytes]:
        """Content of results and figures by path."""
        files = [
            path for folder in ("data/smoke", "figures/smoke") for path in (self.folder / folder).rglob("*")
        ]
        return {
            str(path.relative_to(self.folder)): path.read_bytes()
            for path in files
            if path.is_file() and not path.name.endswith(".cost.json") and path.parent.name != "report"
        }


def clone_into(folder: Path, source: Path = ROOT) -> Clone:
    """The tracked and the new files of a project, without a repository, and its packages."""
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    for name in filter(None, subprocess.check_output(command, cwd=source, text=True).split("\0")):
        if (source / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source / name, folder / name)
    clone = Clone(folder)
    clone.run("bash", "workflow/environment/setup.sh", "dev")
    return clone


def share_build(clone: Clone) -> None:
    """Shares the compiler's cache of the project, so that make build compiles nothing twice."""
    if not (clone.folder / "build/ccache").exists() and (ROOT / "build/ccache").is_dir():
        (clone.folder / "build").mkdir(exist_ok=True)
        (clone.folder / "build/ccache").symlink_to(ROOT / "build/ccache")


def copy_made(source: Path, target: Path) -> None:
    for folder in MADE:
        if (source / folder).is_dir():
            without = shutil.ignore_patterns("report.*", "cpp_tests", "benchmarks", "reference_*")
            shutil.copytree(source / folder, target / folder, dirs_exist_ok=True, ignore=without)


@contextlib.contextmanager
def locked(path: Path) -> Iterator[None]:
    with path.open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


@pytest.fixture(scope="session")
def clean(tmp_path_factory: pytest.TempPathFactory) -> Clone:
    """A repository with nothing to commit and every figure at smoke quality. The first worker makes the missing products, and
    the others copy them."""
    folder = tmp_path_factory.mktemp("clean")
    own = tmp_path_factory.getbasetemp()
    shared = (own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / "made"
    clone = clone_into(folder)
    clone.git("init", "--quiet")
    clone.commit()
    with locked(shared.with_suffix(".lock")):
        copy_made(shared if shared.exists() else ROOT, folder)
        if not shared.exists():
            clone.snakemake("figures")
            clone.module("provenance.obsolete", "--quality", "smoke")
            copy_made(folder, shared)
    return clone


@pytest.fixture
def kept(clean: Clone) -> Iterator[Clone]:
    """The clean clone. Sources and products are restored after the test."""
    folders = (
        "data",
        "figures",
        "workflow",
        "profiles",
        "cpp",
        "docs",
        "README.md",
        "codecheck.yml",
        "uv.lock",
        "build/id",
    )
    before = {
        file: (file.read_bytes(), file.stat().st_mtime_ns)
        for folder in folders
        for file in files_below(clean.folder / folder)
    }
    yield clean
    for file in {file for folder in folders for file in files_below(clean.folder / folder)} - before.keys():
        file.unlink()
    for file, (content, time) in before.items():
        if not file.exists() or file.read_bytes() != content:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)
        os.utime(file, ns=(time, time))


def files_below(path: Path) -> list[Path]:
    return [file for file in (path, *path.rglob("*")) if file.is_file() and "__pycache__" not in file.parts]


Edit = Callable[[Clone], object]  # changes a clone


def append(path: str, text: str) -> Edit:
    def edit(clone: Clone) -> None:
        assert (clone.folder / path).is_file()
        with (clone.folder / path).open("a") as file:
            file.write(text)

    return edit


def replace(path: str, old: str, new: str) -> Edit:
    def edit(clone: Clone) -> None:
        text = (clone.folder / path).read_text()
        assert old in text
        (clone.folder / path).write_text(text.replace(old, new, 1))

    return edit


def copy(source: str, target: str) -> Edit:
    return lambda clone: shutil.copyfile(clone.folder / source, clone.folder / target)


def delete(path: str) -> Edit:
    return lambda clone: (clone.folder / path).unlink()


def delete_result(run: str) -> Edit:
    return lambda clone: (clone.folder / clone.result(run)).unlink()
