"""What Slurm says of the jobs of a call of Snakemake."""

import re
import subprocess
import time
from collections import Counter
from collections.abc import Collection
from pathlib import Path

SECONDS = 60  # between two looks
RUN_ID = re.compile(r"SLURM run ID: (\S+)")  # the name of all jobs, in Snakemake's log


class Queue:
    """The jobs of one call. abandoned: whether is_done() has become true."""

    def __init__(self, log: Path) -> None:
        self._log, self._last, self._empty = log, time.monotonic(), 0
        self.abandoned = False

    def is_done(self, results: Collection[str]) -> bool:
        """Whether Snakemake waits in vain: for jobs that the queue has forgotten, as it does soon after their end
        without accounting. No job was in the queue at two looks in succession. Prints why jobs pend. results: that
        are missing."""
        if self.abandoned or time.monotonic() - self._last < SECONDS:
            return False
        self._last = time.monotonic()
        jobs = self._jobs()
        if jobs is None:
            return False
        for reason, number in Counter(reason for state, reason in jobs if state == "PENDING").items():
            print(f"{number} job{'s' if number > 1 else ''} pending: {reason}", flush=True)
        self._empty = 0 if jobs else self._empty + 1
        self.abandoned = self._empty > 1
        if self.abandoned and results:
            print(
                f"{len(results)} results are missing, and no job is in the queue: see {self._log}", flush=True
            )
        return self.abandoned

    def _jobs(self) -> list[tuple[str, str]] | None:
        """State and reason of every job; None if they are unknown."""
        name = RUN_ID.search(self._log.read_text())
        if not name:
            return None
        command = ["squeue", "--noheader", f"--name={name[1]}", "--format=%T|%r"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            return None
        return [
            (state, reason) for state, _, reason in (line.partition("|") for line in done.stdout.splitlines())
        ]
