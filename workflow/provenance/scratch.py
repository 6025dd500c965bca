"""Checkpoints on a node's own disk: one a minute from each of thousands of jobs is much for a shared folder.

They are copied to the shared folder every ten minutes and when the job ends, also early, as the next attempt may run on
another node. Standard library only, as every job starts with it.
"""

import contextlib
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path

from workflow.lib.places import copy, move

INTERVAL = 600  # seconds: what a job can lose with its node
NEWEST, FORMER = ".checkpoint", ".checkpoint.old"  # both of a program: cpp/program/checkpoint.hpp


@contextlib.contextmanager
def scratch(shared: Path, interval: float = INTERVAL) -> Iterator[Path]:
    """Where a program is to write that resumes from, and may be stopped with, checkpoints beside `shared`: below TMPDIR, which
    a cluster sets to a disk of the node, or where there is none, at `shared` itself. If the program succeeds, what it leaves
    there is moved to `shared` and beside it, and the checkpoints are removed. Raises OSError."""
    with tempfile.TemporaryDirectory(prefix="lorentz.", ignore_cleanup_errors=True) as folder:
        if Path(folder).stat().st_dev == shared.parent.stat().st_dev:
            yield shared
            return
        own = Path(folder, shared.name)
        for ending in (NEWEST, FORMER):
            with contextlib.suppress(FileNotFoundError):
                copy(beside(shared, ending), beside(own, ending))
        with copying(beside(own, NEWEST), beside(shared, NEWEST), interval):
            yield own
        for path in own.parent.iterdir():
            move(path, shared.with_name(path.name))
        for ending in (NEWEST, FORMER):
            beside(shared, ending).unlink(missing_ok=True)


@contextlib.contextmanager
def copying(own: Path, shared: Path, interval: float) -> Iterator[None]:
    """Now and then while it lasts, and at its end, however it ends. Raises OSError at the end only: on the way the run matters more
    than a copy, and the next one may succeed."""

    def copy_it() -> None:
        with contextlib.suppress(FileNotFoundError):
            copy(own, shared)

    def now_and_then() -> None:
        while not ended.wait(interval):
            with contextlib.suppress(OSError):
                copy_it()

    ended = threading.Event()
    thread = threading.Thread(target=now_and_then, daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
        copy_it()


def beside(output: Path, ending: str) -> Path:
    return output.with_name(output.name + ending)
