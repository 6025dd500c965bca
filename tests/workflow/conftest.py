import contextlib
import fcntl
import json
import os
import shutil
import subprocess
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import pytest

from workflow.lib.parents import file_hash

ROOT = Path(__file__).parents[2]
CHEAP = ("PANEL=fig03", "QUALITY=standard")  # a second, at a quality that is packed


@dataclass
class Clone:
    """A copy of the tracked files in a folder of its own, with the installed Python packages linked."""

    folder: Path

    def make(self, *arguments: str, environment: dict[str, str] | None = None) -> subprocess.CompletedProcess:
        plain = {"PATH": os.defpath, "HOME": os.environ.get("HOME", "/")}
        return subprocess.run(
            ["/usr/bin/make", *arguments],
            cwd=self.folder,
            env=plain if environment is None else environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=900,
            check=False,
        )

    def git(self, *arguments: str) -> None:
        author = ["-c", "user.name=Nobody", "-c", "user.email=nobody@example.org"]
        day = {"GIT_COMMITTER_DATE": "2011-02-03T23:30:00-0500", "PATH": os.defpath}
        subprocess.run(["git", *author, *arguments], cwd=self.folder, env=day, check=True)

    def commit(self) -> None:
        self.git("add", "--all")
        self.git("commit", "--quiet", "--allow-empty", "--message", "all")

    def products(self) -> dict[str, bytes]:
        """Data and figures by path, without the lock, which names the commit, and what is tracked."""
        files = [path for place in ("data", "figures") for path in (self.folder / place).rglob("*")]
        return {
            str(path.relative_to(self.folder)): path.read_bytes()
            for path in files
            if path.is_file() and path.name not in ("lock.json", "README.md", "claims.csv")
        }


def clone_into(folder: Path, source: Path = ROOT) -> Clone:
    tracked = subprocess.check_output(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=source, text=True
    )
    for name in filter(None, tracked.split("\0")):
        if (source / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source / name, folder / name)
    # Copies, as every hard link would change the time of change by which changed packages are noticed.
    shutil.copytree(ROOT / ".venv", folder / ".venv", symlinks=True)
    share_objects(folder)
    return Clone(folder)


def configure(folder: Path) -> None:
    """With the project's own objects: nothing is compiled twice."""
    cache = f"-DCOMPILER_CACHE={ROOT / 'build/ccache'}"
    run_silently(folder, "cmake", "-S", "cpp", "-B", "build", "-G", "Ninja", cache)


def share_objects(folder: Path) -> None:
    """Has a clone configured as make would find it, so that it does not configure again without the shared objects."""
    by_content = ["python3", "-I", "workflow/environment/launch.py", "workflow.environment.build_by_content"]
    (folder / "build").mkdir(exist_ok=True)
    run_silently(folder, *by_content)
    configure(folder)
    run_silently(folder, *by_content, "--built")


def run_silently(folder: Path, *command: str) -> None:
    subprocess.run(command, cwd=folder, env={"PATH": os.defpath}, check=True, stdout=subprocess.DEVNULL)


@contextlib.contextmanager
def locked(path: Path) -> Iterator[None]:
    with path.open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


MADE = ("data/smoke", "figures/smoke", ".snakemake", "build/logs", "build/costs", "build/benchmarks")


def copy_made(source: Path, target: Path) -> None:
    """Products and what is known of their jobs; not the report, which no figure needs."""
    for place in MADE:
        if (source / place).is_dir():
            without = shutil.ignore_patterns("report.*")
            shutil.copytree(source / place, target / place, dirs_exist_ok=True, ignore=without)


def made_as_now() -> bool:
    """Whether all products of the project were made by the pipeline that is there now, from what was committed."""
    try:
        jobs = json.loads((ROOT / "data/smoke/lock.json").read_text())["jobs"].values()
        used = {item for job in jobs for item in job["pipeline"].items()}
        return not any(job["dirty"] for job in jobs) and all(
            file_hash(ROOT / path) == own for path, own in used
        )
    except (OSError, ValueError, KeyError):
        return False


def drawn_into(folder: Path) -> Clone:
    """The project as it stands, its changes committed, with the figures that it has, if they were made as they would be now.
    Those that are missing or stale are made."""
    subprocess.run(["git", "clone", "--quiet", "--no-checkout", ROOT, folder], check=True)
    clone = clone_into(folder)
    clone.commit()
    if made_as_now():
        copy_made(ROOT, folder)
    made = clone.make("figures", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout
    return clone


@pytest.fixture(scope="session")
def clean(tmp_path_factory: pytest.TempPathFactory) -> Clone:
    """A repository with nothing to commit, built, with every figure at smoke quality. Of processes that run tests beside each
    other the first draws, and the others copy."""
    own, folder = tmp_path_factory.getbasetemp(), tmp_path_factory.mktemp("clean")
    drawn = (own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / "drawn"
    with locked(drawn.with_suffix(".lock")):
        if not drawn.exists():
            clone = drawn_into(folder)
            shutil.copytree(folder / ".git", drawn / ".git")
            copy_made(folder, drawn)
            return clone
    clone = clone_into(folder)
    shutil.copytree(drawn / ".git", folder / ".git")
    copy_made(drawn, folder)
    assert clone.make("build").returncode == 0
    return clone


@pytest.fixture
def kept(clean: Clone) -> Iterator[Clone]:
    """The clean clone, with sources, products and Snakemake's notes on them as they were when the test is over."""
    places = ("data", "figures", "workflow", "profiles", "cpp", "docs", "README.md", "requirements.lock")
    places += (".snakemake/metadata",)
    folders = folders_below(clean.folder, places)
    before = {file: file.read_bytes() for place in places for file in files_below(clean.folder / place)}
    yield clean
    for file in {file for place in places for file in files_below(clean.folder / place)} - before.keys():
        file.unlink()
    for file, content in before.items():
        if not file.exists() or file.read_bytes() != content:
            file.write_bytes(content)
    for folder in sorted(folders_below(clean.folder, places) - folders, reverse=True):
        folder.rmdir()


def folders_below(root: Path, places: Iterable[str]) -> set[Path]:
    return {folder for place in places for folder in (root / place).rglob("*") if folder.is_dir()}


def files_below(place: Path) -> list[Path]:
    return [file for file in (place, *place.rglob("*")) if file.is_file()]


Edit = Callable[[Clone], object]  # something done to a clone


def side_by_side(concerned: Mapping[str, Iterable[str]]) -> list[list[str]]:
    """Names in few groups, so that what those of a group concern is disjoint and can be told apart when all are done at
    once. One by one they are done by the long tests."""
    groups: list[tuple[list[str], set[str]]] = []
    for name, concerns in concerned.items():
        names, taken = next((group for group in groups if group[1].isdisjoint(concerns)), ([], set()))
        if not names:
            groups.append((names, taken))
        names.append(name)
        taken.update(concerns)
    return [names for names, _ in groups]


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


@pytest.fixture(scope="module")
def packed(clean: Clone) -> Iterator[Clone]:
    """With the cheap panel and its crate; without them afterwards."""
    for target in ("panel", "crate"):
        made = clean.make(target, *CHEAP)
        assert made.returncode == 0, made.stdout
    yield clean
    for place in ("data/standard", "figures/standard", "build/crate"):
        shutil.rmtree(clean.folder / place)
