"""Locks of the products and of the build of make verify."""

import fcntl
import os
from functools import cache
from pathlib import Path


def lock_products() -> int:
    """Keeps other commands from making products until this process ends, and those to which it passes the
    file descriptor that this returns. Raises OSError."""
    return lock(Path("build"))


@cache
def lock(folder: Path) -> int:
    """Keeps other commands from locking a folder until this process ends. The entry locks before it compiles;
    the Snakefile also locks, for direct calls of Snakemake, but not below the entry. Raises OSError."""
    folder.mkdir(parents=True, exist_ok=True)
    file = os.open(folder / "lock", os.O_RDWR | os.O_CREAT)
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        process = os.read(file, 20).decode()
        if process == str(os.getppid()):
            return file
        raise BlockingIOError(
            f"another command of make or Snakemake, started by process {process}, is at work in "
            f"{folder.absolute().parent}: wait for it, or stop it"
        ) from error
    os.truncate(file, 0)
    os.write(file, str(os.getpid()).encode())
    return file
