"""Moves products that are stale, or that the configuration no longer asks for, to build/replaced.

Run by Snakemake itself when it starts (Snakefile).
"""

import contextlib
import glob
from collections.abc import Iterable

from workflow.lib.plan import Panel
from workflow.provenance.chain import Chain
from workflow.provenance.lock import Lock, LockError, changing
from workflow.provenance.repository import ROOT

REPLACED = "build/replaced"


def replace(paths: Iterable[str]) -> None:
    """Moves what there is of the paths."""
    for path in paths:
        if (ROOT / path).exists():
            (ROOT / REPLACED / path).parent.mkdir(parents=True, exist_ok=True)
            (ROOT / path).replace(ROOT / REPLACED / path)


def forget_partial(quality: str, job: str) -> None:
    """Removes partial results and checkpoints of a run."""
    for path in (ROOT / "build/partial" / quality).glob(f"{glob.escape(job)}-*"):
        path.unlink()


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
    A fresh run resumes nothing."""
    reason = set_damaged_lock_aside(chain.quality)
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
    """The jobs leave the lock, and their products the data and the figures, with the folders of their own."""
    with changing(quality) as lock:
        for name in names:
            outputs = lock.jobs.pop(name).outputs
            replace(outputs)
            for folder in {(ROOT / path).parent for path in outputs}:
                with contextlib.suppress(OSError):  # others' products lie there too
                    folder.rmdir()
