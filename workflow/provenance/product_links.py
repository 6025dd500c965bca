"""Links from jobs to products that an audit checks, each by a function of the chain that yields what is broken."""

import os
import stat
from collections.abc import Iterator

from workflow.lib.plan import data_of
from workflow.provenance.chain import Chain
from workflow.provenance.links import Link, unchecked
from workflow.provenance.lock import Job
from workflow.provenance.metadata import drawing_fault, run_fault
from workflow.provenance.repository import ROOT

RECORDS = ("lock.json", "verification.json")  # in data/<quality>, which no job makes


def products(chain: Chain) -> Iterator[Link]:
    for name, job in chain.lock.jobs.items():
        for path in {*job.outputs} ^ {*chain.outputs(name)}:
            yield Link(path, f"is not among what the lock says {name} made, or only there", name)
        for path, digest in job.outputs.items():
            if chain.hashes[path] is None:
                yield Link(path, "is missing, not a file, or cannot be read", name)
            elif chain.hashes[path] != digest:
                yield Link(path, "is not what the job wrote: damaged, edited or replaced", name)


def strangers(chain: Chain) -> Iterator[Link]:
    """What lies among the products and is none."""
    known = chain.lock.outputs().keys() | {f"data/{chain.quality}/{name}" for name in RECORDS}
    unreadable: list[OSError] = []
    for place in ("data", "figures"):
        if (ROOT / place / chain.quality).is_symlink():
            yield Link(f"{place}/{chain.quality}", "is a link")
        for folder, folders, files in os.walk(ROOT / place / chain.quality, onerror=unreadable.append):
            for name in sorted([*folders, *files]):
                path = os.path.relpath(os.path.join(folder, name), ROOT)
                mode = os.lstat(ROOT / path).st_mode
                if stat.S_ISREG(mode) and path not in known:
                    yield Link(path, "has no parents: no job in the lock made it", path)
                elif not stat.S_ISREG(mode) and not stat.S_ISDIR(mode):
                    yield Link(path, "is neither a file nor a folder", path)
    for error in unreadable:
        if (path := os.path.relpath(error.filename, ROOT)) not in (
            f"data/{chain.quality}",
            f"figures/{chain.quality}",
        ):
            yield unchecked(path, f"cannot be read: {error.strerror}")


def runs(chain: Chain, names: set[str]) -> Iterator[Link]:
    """What the result files of the named runs say of themselves."""
    for name, job in chain.lock.runs().items():
        if name not in names:
            continue
        for path in intact(chain, job):
            if job.build_id not in chain.lock.builds:
                yield Link(path, "the lock does not say what its build was made from", name)
            elif fault := run_fault(path, job, chain.lock):
                yield Link(path, fault, name)


def drawings(chain: Chain, names: set[str]) -> Iterator[Link]:
    """Which data every drawing shows, and what the files of the named ones say of themselves."""
    made = chain.lock.outputs()
    for name, job in chain.lock.drawings().items():
        for path in intact(chain, job) if name in names else ():
            if fault := drawing_fault(path, job, chain.lock):
                yield Link(path, fault, name)
        picture = f"figures/{chain.quality}/{name}.pdf"
        for path, digest in job.data.items():
            if made.get(path) != digest:
                yield Link(picture, f"was drawn from another {path}", name)
        if name in chain.plan and job.data.keys() != set(data_of(chain.plan, name, chain.quality)):
            yield Link(picture, "does not show the runs of the panel", name)


def intact(chain: Chain, job: Job) -> list[str]:
    return [path for path, digest in job.outputs.items() if chain.hashes[path] == digest]
