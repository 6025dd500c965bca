"""Runs Snakemake as the only one in this folder, and removes what an interrupted one has left locked.

`--logger progress` shows what runs in the project's own words (workflow/execution).
"""

import json
import shutil
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from workflow.execution.stopping import interrupt, terminate
from workflow.lib.locks import hold_as_make
from workflow.lib.places import in_one_line, require_place

PLACE = Path(".snakemake")
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
    for folder in FOLDERS:
        require_place(PLACE / folder / "any", Path())
    hold_as_make()
    shutil.rmtree(PLACE / "locks", ignore_errors=True)
    remove_damaged_notes()
    snakemake()


def remove_damaged_notes() -> None:
    """Of Snakemake's on its outputs, which it does not write at once. Nothing is decided by them."""
    for note in (PLACE / "metadata").rglob("*"):
        if note.is_file():
            try:
                whole = isinstance(json.loads(note.read_bytes()), dict)
            except (ValueError, RecursionError):
                whole = False
            if not whole:
                note.unlink()


def snakemake() -> None:
    """What takes a second to import is imported when a key may already be pressed."""
    signal.signal(signal.SIGINT, interrupt)
    if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:  # as nohup has it
        signal.signal(signal.SIGHUP, terminate)
    signal.signal(signal.SIGTERM, terminate)
    try:
        from snakemake.api import SnakemakeApi  # noqa: PLC0415
        from snakemake.cli import main  # noqa: PLC0415
        from snakemake.scheduling.job_scheduler import JobScheduler  # noqa: PLC0415
        from snakemake_interface_logger_plugins.registry import LoggerPluginRegistry  # noqa: PLC0415

        from workflow.execution import handler  # noqa: PLC0415

        # Its own for SIGTERM waits until the jobs are done, which may take hours.
        JobScheduler.exit_gracefully = terminate
        SnakemakeApi.print_exception = told_by(SnakemakeApi.print_exception)
        LoggerPluginRegistry().register_plugin("snakemake_logger_plugin_progress", handler)
        main(sys.argv[1:])
    except KeyboardInterrupt:
        sys.exit("Stopped. The same command goes on.")


def told_by(others: Callable[[Any, Exception], None]) -> Callable[[Any, Exception], None]:
    """Says an error of a file or of memory in one line; others say the rest."""

    def tell(api: Any, error: Exception) -> None:
        if isinstance(error, OSError):
            print(in_one_line(error), file=sys.stderr)
        elif isinstance(error, MemoryError):
            print("There is not enough memory", file=sys.stderr)
        else:
            others(api, error)

    return tell


if __name__ == "__main__":
    run()
