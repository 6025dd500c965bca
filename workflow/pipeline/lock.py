"""Locks of the products and of the build of make verify."""

import fcntl
import os
from functools import cache
from pathlib import Path


def lock_products() -> None:
    """Keeps other commands from making or removing products until this process ends. Raises OSError."""
    lock(Path("build"))


@cache
def lock(folder: Path) -> None:
    """Keeps other commands from locking a folder until this process ends. Called again, it does nothing:
    the entry locks before it compiles; the Snakefile also locks, for direct calls of Snakemake. Raises
    OSError."""
    folder.mkdir(parents=True, exist_ok=True)
    file = os.open(folder / "lock", os.O_RDWR | os.O_CREAT)
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise BlockingIOError(
            f"another command of make or Snakemake is at work in {folder.absolute().parent}: wait for it, or stop it"
        ) from error
