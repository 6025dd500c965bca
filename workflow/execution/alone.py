"""Runs Snakemake as the only one in this folder, and removes what an interrupted one has left locked.

`--logger progress` shows what runs in the project's own words (workflow/execution).

Snakemake's own locks are files, which stay when it is killed; this one is the system's and ends with the process.
"""

import fcntl
import shutil
import signal
import sys
from pathlib import Path

from workflow.execution.stopping import stopping
from workflow.lib.places import require_place

PLACE = Path(".snakemake")
LOCK = PLACE / "alone.lock"
FOLDERS = (  # of Snakemake's
    "auxiliary",
    "conda",
    "conda-archive",
    "incomplete",
    "iocache",
    "locks",
    "metadata",
    "shadow",
    "singularity",
)


def run() -> None:
    for path in (LOCK, *(PLACE / folder / "any" for folder in FOLDERS)):
        require_place(path, Path())
    PLACE.mkdir(exist_ok=True)
    with LOCK.open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            sys.exit("Another make is running here: wait for its end, or stop it")
        shutil.rmtree(PLACE / "locks", ignore_errors=True)
        snakemake()


def snakemake() -> None:
    """What takes a second to import is imported when a key may already be pressed."""
    signal.signal(signal.SIGINT, interrupt)
    try:
        from snakemake.cli import main  # noqa: PLC0415
        from snakemake_interface_logger_plugins.registry import LoggerPluginRegistry  # noqa: PLC0415

        from workflow.execution import handler  # noqa: PLC0415

        LoggerPluginRegistry().register_plugin("snakemake_logger_plugin_progress", handler)
        main(sys.argv[1:])
    except KeyboardInterrupt:
        sys.exit("Stopped. The same command goes on.")


def interrupt(*_: object) -> None:
    """Jobs that end from now on are not said to fail."""
    stopping.set()
    raise KeyboardInterrupt


if __name__ == "__main__":
    run()
