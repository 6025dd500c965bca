"""What lies where make is going to write is told in one line, and nothing is moved or made."""

import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.workflow.conftest import Clone

FRESH = ("panel", "PANEL=fig03", "QUALITY=smoke", "FRESH=yes")


@pytest.fixture
def elsewhere(tmp_path: Path) -> Iterator[Path]:
    """A folder on another disk, if there is one here."""
    memory = Path("/dev/shm")
    if not memory.is_dir() or memory.stat().st_dev == tmp_path.stat().st_dev:
        pytest.skip("there is no other disk")
    with tempfile.TemporaryDirectory(dir=memory) as folder:
        yield Path(folder)


@pytest.mark.parametrize(
    ("path", "make", "words"),
    [
        ("data/smoke/fig03", lambda path: path.symlink_to("fig05"), "a link lies where a folder belongs"),
        ("data/smoke/fig03", Path.touch, "a file lies where a folder belongs"),
        ("figures/smoke", Path.touch, "a file lies where a folder belongs"),
        (".snakemake", Path.touch, "a file lies where a folder belongs"),
        (".snakemake/metadata", Path.touch, "a file lies where a folder belongs"),
        (".snakemake/alone.lock", os.mkfifo, "a pipe lies where a file belongs"),
        ("data/smoke/lock.tmp", os.mkfifo, "a pipe lies where a file belongs"),
        ("workflow/config/timings.csv", os.mkfifo, "a pipe lies where a file belongs"),
        ("build/replaced", Path.touch, "a file lies where a folder belongs"),
        ("build/built_from.tmp", Path.mkdir, "a folder lies where a file belongs"),
        ("build/id/boltzmann.sha256", os.mkfifo, "a pipe lies where a file belongs"),
        ("build/system-packages", os.mkfifo, "no file lies where a file belongs"),
    ],
)
def test_what_lies_in_the_way_is_told_in_one_line(
    kept: Clone, tmp_path: Path, path: str, make: Callable[[Path], object], words: str
) -> None:
    place, aside, lock = kept.folder / path, tmp_path / "aside", kept.folder / "data/smoke/lock.json"
    before = lock.read_bytes()
    if place.exists():
        shutil.move(place, aside)
    make(place)
    try:
        made = kept.make(*FRESH)
    finally:
        place.rmdir() if place.is_dir() and not place.is_symlink() else place.unlink()
        if aside.exists():
            shutil.move(aside, place)
    assert made.returncode == 2
    assert "Traceback" not in made.stdout
    (line,) = (line for line in made.stdout.splitlines() if words in line)
    assert f"{path}: " in line
    assert lock.read_bytes() == before


@pytest.mark.parametrize("place", ["data", "figures"])
def test_data_and_figures_may_lie_on_another_disk(kept: Clone, elsewhere: Path, place: str) -> None:
    products = kept.products()
    shutil.move(kept.folder / place, elsewhere / place)
    (kept.folder / place).symlink_to(elsewhere / place)
    try:
        made = kept.make(*FRESH)
        now = {path: (kept.folder / path).read_bytes() for path in products}
    finally:
        (kept.folder / place).unlink()
        shutil.move(elsewhere / place, kept.folder / place)
    assert made.returncode == 0, made.stdout
    assert now == products
    assert not list((kept.folder / place).rglob("*.tmp"))
