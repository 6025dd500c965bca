"""The system's locks on a folder's makes and their jobs, which end with the process, unlike files that stay when it is killed.

Standard library only, as packages are installed under one.
"""

import fcntl
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from workflow.lib.places import require_place

ALONE = Path(".snakemake/alone.lock")  # held by the make that runs jobs or changes what they use
JOBS = Path(".snakemake/jobs.lock")  # held by the jobs on this machine, each as one of many


@contextmanager
def only_make(root: Path) -> Iterator[None]:
    """While no other make runs jobs in this folder. Leaves if one does; raises OSError if something lies in the lock's place."""
    with _held(root / ALONE, root, "Another make is running here: wait for its end, or stop it"):
        yield


def require_no_jobs(root: Path) -> None:
    """Leaves while a job of a make that was killed still runs, as it would write its products among new ones. Raises OSError."""
    refusal = f"A job of a make that was killed still runs here: wait for its end, or stop it (fuser {JOBS})"
    with _held(root / JOBS, root, refusal):
        pass


def hold_as_job() -> None:
    """Until this process and the one that it starts have ended."""
    file = os.open(JOBS, os.O_RDWR | os.O_CREAT)
    fcntl.flock(file, fcntl.LOCK_SH)
    os.set_inheritable(file, True)


@contextmanager
def _held(path: Path, root: Path, refusal: str) -> Iterator[None]:
    require_place(path, root).parent.mkdir(exist_ok=True)
    with path.open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            sys.exit(refusal)
        yield
