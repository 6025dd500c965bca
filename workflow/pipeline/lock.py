"""The lock of the products."""

import fcntl
import os
from functools import cache
from pathlib import Path


@cache
def lock_products() -> None:
    """Keeps other commands from making or removing products until this process ends. Called again, it does nothing: the entry locks before it
    compiles; the Snakefile also locks, for direct calls of Snakemake. Raises OSError."""
    Path("build").mkdir(exist_ok=True)
    file = os.open("build/lock", os.O_RDWR | os.O_CREAT)
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise BlockingIOError(
            "Another command is making products in this folder: wait for it to finish, or stop it."
        ) from error
