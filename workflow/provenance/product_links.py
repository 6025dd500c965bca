"""Links from jobs to products that an audit checks, each by a function of the chain that yields what is broken."""

import os
import stat
from collections.abc import Iterator

from workflow.lib.plan import data_of, is_quality
from workflow.provenance import report_links
from workflow.provenance.chain import Chain
from workflow.provenance.job import Job
from workflow.provenance.links import Link, unchecked
from workflow.provenance.metadata import drawing_fault, run_fault
from workflow.provenance.repository import ROOT

BESIDE = {"data": {"README.md", "claims.csv"}, "figures": {"README.md", "tradeoff"}}  # the qualities' folders
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
    known = {
        *chain.lock.outputs(),
        *(f"data/{chain.quality}/{name}" for name in RECORDS),
        *report_links.paths(chain.quality),
    }
    in_use = folders_of_jobs(chain)
    unreadable: list[OSError] = []
    for place in ("data", "figures"):
        if (ROOT / place / chain.quality).is_symlink():
            yield Link(f"{place}/{chain.quality}", "is a link")
        for folder, folders, files in os.walk(ROOT / place / chain.quality, onerror=unreadable.append):
            path = os.path.relpath(folder, ROOT)
            if not folders and not files and path not in in_use:
                yield Link(path, "is an empty folder: no job in the lock made it", path)
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


def folders_of_jobs(chain: Chain) -> set[str]:
    """Where products lie or will lie; an interrupted run leaves such a folder empty."""
    planned = [path for name in chain.plan for path in data_of(chain.plan, name, chain.quality)]
    drawn = [path for name in chain.plan for path in chain.outputs(name)]
    return {os.path.dirname(path) for path in [*chain.lock.outputs(), *planned, *drawn]}


def of_no_quality(_: Chain) -> Iterator[Link]:
    """What lies beside the qualities' folders, where jobs make nothing."""
    for place, others in BESIDE.items():
        names = os.listdir(ROOT / place) if (ROOT / place).is_dir() else []
        for name in sorted({*names} - others):
            if not (is_quality(name) and (ROOT / place / name).is_dir()):
                path = f"{place}/{name}"
                yield Link(path, "is no folder of a known quality: no job made it", path)


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
