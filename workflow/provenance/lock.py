"""data/<quality>/lock.json: for every job that made a product, what ran, from what, and the hash of what it wrote.

Every job leaves a record when it is done (execute.py): a lock of its own, with nothing but what it has just written. Whoever
reads the lock reads the records too, and the one process that started the jobs collects them. So jobs on other machines
need nothing but the shared folder, and no lock of the file system.
"""

import contextlib
import hashlib
import json
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from workflow.lib.places import require_place
from workflow.provenance import repository
from workflow.provenance.job import Job
from workflow.provenance.lock_types import check_build, check_job

FORMAT = {"format": "lorentz-gas-lock", "version": 3}
PIPELINE = (  # what runs the jobs, beside the programs and the scripts
    "Makefile",
    "Snakefile",
    "cpp/CMakeLists.txt",
    "profiles/*/*",
    "workflow/config/schema.yaml",
    "workflow/environment/launch.py",
    "workflow/lib/configuration.py",
    "workflow/lib/options.py",
    "workflow/lib/plan.py",
    "workflow/lib/strict_yaml.py",
    "workflow/provenance/execute.py",
    "workflow/rules/*",
)


class LockError(ValueError):
    """The lock is missing, damaged or edited."""


@dataclass
class Lock:
    quality: str
    jobs: dict[str, Job] = field(default_factory=dict)
    builds: dict[str, dict[str, Any]] = field(default_factory=dict)  # build id: as build/id/<program>.json

    @staticmethod
    def path(quality: str) -> Path:
        return repository.ROOT / "data" / quality / "lock.json"

    @classmethod
    def read(cls, quality: str) -> "Lock":
        """With the records that are not collected. Raises LockError."""
        waiting = [record for path in records(quality) if (record := cls._record(path, quality))]
        lock = (
            cls(quality)
            if waiting and not cls.path(quality).exists()
            else cls._of(cls.path(quality), quality)
        )
        for record in waiting:
            lock.jobs |= record.jobs
            lock.builds |= record.builds
        return lock

    @classmethod
    def _record(cls, path: Path, quality: str) -> "Lock | None":
        """None if it is damaged, or of another job: then nothing is known of the job, which runs again."""
        try:
            record = cls._of(path, quality)
        except LockError:
            return None
        return record if [record_path(quality, name) for name in record.jobs] == [path] else None

    @classmethod
    def _of(cls, path: Path, quality: str) -> "Lock":
        name = path.relative_to(repository.ROOT)
        if not path.is_file():
            raise LockError(f"{name} is missing")
        try:
            content = json.loads(path.read_text(), object_pairs_hook=_unique)
            checksum = content.pop("checksum", None)
            if {key: content[key] for key in FORMAT} != FORMAT:
                raise LockError(f"{name} is of version {content['version']}, not {FORMAT['version']}")
            if unknown := content.keys() - {*FORMAT, "quality", "builds", "jobs"}:
                raise LockError(f"{name} is damaged: nobody here writes {min(unknown)!r} into it")
            if content["quality"] != quality:
                raise LockError(f"{name} is that of another quality")
            jobs = {name: Job(**job) for name, job in content["jobs"].items()}
            lock = cls(quality, jobs, content["builds"])
            lock.check()
        except LockError:
            raise
        except OSError as error:
            raise LockError(f"{name} cannot be read: {error.strerror}") from error
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
            raise LockError(f"{name} is damaged: {error}") from error
        if checksum != checksum_of(content):
            raise LockError(f"{name} is damaged or edited: its checksum does not fit")
        return lock

    def write(self, path: Path | None = None) -> None:
        """Builds that no run names are left out. Raises LockError where read() would. path: of a record."""
        path = path or self.path(self.quality)
        named = builds_of(self.jobs.values())
        try:
            self.check()
        except TypeError as error:
            name = path.relative_to(repository.ROOT)
            raise LockError(f"{name} is kept as it was, as it cannot hold {error}") from error
        content = FORMAT | {"quality": self.quality}
        content["builds"] = {name: build for name, build in sorted(self.builds.items()) if name in named}
        content["jobs"] = {name: asdict(job) for name, job in sorted(self.jobs.items())}
        content["checksum"] = checksum_of(content)
        repository.write_whole(path, json.dumps(content, indent=1) + "\n")

    def check(self) -> None:
        """Raises TypeError if an entry is none that a job makes."""
        for name, job in self.jobs.items():
            check_job(name, job, configuration_files(self.quality))
        for identifier, build in self.builds.items():
            check_build(identifier, build)

    def runs(self) -> dict[str, Job]:
        return {name: job for name, job in self.jobs.items() if not job.is_drawing}

    def drawings(self) -> dict[str, Job]:
        return {name: job for name, job in self.jobs.items() if job.is_drawing}

    def outputs(self) -> dict[str, str]:
        return {path: digest for job in self.jobs.values() for path, digest in job.outputs.items()}


def _unique(pairs: list[tuple[str, object]]) -> dict[str, object]:
    """Raises ValueError for a name that stands twice, of which readers take one or the other."""
    content = dict(pairs)
    if len(content) < len(pairs):
        twice = next(name for number, (name, _) in enumerate(pairs) if name in dict(pairs[:number]))
        raise ValueError(f"{twice!r} stands twice")
    return content


def builds_of(jobs: Iterable[Job]) -> set[str]:
    """Build ids of the programs that made the runs among the jobs."""
    return {job.build for job in jobs if not job.is_drawing}


def checksum_of(content: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def configuration_files(quality: str) -> list[str]:
    return ["workflow/config/paper.yaml", f"workflow/config/quality/{quality.partition('_')[0]}.yaml"]


def pipeline_files() -> list[str]:
    paths = (path for pattern in PIPELINE for path in sorted(repository.ROOT.glob(pattern)))
    return [str(path.relative_to(repository.ROOT)) for path in paths if path.is_file()]


def record_path(quality: str, name: str) -> Path:
    return repository.ROOT / f"build/records/{quality}/{name}.json"


def records(quality: str) -> list[Path]:
    """Files that jobs have left and nobody has collected. Raises OSError where their folder is none of the project's."""
    folder = require_place(record_path(quality, "any"), repository.ROOT).parent
    return sorted(path for path in folder.rglob("*.json") if path.is_file())


@contextlib.contextmanager
def changing(quality: str) -> Iterator[Lock]:
    """The lock with the records, or an empty one if there is none; written at the end, when the records go. For the one
    process that starts jobs (workflow/execution/alone.py). Raises LockError if it is damaged."""
    collected = records(quality)
    Lock.path(quality).parent.mkdir(parents=True, exist_ok=True)
    lock = Lock.read(quality) if collected or Lock.path(quality).exists() else Lock(quality)
    yield lock
    lock.write()
    for path in collected:
        path.unlink()


def collect(quality: str) -> None:
    """Enters the records into the lock. Raises LockError."""
    if records(quality):
        with changing(quality):
            pass


def record(
    quality: str,
    name: str,
    outputs: dict[str, str],
    made_by: dict[str, Any],
    build: dict[str, Any] | None = None,
) -> None:
    """Leaves the record of a job; outputs are its files with their hashes. Raises LockError, or OSError if a file of the
    project cannot be where one of them is to be."""
    hashes = repository.FileHashes()
    for output in outputs:
        require_place(repository.ROOT / output, repository.ROOT)
    try:
        asked, pipeline = hashes.of(configuration_files(quality)), hashes.of(pipeline_files())
    except FileNotFoundError as error:
        raise LockError(str(error)) from error
    state = repository.state() | {"machine": repository.machine()}
    job = Job(**made_by, outputs=outputs, configuration=asked, pipeline=pipeline, **state)
    path = record_path(quality, name)
    path.parent.mkdir(parents=True, exist_ok=True)
    Lock(quality, {name: job}, {job.build: build} if build else {}).write(path)
