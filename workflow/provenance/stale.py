"""Moves products that are stale, or that the configuration no longer asks for, to build/replaced.

Run by Snakemake itself when it starts (Snakefile).
"""

import contextlib
import glob
import shutil
from collections.abc import Iterable, Iterator

from workflow.lib.places import move, require_place
from workflow.lib.plan import Panel, outputs_of
from workflow.provenance.chain import Chain
from workflow.provenance.lock import Lock, LockError, changing, collect
from workflow.provenance.repository import ROOT

REPLACED = "build/replaced"


def replace(paths: Iterable[str]) -> None:
    """Moves what there is of the paths. Raises OSError where one of them is no file."""
    for path in paths:
        if require_place(ROOT / path, ROOT).exists():
            target = require_place(ROOT / REPLACED / path, ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            move(ROOT / path, target)


def require_places(chain: Chain, jobs: Iterable[str]) -> None:
    """Raises OSError where something else lies than the file that is going to be written, or than a folder on its way."""
    for path in places(chain, jobs):
        require_place(ROOT / path, ROOT)


def places(chain: Chain, jobs: Iterable[str]) -> Iterator[str]:
    """Every file that is written when the jobs run; a program names what it has not finished by itself."""
    yield from (f"data/{chain.quality}/lock.{kind}" for kind in ("json", "tmp"))
    for job in jobs:
        name = f"{chain.quality}/{job}"
        yield from (f"build/logs/{name}.log", f"build/benchmarks/{name}.tsv")
        yield from (f"build/records/{name}.{kind}" for kind in ("json", "tmp"))
        if chain.planned(job):
            yield from (f"build/costs/{name}.json", f"build/partial/{name}.h5")
        for path in chain.outputs(job):
            yield from (path, f"{path}.tmp", f"{REPLACED}/{path}")


def forget_partial(quality: str, job: str) -> None:
    """Removes partial results, checkpoints and parts of a run."""
    for place in ("partial", "parts"):
        for path in (ROOT / "build" / place / quality).glob(f"{glob.escape(job)}-*"):
            shutil.rmtree(path) if path.is_dir() else path.unlink()


def set_damaged_lock_aside(quality: str) -> str | None:
    """Moves a lock that cannot be read; returns why. Everything is made again then."""
    path = Lock.path(quality)
    if not path.exists():
        return None
    try:
        Lock.read(quality)
    except LockError as error:
        replace([str(path.relative_to(ROOT))])
        return str(error)
    return None


def prepare(chain: Chain, jobs: Iterable[str], fresh: bool) -> str | None:
    """Sets aside a damaged lock and the products of jobs that are going to run; returns what is wrong with the lock.
    A fresh run resumes nothing. Raises OSError before anything is moved if a job could not write."""
    require_places(chain, jobs)
    reason = set_damaged_lock_aside(chain.quality)
    collect(chain.quality)  # what a run that was killed has left
    for job in jobs:
        replace(chain.outputs(job))
        if fresh:
            forget_partial(chain.quality, job)
    return reason


def unasked(quality: str, plan: dict[str, Panel]) -> list[str]:
    """Jobs in the lock that the configuration does not ask for."""
    asked = {*plan, *(f"{name}/{run.name}" for name, panel in plan.items() for run in panel.runs)}
    try:
        return sorted(Lock.read(quality).jobs.keys() - asked)
    except LockError:
        return []


def retire(quality: str, names: Iterable[str]) -> None:
    """The jobs leave the lock, and their products the data and the figures, with the folders of their own. A product
    lies where a job of that name writes, whatever the lock says."""
    with changing(quality) as lock:
        for name in names:
            del lock.jobs[name]
            outputs = outputs_of(quality, name)
            replace(outputs)
            for folder in {(ROOT / path).parent for path in outputs}:
                with contextlib.suppress(OSError):  # others' products lie there too
                    folder.rmdir()
