"""data/<quality>/lock.json: for every job that made a product, the product's hash and its parents.

Every job records itself when it is done, so that nothing enters the lock but what a job has just written.
Run by the rules: python -m workflow.provenance.lock.
"""

import argparse
import contextlib
import fcntl
import hashlib
import json
import os
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path

from workflow.provenance import repository
from workflow.provenance.parents import Parents, file_hash

FORMAT = "lorentz-gas-lock"
VERSION = 1


class LockError(ValueError):
    """The lock is missing, damaged or edited."""


@dataclass(frozen=True)
class Job:
    """A run of a program, `panel/run`, or the drawing of a panel, `panel`."""

    outputs: dict[str, str]  # path: sha256
    parents: dict  # of a run: program, build_id, arguments; of a drawing: see Parents
    configuration: dict[str, str]  # path: sha256 of the files that asked for it
    commit: str | None  # of the repository when the job was done
    dirty: bool | None  # whether tracked files differed from it
    machine: str

    @property
    def is_drawing(self) -> bool:
        return "data" in self.parents


@dataclass
class Lock:
    quality: str
    jobs: dict[str, Job] = field(default_factory=dict)
    builds: dict[str, dict] = field(default_factory=dict)  # build id: what build/id/<program>.json says

    @staticmethod
    def path(quality: str) -> Path:
        return repository.ROOT / "data" / quality / "lock.json"

    @classmethod
    def read(cls, quality: str) -> "Lock":
        """Raises LockError."""
        path = cls.path(quality)
        if not path.is_file():
            raise LockError(f"{path.relative_to(repository.ROOT)} is missing")
        try:
            content = json.loads(path.read_text())
            seal = content.pop("seal")
            jobs = {name: Job(**job) for name, job in content["jobs"].items()}
            lock = cls(content["quality"], jobs, content["builds"])
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise LockError(f"{path.relative_to(repository.ROOT)} is damaged: {error}") from error
        if seal != _seal(content):
            raise LockError(f"{path.relative_to(repository.ROOT)} has been edited: its seal does not fit")
        return lock

    def write(self) -> None:
        """Builds that no run names are left out."""
        path = self.path(self.quality)
        named = builds_of(self.jobs.values())
        content = {"format": FORMAT, "version": VERSION, "quality": self.quality}
        content["builds"] = {build_id: build for build_id, build in self.builds.items() if build_id in named}
        content["jobs"] = {name: asdict(job) for name, job in self.jobs.items()}
        content["seal"] = _seal(content)
        unfinished = path.with_suffix(".tmp")
        unfinished.write_text(json.dumps(content, indent=1, sort_keys=True) + "\n")
        unfinished.replace(path)

    def runs(self) -> dict[str, Job]:
        return {name: job for name, job in self.jobs.items() if not job.is_drawing}

    def drawings(self) -> dict[str, Job]:
        return {name: job for name, job in self.jobs.items() if job.is_drawing}

    def outputs(self) -> dict[str, str]:
        return {path: digest for job in self.jobs.values() for path, digest in job.outputs.items()}


def builds_of(jobs: Iterable[Job]) -> set[str]:
    """Build ids of the programs that made the runs among the jobs."""
    return {job.parents["build_id"] for job in jobs if not job.is_drawing}


def _seal(content: dict) -> str:
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def configuration_files(quality: str) -> list[str]:
    return ["workflow/config/paper.yaml", f"workflow/config/quality/{quality}.yaml"]


@contextlib.contextmanager
def changing(quality: str) -> Iterator[Lock]:
    """The lock, or an empty one if there is none that can be read; written at the end. One at a time."""
    folder = Lock.path(quality).parent
    folder.mkdir(parents=True, exist_ok=True)
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        try:
            lock = Lock.read(quality)
        except LockError:
            lock = Lock(quality)
        yield lock
        lock.write()
    finally:
        os.close(descriptor)


def record(quality: str, name: str, outputs: list[str], parents: dict, builds: dict[str, dict]) -> None:
    """Enters a job that has just written its outputs; paths are relative to the project."""
    hashes = {path: file_hash(repository.ROOT / path) for path in outputs}
    asked = {path: file_hash(repository.ROOT / path) for path in configuration_files(quality)}
    job = Job(hashes, parents, asked, **repository.state(), machine=repository.machine())
    with changing(quality) as lock:
        lock.jobs[name] = job
        lock.builds |= builds


def main() -> None:
    parser = argparse.ArgumentParser(description="Enters a finished job into the lock")
    parser.add_argument("--quality", required=True)
    parser.add_argument("--job", required=True, help="panel/run, or panel for a drawing")
    parser.add_argument("--outputs", nargs="+", required=True, help="relative to the project")
    parser.add_argument("--build", type=Path, help="build/id/PROGRAM.json, for a run")
    parser.add_argument("--arguments", help="of the program, for a run")
    options = parser.parse_args()

    if options.build is None:
        table = next(path for path in options.outputs if path.endswith(".csv"))
        record(options.quality, options.job, options.outputs, vars(Parents.of(Path(table))), {})
    else:
        build = json.loads(options.build.read_text())
        parents = {"program": build["program"], "build_id": build["build_id"], "arguments": options.arguments}
        record(options.quality, options.job, options.outputs, parents, {build["build_id"]: build})


if __name__ == "__main__":
    main()
