"""Whether the end has been asked for, and how the jobs are told."""

import os
import signal
import subprocess
import threading
from contextlib import suppress

stopping = threading.Event()
JOB = "workflow.provenance.execute"


def interrupt(*_: object) -> None:
    """On Ctrl-C, which a terminal sends to the jobs too. Those that end from now on are not said to fail."""
    stopping.set()
    raise KeyboardInterrupt


def terminate(*_: object) -> None:
    """On a signal that only this process may have received: as on Ctrl-C, the jobs write their checkpoints and end."""
    stopping.set()
    for job in jobs():
        with suppress(ProcessLookupError):
            os.kill(job, signal.SIGTERM)
    interrupt()


def jobs() -> list[int]:
    """Processes on this machine that this one has started to run jobs, without the shells between."""
    told = subprocess.run(
        ["ps", "-A", "-ww", "-o", "pid=,ppid=,args="], capture_output=True, text=True, check=False
    ).stdout
    rows = [(int(pid), int(parent), args) for pid, parent, args in map(_columns, told.splitlines())]
    below = {os.getpid()}
    while more := {pid for pid, parent, _ in rows if parent in below} - below:
        below |= more
    return [pid for pid, _, args in rows if pid in below and JOB in args and "python" in args.split()[0]]


def _columns(line: str) -> tuple[str, str, str]:
    pid, parent, *args = line.split(maxsplit=2)
    return pid, parent, "".join(args)
