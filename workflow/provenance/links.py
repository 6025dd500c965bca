"""Links from sources to jobs that an audit checks, each by a function of the chain that yields what is wrong.

What is wrong is broken, or cannot be checked here; the latter has no product that could be blamed. Links from jobs to
products: product_links.py.
"""

import hashlib
import json
import os
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

from workflow.environment.packages import faults
from workflow.lib.parents import PACKAGES
from workflow.provenance.build_id import build_id, source_hash
from workflow.provenance.chain import Chain
from workflow.provenance.job import Job
from workflow.provenance.lock import configuration_files
from workflow.provenance.repository import DECIDING, ROOT, DamagedError, files_at, no_history, untracked

NAMED = 5  # files of packages that are named where many are wrong


@dataclass(frozen=True)
class Link:
    """One that is broken, or that cannot be checked."""

    path: str
    message: str
    job: str | None = None  # the job whose product is concerned; none for a source
    broken: bool = True


def unchecked(path: str, why: str) -> Link:
    return Link(path, why, broken=False)


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


def packages(chain: Chain) -> Iterator[Link]:
    """Files of the Python environment; of many the first."""
    found = faults()
    for path in found[:NAMED]:
        yield Link(path, "is not what was installed: changed, missing or foreign")
    if len(found) > NAMED:
        yield Link(".venv", f"has {len(found) - NAMED} more such files: `make figures` installs it again")


def sources(chain: Chain) -> Iterator[Link]:
    """Files that have changed since something was made from them."""
    for build in chain.lock.builds.values():
        before = {f"cpp/{path}": digest for path, digest in build["sources"].items()}
        now = {*before, *compiled(chain, build["program"])}
        yield from changed(chain, before, now, f"{build['program']} was built")
    for name, job in chain.lock.drawings().items():
        now = {*imported(chain, name), PACKAGES} if name in chain.plan else set()
        yield from changed(chain, job.sources, now or {*job.sources}, f"{name} was drawn")


def compiled(chain: Chain, program: str) -> list[str]:
    """Sources of a program now; none where one of them cannot be read."""
    try:
        return [f"cpp/{path}" for path in chain.program_sources(program)]
    except (OSError, UnicodeDecodeError):
        return []


def imported(chain: Chain, name: str) -> list[str]:
    """Sources of a drawing now; those that it was made from where one of them cannot be read."""
    before = [*chain.lock.jobs[name].sources]
    script = f"workflow/figures/{chain.plan[name].script}.py"
    try:
        return chain.sources(name) if chain.hashes[script] else before
    except (OSError, SyntaxError, ValueError):
        return before


def changed(chain: Chain, before: dict[str, str], now: set[str], when: str) -> Iterator[Link]:
    for path, digest in before.items():
        if chain.hashes[path] is None:
            state = "is not a file any more" if os.path.lexists(ROOT / path) else "is missing"
            yield Link(path, f"{state}; {when} from it")
        elif chain.hashes[path] != digest:
            yield Link(path, f"has changed since {when} from it")
        elif path not in now:
            yield Link(path, f"is not included or imported any more, and {when} from it")
    for path in sorted(now - before.keys()):
        yield Link(path, f"is included or imported now, and was not when {when}")


def pipeline(chain: Chain) -> Iterator[Link]:
    """Files that ran the jobs: what they would make now may be the same or not."""
    jobs = [*chain.lock.jobs.values()]
    since = Counter(
        path for job in jobs for path, digest in job.pipeline.items() if chain.hashes[path] != digest
    )
    for path, number in since.items():
        yield unchecked(path, f"has changed since {number} jobs were run with it")


def uncommitted(chain: Chain) -> Iterator[Link]:
    """Files that decide and are not those of the commit that is checked out, whether a job names them or not."""
    if no_history():
        return
    try:
        files = files_at("HEAD", *DECIDING) or {}
    except DamagedError as error:
        yield Link("the repository", f"is damaged, and the files here cannot be compared with it: {error}")
        return
    for path, content in files.items():
        if chain.hashes[path] != hashlib.sha256(content).hexdigest():
            yield unchecked(path, "is not what the commit that is checked out holds")
    for path in untracked():
        yield unchecked(path, "untracked: no commit has it, and it may take the place of a file that one has")


def builds(chain: Chain) -> Iterator[Link]:
    programs: dict[str, str] = {}
    for identifier, build in chain.lock.builds.items():
        program, name = build["program"], f"build {identifier[:12]}"
        if build_id(build) != identifier or source_hash(build["sources"]) != build["source_hash"]:
            yield Link(name, f"of {program} does not follow from its sources and flags")
        if programs.setdefault(program, identifier) != identifier:
            yield Link(name, f"of {program}: its products are mixed with another's")


def executables(chain: Chain) -> Iterator[Link]:
    """Programs that made the runs, among one another and against those in build/bin."""
    made: defaultdict[tuple[str, str], Counter[str | None]] = defaultdict(Counter)
    for job in chain.lock.runs().values():
        made[job.tool, job.build][job.executable] += 1
    for (program, identifier), runs in made.items():
        path = f"build/bin/{program}"
        if len(runs) > 1:
            yield Link(
                path, f"runs of the build {identifier[:12]} were made by {len(runs)} different executables"
            )
        elif fault := executable_fault(chain, path, identifier):
            yield fault
        elif chain.hashes[path] not in runs:
            yield Link(path, f"is not the executable that made {runs.total()} runs")


def executable_fault(chain: Chain, path: str, identifier: str) -> Link | None:
    """Whether it is what was built here, from what the runs' program was built from."""
    stem = path.replace("build/bin", "build/id")
    identity, stated = ROOT / f"{stem}.json", ROOT / f"{stem}.sha256"
    if not (ROOT / path).exists() or not identity.is_file():
        return unchecked(path, "is not built here")
    try:
        stated_build = json.loads(identity.read_text())
        if not stated_build["build_id"] == build_id(stated_build) == identifier:
            return Link(path, f"is not the build {identifier[:12]} that made the data")
        if not stated.is_file() or stated.read_text().split()[:1] != [chain.hashes[path]]:
            return Link(path, "is not what the linker wrote: edited or replaced")
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return Link(path, f"{stem}.json and .sha256 do not say what it was built from")
    return None


def commits(chain: Chain) -> Iterator[Link]:
    """What is said to be made from a commit must agree with it."""
    jobs = chain.lock.jobs
    kinds = {
        "outside a repository": sum(job.commit is None for job in jobs.values()),
        "with uncommitted changes": sum(bool(job.dirty) for job in jobs.values()),
    }
    reasons = [f"{number} jobs were done {how}" for how, number in kinds.items() if number]
    lacking = no_history()
    if lacking or reasons:
        yield unchecked("sources against their commits", lacking or ", ".join(reasons))
    if lacking:
        return
    for commit in sorted({job.commit for job in jobs.values() if job.commit}):
        clean = {name: job for name, job in jobs.items() if job.commit == commit and not job.dirty}
        yield from against_commit(chain, commit, clean)


def against_commit(chain: Chain, commit: str, jobs: dict[str, Job]) -> Iterator[Link]:
    place = f"commit {commit[:12]}"
    try:
        files = files_at(commit)
    except DamagedError as error:
        yield Link(place, f"cannot be read, as the repository is damaged: {error}")
        return
    if files is None:
        yield Link(place, "is no commit of this repository, and products name it")
        return
    there = {path: hashlib.sha256(content).hexdigest() for path, content in files.items()}
    for name, job in jobs.items():
        for path, digest in made_from(chain, job).items():
            if path not in there:
                yield unchecked(path, f"is not in {place}, by which {name} was made")
            elif there[path] != digest:
                yield Link(place, f"does not hold the {path} that {name} was made from", name)


def made_from(chain: Chain, job: Job) -> dict[str, str]:
    """Sources of a run's build or of a drawing, the configuration, and the files that ran the job."""
    common = job.configuration | job.pipeline
    if job.is_drawing:
        return common | job.sources
    built = chain.lock.builds.get(job.build, {"sources": {}})["sources"]
    return common | {f"cpp/{path}": digest for path, digest in built.items()}
