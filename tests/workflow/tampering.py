"""Forgeries of a clone's products, and what finds them."""

import json
import os
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from tests.workflow.conftest import Clone, Edit, files_below
from workflow.lib.parents import file_hash
from workflow.provenance.lock import checksum_of

LOCK = "data/smoke/lock.json"
PICTURE = "figures/smoke/fig03.png"
PROGRAM = "build/bin/boltzmann"
EMPTY, UNKNOWN = ("data/smoke/fig03/empty", "figures/smoke/empty"), ("data/best", "figures/best")
FOLDERS = ("workflow/lib/fit.py", "workflow/lib/__pycache__", *EMPTY, *UNKNOWN)  # that edits make


@pytest.fixture
def tampered(kept: Clone) -> Iterator[Clone]:
    """As kept; programs and the files that run jobs are restored too, and what is no file is removed."""
    also = [
        kept.folder / "Makefile",
        *files_below(kept.folder / "build/bin"),
        *files_below(kept.folder / "build/id"),
    ]
    before = {file: (file.read_bytes(), file.stat().st_mode) for file in also}
    absent = [kept.folder / folder for folder in FOLDERS if not (kept.folder / folder).is_dir()]
    yield kept
    for place in ("data", "figures", "workflow", "cpp"):
        for path in [*(kept.folder / place).rglob("*")]:
            if path.is_symlink() or not (path.is_file() or path.is_dir()):
                path.unlink()
    for folder in absent:
        shutil.rmtree(folder, ignore_errors=True)
    for file, (content, mode) in before.items():
        if not file.exists() or file.read_bytes() != content:
            file.write_bytes(content)
            file.chmod(mode)


def run_module(
    clone: Clone, name: str, *options: str, quality: str | None = "smoke"
) -> subprocess.CompletedProcess:
    """Without make, which reinstalls packages and builds programs, and whose status is 2 for every failure."""
    command = [".venv/bin/python", "-P", "workflow/environment/launch.py", f"workflow.provenance.{name}"]
    return subprocess.run(
        [*command, *(["--quality", quality] if quality else []), *options],
        cwd=clone.folder,
        env={"PATH": os.defpath, "PYTHONDONTWRITEBYTECODE": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=900,
        check=False,
    )


def audit(clone: Clone, *options: str) -> subprocess.CompletedProcess:
    return run_module(clone, "audit", *(options or ("--panel", "fig03")))


def in_place_of(path: str, make: Callable[[Path], object]) -> Edit:
    """Removes the file if there is one, and puts something else there."""

    def edit(clone: Clone) -> None:
        (clone.folder / path).unlink(missing_ok=True)
        make(clone.folder / path)

    return edit


def paint_red(clone: Clone) -> None:
    """The same size and words, and nothing but red."""
    with Image.open(clone.folder / PICTURE) as picture:
        words = PngInfo()
        for name, text in picture.text.items():
            words.add_text(name, text)
        red = Image.new(picture.mode, picture.size, "red")
        dpi = picture.info["dpi"]
    red.save(clone.folder / PICTURE, pnginfo=words, dpi=dpi)


def relock(change: Callable[[dict], None] = lambda _: None) -> Edit:
    """A lock that fits what is there, with its checksum: only the links between the products can tell."""

    def edit(clone: Clone) -> None:
        content = json.loads((clone.folder / LOCK).read_text())
        del content["checksum"]
        for job in content["jobs"].values():
            job["outputs"] = {path: file_hash(clone.folder / path) for path in job["outputs"]}
        change(content)
        content["checksum"] = checksum_of(content)
        (clone.folder / LOCK).write_text(json.dumps(content))

    return edit


def both(first: Edit, second: Edit) -> Edit:
    def edit(clone: Clone) -> None:
        first(clone)
        second(clone)

    return edit


def state_executable(clone: Clone) -> None:
    """What the linker is said to have written is what is there."""
    (clone.folder / "build/id/boltzmann.sha256").write_text(
        f"{file_hash(clone.folder / PROGRAM)} boltzmann\n"
    )


def other_machine(content: dict) -> None:
    for job in content["jobs"].values():
        job["machine"] = "elsewhere"
