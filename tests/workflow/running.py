"""A make that runs while a test goes on: what it has started, what happens to it, and its end."""

import contextlib
import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from typing import TypeVar

from tests.workflow.conftest import Clone

T = TypeVar("T")
PAUSE = 0.05  # seconds between looks


def soon(find: Callable[[], T], seconds: float = 120) -> T:
    """What is found, once it is true."""
    deadline = time.monotonic() + seconds
    while not (found := find()):
        assert time.monotonic() < deadline, f"it has not come about within {seconds:g} seconds"
        time.sleep(PAUSE)
    return found


def processes(session: int, words: str = "") -> list[int]:
    """Those of the session that are alive and have the words in their command, before its options."""
    told = subprocess.run(
        ["ps", "-ww", "-o", "pid=,stat=,args=", "-s", str(session)],
        capture_output=True,
        text=True,
        check=False,
    )
    rows = [line.split(maxsplit=2) for line in told.stdout.splitlines()]
    return [
        int(pid)
        for pid, state, command in rows
        if not state.startswith("Z") and words in command.split("--")[0]
    ]


def kill(victims: list[int]) -> None:
    for victim in victims:
        with contextlib.suppress(ProcessLookupError):
            os.kill(victim, signal.SIGKILL)


@contextlib.contextmanager
def running(
    clone: Clone, *arguments: str, tool: tuple[str, ...] = ("/usr/bin/make",)
) -> Iterator[subprocess.Popen]:
    """make, or another tool, in a session of its own, of which nothing is left at the end."""
    with subprocess.Popen(
        ["env", "--default-signal=HUP", *tool, *arguments],  # also where nohup runs the tests
        cwd=clone.folder,
        env={"PATH": os.defpath, "HOME": "/"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    ) as making:
        try:
            yield making
        finally:
            kill(processes(making.pid))
