import os
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

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

    def products(self) -> dict[str, bytes]:
        """Data and figures by path."""
        files = [path for place in ("data", "figures") for path in (self.folder / place).rglob("*")]
        return {str(path.relative_to(self.folder)): path.read_bytes() for path in files if path.is_file()}


def clone_into(folder: Path) -> Clone:
    tracked = subprocess.check_output(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, text=True
    )
    for name in filter(None, tracked.split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, folder / name)
    shutil.copytree(ROOT / ".venv", folder / ".venv", copy_function=os.link, symlinks=True)
    for stamp in ("runtime", "dev"):  # newer than the copied locks
        (folder / ".venv" / stamp).unlink()
        (folder / ".venv" / stamp).touch()
    return Clone(folder)


@pytest.fixture(scope="session")
def clean(tmp_path_factory: pytest.TempPathFactory) -> Clone:
    """Built and drawn once, at smoke quality, in a quiet environment."""
    clone = clone_into(tmp_path_factory.mktemp("clean"))
    made = clone.make("figures", "QUALITY=smoke")
    assert made.returncode == 0, made.stdout
    return clone


@pytest.fixture(scope="module")
def packed(clean: Clone) -> Iterator[Clone]:
    """With the cheap panel and its crate; without them afterwards."""
    for target in ("panel", "crate"):
        made = clean.make(target, *CHEAP)
        assert made.returncode == 0, made.stdout
    yield clean
    for place in ("data/standard", "figures/standard", "build/crate"):
        shutil.rmtree(clean.folder / place)
