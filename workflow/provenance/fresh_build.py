"""Builds programs anew from the sources, in a folder of its own, with nothing of build/."""

import json
import os
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workflow.lib.parents import file_hash
from workflow.provenance.execute import ENVIRONMENT
from workflow.provenance.job import Job
from workflow.provenance.repository import ROOT, machine

# Where Homebrew keeps compilers is not on the path of the jobs.
TOOLS = ENVIRONMENT | {"PATH": f"/opt/homebrew/bin:{ENVIRONMENT['PATH']}", "HOME": os.devnull}


class BuildError(RuntimeError):
    """The sources give no programs."""


@dataclass(frozen=True)
class FreshBuild:
    folder: Path

    @property
    def programs(self) -> Path:
        return self.folder / "bin"

    @classmethod
    def of(cls, programs: Iterable[str], folder: Path) -> "FreshBuild":
        """Raises BuildError."""
        _run(["cmake", "-S", str(ROOT / "cpp"), "-B", str(folder), "-G", "Ninja", "-DCOMPILER_CACHE=none"])
        _run(["ninja", "-C", str(folder), "--quiet", "--", *sorted(programs)])
        return cls(folder)

    def identity(self, program: str) -> dict[str, Any]:
        """What it was built from."""
        identity: dict[str, Any] = json.loads((self.folder / f"id/{program}.json").read_text())
        return identity

    def fault(self, job: Job, recorded: dict[str, Any]) -> str | None:
        """What is wrong with the program that made the run, of which the lock has the record; none if the sources give
        the same. Where compiler or libraries differ, the file cannot be compared."""
        fresh = self.identity(job.tool)
        before, now = recorded.get("sources", {}), fresh["sources"]
        for path in sorted({*before, *now}):
            if before.get(path) != now.get(path):
                return f"cpp/{path} is not what {job.tool} was built from"
        same_file = file_hash(self.programs / job.tool) == job.executable
        if job.machine == machine() and fresh["build_id"] == job.build_id and not same_file:
            return f"the executable that made it is not what its sources give: {job.tool}"
        return None


def _run(command: list[str]) -> None:
    done = subprocess.run(command, cwd=ROOT, env=TOOLS, capture_output=True, text=True, check=False)
    if done.returncode:
        said = [*done.stdout.splitlines(), *done.stderr.splitlines()]
        first = next((line for line in said if "error" in line.lower()), "no message")
        raise BuildError(f"{command[0]} ended with status {done.returncode}: {first}")
