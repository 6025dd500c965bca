"""Checks every link from the sources to the figures: bytes, records, builds, configuration, commits, tables.

One line per broken link, from the sources down; status 1 if there is any.
"""

import argparse
import concurrent.futures
import hashlib
import json
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from workflow.lib.parents import PACKAGES
from workflow.lib.plan import ConfigurationError, data_of, load_plan
from workflow.provenance.build_id import build_id, include_closure, source_hash
from workflow.provenance.chain import Chain
from workflow.provenance.lock import Job, Lock, LockError, configuration_files
from workflow.provenance.metadata import drawing_fault, run_fault
from workflow.provenance.redo import RedoError, redrawn
from workflow.provenance.repository import ROOT, FileHashes, files_at, git, signature

RECORDS = ("lock.json", "verification.json")  # in data/<quality>, which no job makes


@dataclass(frozen=True)
class Link:
    """A broken one."""

    path: str
    message: str
    job: str | None = None  # the job whose product is concerned; none for a source


def audit(quality: str, only: str | None = None) -> tuple[list[Link], str]:
    """Broken links, each path once with the first thing that is wrong with it, and a summary of what was looked at.
    If a panel is given, only that one is drawn again."""
    try:
        lock = Lock.read(quality)
    except LockError as error:
        return [Link(f"data/{quality}/lock.json", str(error))], ""
    try:
        plan = load_plan(quality)
    except ConfigurationError as error:
        return [Link(path, str(error)) for path in changed_configuration(lock)], ""
    chain = Chain(quality, plan, lock)
    found: dict[str, Link] = {}
    for links in (records, requests, sources, builds, products, runs, drawings, commits):
        for link in links(chain):
            found.setdefault(link.path, link)
    broken = list(found.values())
    if not any(link.job is None for link in broken):
        names = [name for name in lock.drawings() if name == only or not only]
        broken += not_following(chain, names, {link.job for link in broken})
    return broken, summary(chain)


def summary(chain: Chain) -> str:
    lock = chain.lock
    text = f"{len(lock.runs())} runs, {len(lock.drawings())} panels, {len(lock.outputs())} files"
    named = sorted({job.commit for job in lock.jobs.values() if job.commit}) if whole_repository() else []
    compared = [f"{commit[:12]} ({signature(commit)})" for commit in named]
    text += f"; compared with commit {', '.join(compared)}" if compared else "; compared with no commit"
    if missing := [name for name in chain.plan if name not in lock.jobs]:
        text += f"; not made yet: {', '.join(missing)}"
    if any(job.dirty for job in lock.jobs.values()):
        text += "; some were made from sources that were not committed"
    return text


def whole_repository() -> bool:
    return git("rev-parse", "--is-shallow-repository") == b"false\n"


def changed_configuration(lock: Lock) -> list[str]:
    """Files that are not what they were when a product was made."""
    asked = dict(pair for job in lock.jobs.values() for pair in job.configuration.items())
    present = FileHashes()
    return [path for path, digest in asked.items() if present[path] != digest] or ["workflow/config"]


def records(chain: Chain) -> Iterator[Link]:
    if chain.lock.quality != chain.quality:
        yield Link(f"data/{chain.quality}/lock.json", f"is the lock of quality {chain.lock.quality}")


def requests(chain: Chain) -> Iterator[Link]:
    """Files of the configuration that no longer ask for what was made."""
    for name, job in chain.lock.jobs.items():
        if reason := chain.changed_request(name):
            changed = [path for path, digest in job.configuration.items() if chain.hashes[path] != digest]
            for path in changed or configuration_files(chain.quality)[:1]:
                yield Link(path, f"does not ask for what {name} was made with: {reason}")


def sources(chain: Chain) -> Iterator[Link]:
    """Files that have changed since something was made from them."""
    for build in chain.lock.builds.values():
        before = {f"cpp/{path}": digest for path, digest in build["sources"].items()}
        root = f"observables/{build['program']}.cpp"
        closure = include_closure(ROOT / "cpp", root) if chain.hashes[f"cpp/{root}"] else []
        now = {*before, *(f"cpp/{path}" for path in closure)}
        yield from changed(chain, before, now, f"{build['program']} was built")
    for name, job in chain.lock.drawings().items():
        known = name in chain.plan and all(chain.hashes[path] for path in job.sources)
        now = {*chain.sources(name), PACKAGES} if known else {*job.sources}
        yield from changed(chain, job.sources, now, f"{name} was drawn")


def changed(chain: Chain, before: dict[str, str], now: set[str], when: str) -> Iterator[Link]:
    for path, digest in before.items():
        if chain.hashes[path] is None:
            yield Link(path, f"is missing; {when} from it")
        elif chain.hashes[path] != digest:
            yield Link(path, f"has changed since {when} from it")
        elif path not in now:
            yield Link(path, f"is not included or imported any more, and {when} from it")
    for path in sorted(now - before.keys()):
        yield Link(path, f"is included or imported now, and was not when {when}")


def builds(chain: Chain) -> Iterator[Link]:
    programs: dict[str, str] = {}
    for identifier, build in chain.lock.builds.items():
        program, name = build["program"], f"build {identifier[:12]}"
        if build_id(build) != identifier or source_hash(build["sources"]) != build["source_hash"]:
            yield Link(name, f"of {program} does not follow from its sources and flags")
        if programs.setdefault(program, identifier) != identifier:
            yield Link(name, f"of {program}: its products are mixed with another's")
        present = ROOT / f"build/id/{program}.json"
        if present.is_file() and json.loads(present.read_text())["build_id"] != identifier:
            yield Link(f"build/bin/{program}", f"is not the build {identifier[:12]} that made the data")


def products(chain: Chain) -> Iterator[Link]:
    for name, job in chain.lock.jobs.items():
        for path in {*job.outputs} ^ {*chain.outputs(name)}:
            yield Link(path, f"is not among what the lock says {name} made, or only there", name)
        for path, digest in job.outputs.items():
            if chain.hashes[path] is None:
                yield Link(path, "is missing", name)
            elif chain.hashes[path] != digest:
                yield Link(path, "is not what the job wrote: damaged, edited or replaced", name)
    known = chain.lock.outputs().keys() | {f"data/{chain.quality}/{name}" for name in RECORDS}
    for place in ("data", "figures"):
        for file in sorted((ROOT / place / chain.quality).rglob("*")):
            path = str(file.relative_to(ROOT))
            if file.is_file() and path not in known:
                yield Link(path, "has no parents: no job in the lock made it", path)


def runs(chain: Chain) -> Iterator[Link]:
    for name, job in chain.lock.runs().items():
        for path in intact(chain, job):
            if job.build_id not in chain.lock.builds:
                yield Link(path, "the lock does not say what its build was made from", name)
            elif fault := run_fault(path, job, chain.lock):
                yield Link(path, fault, name)


def drawings(chain: Chain) -> Iterator[Link]:
    made = chain.lock.outputs()
    for name, job in chain.lock.drawings().items():
        for path in intact(chain, job):
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


def commits(chain: Chain) -> Iterator[Link]:
    """What is said to be made from a commit must agree with it."""
    clean = [(name, job) for name, job in chain.lock.jobs.items() if not job.dirty]
    for commit in sorted(
        {job.commit for job in chain.lock.jobs.values() if job.commit and whole_repository()}
    ):
        files, place = files_at(commit, "cpp", "workflow", PACKAGES), f"commit {commit[:12]}"
        if files is None:
            yield Link(place, "is not in this repository, and products name it")
            continue
        there = {path: hashlib.sha256(content).hexdigest() for path, content in files.items()}
        for name, job in clean:
            differing = [path for path, digest in made_from(chain, job).items() if there.get(path) != digest]
            if job.commit == commit and differing:
                yield Link(place, f"does not hold the {differing[0]} that {name} was made from", name)


def made_from(chain: Chain, job: Job) -> dict[str, str]:
    """Sources of a run's build or of a drawing."""
    if job.is_drawing:
        return job.sources
    built = chain.lock.builds.get(job.build_id, {"sources": {}})["sources"]
    return {f"cpp/{path}": digest for path, digest in built.items()}


def not_following(chain: Chain, names: list[str], suspect: set[str | None]) -> list[Link]:
    """Drawings that do not follow from their data, of those with no broken link above them."""
    makers = {path: run for run, job in chain.lock.runs().items() for path in job.outputs}
    names = [
        name
        for name in names
        if not suspect & {name, *(makers.get(path) for path in chain.lock.jobs[name].data)}
    ]
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as threads:
        found = threads.map(lambda name: contradictions(chain, name, Path(folder) / name), names)
        return [link for links in found for link in links]


def contradictions(chain: Chain, name: str, folder: Path) -> list[Link]:
    try:
        differing = redrawn(chain.lock.jobs[name], folder)
    except RedoError as error:
        return [Link(f"figures/{chain.quality}/{name}.csv", f"cannot be drawn again: {error}", name)]
    wrong = [path for path, rounded in differing.items() if not rounded]
    return [Link(path, "does not follow from the data that it names", name) for path in wrong]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--panel", help="draw only this one again")
    options = parser.parse_args()
    broken, text = audit(options.quality, options.panel)
    for link in broken:
        print(f"{link.path}: {link.message}")
    if broken:
        sys.exit(f"make audit: {len(broken)} broken; the first is {broken[0].path}")
    print(f"Every link holds: {text}")


if __name__ == "__main__":
    main()
