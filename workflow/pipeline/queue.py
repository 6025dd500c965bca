"""The jobs of a call of Snakemake on a cluster with Slurm; with another scheduler there is nothing to be said."""

import re
import subprocess
from collections import Counter
from pathlib import Path

RUN_ID = re.compile(r"SLURM run ID: (\S+)")  # the name of all jobs, in Snakemake's log


class Queue:
    """The jobs of the call of Snakemake that writes a log."""

    def __init__(self, log: Path) -> None:
        self._log, self._printed, self._silent = log, "", 0

    @property
    def is_lost(self) -> bool:
        """Whether Snakemake waits in vain for jobs that Slurm has forgotten, which it does soon after their end
        without accounting, or that a failing squeue has made Snakemake forget: at three looks in succession
        there were no jobs, not even ended ones, and Snakemake had printed nothing."""
        return self._silent > 1

    def look(self) -> str:
        """Numbers of pending jobs, by reason, and of running ones, in words."""
        name = self._name()
        command = ["squeue", "--noheader", "--states=all", f"--name={name}", "--format=%T %r"]
        done = subprocess.run(command, capture_output=True, text=True, check=False) if name else None
        printed = self._log.read_text()
        idle = done and done.returncode == 0 and not done.stdout and printed == self._printed
        self._silent = self._silent + 1 if idle else 0
        self._printed = printed
        jobs = Counter(line.partition(" ")[::2] for line in done.stdout.splitlines()) if done else Counter()
        return ", ".join(
            f"{number} {state.lower()}{f' ({reason})' if state == 'PENDING' else ''}"
            for (state, reason), number in jobs.items()
            if state in ("PENDING", "RUNNING")
        )

    def cancel(self) -> None:
        """Cancels all jobs, also those whose number Snakemake has not received or has forgotten."""
        if name := self._name():
            subprocess.run(["scancel", f"--name={name}"], capture_output=True, check=False)

    def _name(self) -> str:
        found = RUN_ID.search(self._log.read_text())
        return found[1] if found else ""
