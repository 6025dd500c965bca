"""What products say of themselves (embedded metadata), against what the lock says of them."""

import math
from itertools import zip_longest
from typing import Any

from workflow.lib.layout import faults
from workflow.lib.load import NOT_REACHED, load
from workflow.lib.options import terms
from workflow.lib.parents import PACKAGES, ArtefactError, Parents
from workflow.provenance.execute import UNCONVERGED
from workflow.provenance.job import Job
from workflow.provenance.lock import Lock
from workflow.provenance.repository import ROOT

BUILT = ("program", "source_hash", "compiler", "flags", "libraries")


def run_fault(path: str, job: Job, lock: Lock) -> str | None:
    """Of a result file: the first contradiction with the documented layout or with the lock."""
    try:
        found = faults(ROOT / path)
        result = None if found else load(ROOT / path)
    except Exception as error:  # a forged file may raise anything in the library that reads it
        return f"is not a result file: {error}"
    if result is None:
        return found[0].removeprefix(f"{ROOT / path}: ")
    wanted = {name: lock.builds[job.build][name] for name in BUILT} | {"build_id": job.build_id}
    for name, value in wanted.items():
        if result.provenance[name] != value:
            return f"says {name} {result.provenance[name]}, not {value}"
    if (job.exit == UNCONVERGED) != (result.converged == NOT_REACHED):
        return f"says that its target error is {result.converged}, though the program's exit status was {job.exit}"
    for name, value in job.options.items():
        if name in result.parameters and not _agree(value, result.parameters[name]):
            return f"says --{name} {result.parameters[name]}, not {value}"
    return None


def _agree(option: Any, stated: Any) -> bool:
    """Whether an option of the configuration means what a file states in canonical form."""
    pairs = zip_longest(str(option).split(","), str(stated).split(","))
    return all(_canonical(one) == _canonical(other) for one, other in pairs)


def _canonical(text: str | None) -> object:
    """The terms of a number or a polynomial in N, by power, or a word."""
    powers = sorted(terms(text), key=lambda term: term[1]) if text else []
    return text if not powers or any(math.isnan(coefficient) for coefficient, _ in powers) else powers


def drawing_fault(path: str, job: Job, lock: Lock) -> str | None:
    """Of a figure's file: the first contradiction with the lock."""
    try:
        named = vars(Parents.of(ROOT / path))
    except ArtefactError as error:
        return str(error)
    _, quality, panel = path.rpartition(".")[0].split("/")
    wanted = vars(parents_of(job, lock, quality, panel))
    differing = [name for name, value in named.items() if value != wanted[name]]
    return f"names other {differing[0]} than the lock" if differing else None


def parents_of(job: Job, lock: Lock, quality: str, panel: str) -> Parents:
    """What the files of a drawing have to name, by the lock."""
    runs = {path: one for one in lock.runs().values() for path in one.outputs if path in job.data}
    builds = {one.build: lock.builds[one.build] for one in runs.values()}
    return Parents(
        panel=panel,
        quality=quality,
        data={
            path: {
                "sha256": digest,
                "build_id": runs[path].build_id if path in runs else None,
                "seed": runs[path].options.get("seed", 0) if path in runs else None,
            }
            for path, digest in job.data.items()
        },
        builds={build_id: {name: build[name] for name in BUILT} for build_id, build in builds.items()},
        sources={path: digest for path, digest in job.sources.items() if path != PACKAGES},
        packages=job.inputs[PACKAGES],
        python=job.python or "",
        configuration=job.options["configuration"],
    )
