"""The jobs of a call of Snakemake on a cluster with Slurm; with another scheduler there is nothing to be
said."""

import re
import subprocess
from collections import Counter
from pathlib import Path

RUN_ID = re.compile(r"SLURM run ID: (\S+)")  # the name of all jobs, in Snakemake's log
LIMITED = ("timeout", "5")  # seconds; without its server a command of Slurm takes a minute


class Queue:
    """The jobs of the call of Snakemake that writes a log."""

    def __init__(self, log: Path) -> None:
        self._log, self._printed, self._silent = log, "", 0

    @property
    def is_lost(self) -> bool:
        """Whether Snakemake waits in vain for jobs that Slurm has forgotten, as it does soon after their end
        without accounting, or that Snakemake has forgotten as squeue failed: at three looks in succession
        there were no jobs, not even ended ones, and Snakemake had printed nothing."""
        return self._silent > 1

    def look(self) -> str:
        """Numbers of pending jobs, by reason, and of running ones, in words."""
        name, printed = self._name(), self._log.read_text()
        command = [*LIMITED, "squeue", "--noheader", "--states=all", f"--name={name}", "--format=%T %r"]
        done = subprocess.run(command, capture_output=True, text=True, check=False) if name else None
        is_known = done is not None and done.returncode == 0
        lines = done.stdout.splitlines() if done else []
        idle = is_known and not lines and printed == self._printed
        self._silent, self._printed = self._silent + 1 if idle else 0, printed
        if not is_known:
            return "unknown"
        jobs = Counter(
            "running" if state == "RUNNING" else f"pending ({reason})"
            for state, _, reason in (line.partition(" ") for line in lines)
            if state in ("RUNNING", "PENDING")
        )
        return ", ".join(f"{number} {state}" for state, number in jobs.items()) or "none"

    def cancel(self) -> None:
        """Cancels all jobs, also those whose number Snakemake has not received or has forgotten."""
        if name := self._name():
            subprocess.run([*LIMITED, "scancel", f"--name={name}"], capture_output=True, check=False)

    def _name(self) -> str:
        found = RUN_ID.search(self._log.read_text())
        return found[1] if found else ""
