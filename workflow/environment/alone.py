"""Runs Snakemake as the only one in this folder, and removes what an interrupted one has left locked.

Snakemake's own locks are files, which stay when it is killed; this one is the system's and ends with the process.
"""

import fcntl
import shutil
import sys
from pathlib import Path

from snakemake.cli import main

PLACE = Path(".snakemake")


def run() -> None:
    PLACE.mkdir(exist_ok=True)
    with (PLACE / "alone.lock").open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            sys.exit("Another make is running here: wait for its end, or stop it")
        shutil.rmtree(PLACE / "locks", ignore_errors=True)
        main(sys.argv[1:])


if __name__ == "__main__":
    run()
