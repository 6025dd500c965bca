"""The system's locks on a folder's makes and their jobs, which end with the process, unlike files that stay when it is killed.

Standard library only, as packages are installed under one.
"""

import fcntl
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import TextIO

from workflow.lib.places import require_place

ALONE = Path(".snakemake/alone.lock")  # held by the make that runs jobs or changes what they use
JOBS = Path(".snakemake/jobs.lock")  # held by the jobs on this machine, each as one of many
ANOTHER = "Another make is running here: wait for its end, or stop it"
LEFT = f"A job of a make that was killed still runs here: wait for its end, or stop it (fuser {JOBS})"


@contextmanager
def only_make(root: Path) -> Iterator[None]:
    """While no other make runs jobs in this folder. Leaves if one does; raises OSError if something lies in the lock's place."""
    with _locked(root / ALONE, root, ANOTHER):
        yield


@cache
def hold_as_make() -> TextIO:
    """As only_make in the current folder, until this process ends; to ask twice is no more. Leaves also while a job of a make
    that was killed still runs, as it would write its products among new ones. Raises OSError."""
    file = _locked(ALONE, Path(), ANOTHER)
    _locked(JOBS, Path(), LEFT).close()
    return file


def hold_as_job() -> None:
    """Until this process and the one that it starts have ended."""
    file = os.open(JOBS, os.O_RDWR | os.O_CREAT)
    fcntl.flock(file, fcntl.LOCK_SH)
    os.set_inheritable(file, True)


def _locked(path: Path, root: Path, refusal: str) -> TextIO:
    """Until the file is closed."""
    require_place(path, root).parent.mkdir(exist_ok=True)
    file = path.open("w")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        sys.exit(refusal)
    return file
