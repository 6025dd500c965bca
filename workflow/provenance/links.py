"""The links between sources, builds, configuration, data and figures of one quality, and which are broken."""

import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from workflow.config.plan import Panel, Run, data_of, data_path, drawings_of
from workflow.provenance.build_id import build_id, include_closure, source_hash
from workflow.provenance.lock import Job, Lock, configuration_files
from workflow.provenance.repository import ROOT, FileHashes, files_at, git
from workflow.provenance.sources import sources_of
from workflow.provenance.stale import PACKAGES, argument_difference
from workflow.provenance.testimony import drawing_fault, run_fault

RECORDS = ("lock.json", "verification.json")  # in data/<quality>, which no job makes


@dataclass(frozen=True)
class Link:
    path: str
    message: str
    job: str | None = None  # the job whose product is concerned; none for a source


class Chain:
    def __init__(self, quality: str, plan: dict[str, Panel], lock: Lock) -> None:
        self.quality = quality
        self.plan = plan
        self.lock = lock
        self._hashes = FileHashes()

    def broken(self) -> list[Link]:
        """Each path once, with the first thing that is wrong with it; sources first, figures last."""
        found: dict[str, Link] = {}
        for links in (
            self._records(),
            self._configuration(),
            self._sources(),
            self._builds(),
            self._products(),
            self._runs(),
            self._drawings(),
            self._commits(),
        ):
            for link in links:
                found.setdefault(link.path, link)
        return list(found.values())

    def shown_jobs(self, drawing: Job) -> set[str]:
        return {Path(path).parent.name + "/" + Path(path).stem for path in drawing.parents["data"]}

    def planned(self, name: str) -> Run | None:
        panel, _, run = name.partition("/")
        runs = self.plan[panel].runs if panel in self.plan else ()
        return next((one for one in runs if one.name == run), None)

    def _records(self) -> Iterator[Link]:
        if self.lock.quality != self.quality:
            yield Link(f"data/{self.quality}/lock.json", f"is the lock of quality {self.lock.quality}")

    def _configuration(self) -> Iterator[Link]:
        """Files of the configuration that no longer ask for what was made."""
        for name, job in self.lock.jobs.items():
            if reason := self._no_longer_asked(name, job):
                changed = [path for path, digest in job.configuration.items() if self._hashes[path] != digest]
                for path in changed or configuration_files(self.quality)[:1]:
                    yield Link(path, f"does not ask for what {name} was made with: {reason}")

    def _no_longer_asked(self, name: str, job: Job) -> str | None:
        if job.is_drawing:
            if name not in self.plan:
                return "there is no such panel"
            same = job.parents["configuration"] == self.plan[name].hash()
            return None if same else "the panel has changed"
        run = self.planned(name)
        if run is None:
            return "there is no such run"
        same = job.parents["arguments"] == run.arguments()
        return None if same else argument_difference(job.parents["arguments"], run.arguments())

    def _sources(self) -> Iterator[Link]:
        """Files that have changed since something was made from them."""
        for build in self.lock.builds.values():
            named = {f"cpp/{path}": digest for path, digest in build["sources"].items()}
            yield from self._changed(named, f"{build['program']} was built")
            root = f"observables/{build['program']}.cpp"
            now = include_closure(ROOT / "cpp", root) if self._hashes[f"cpp/{root}"] else []
            for path in sorted({f"cpp/{path}" for path in now} - named.keys()):
                yield Link(path, f"is included by {build['program']} and was not when it was built")
        for name, job in self.lock.drawings().items():
            parents = job.parents
            yield from self._changed(
                parents["sources"] | {PACKAGES: parents["packages"]}, f"{name} was drawn"
            )
            script = f"workflow/scripts/{self.plan[name].script}.py" if name in self.plan else None
            if script and all(self._hashes[path] for path in parents["sources"]):
                for path in sorted(set(sources_of(script)) ^ parents["sources"].keys()):
                    yield Link(path, f"is imported by {script} now or was when {name} was drawn, not both")

    def _changed(self, named: dict[str, str], when: str) -> Iterator[Link]:
        for path, digest in named.items():
            if self._hashes[path] is None:
                yield Link(path, f"is missing; {when} from it")
            elif self._hashes[path] != digest:
                yield Link(path, f"has changed since {when} from it")

    def _builds(self) -> Iterator[Link]:
        programs: dict[str, str] = {}
        for identifier, build in self.lock.builds.items():
            program = build["program"]
            if build_id(build) != identifier or source_hash(build["sources"]) != build["source_hash"]:
                yield Link(
                    f"build {identifier[:12]}", f"of {program} does not follow from its sources and flags"
                )
            if programs.setdefault(program, identifier) != identifier:
                yield Link(f"build {identifier[:12]}", f"of {program}: its products are mixed with another's")
            present = ROOT / f"build/id/{program}.json"
            if present.is_file() and json.loads(present.read_text())["build_id"] != identifier:
                yield Link(f"build/bin/{program}", f"is not the build {identifier[:12]} that made the data")

    def _products(self) -> Iterator[Link]:
        recorded, own = self.lock.outputs(), {f"data/{self.quality}/{name}" for name in RECORDS}
        for name, job in self.lock.jobs.items():
            for path, digest in job.outputs.items():
                if self._hashes[path] is None:
                    yield Link(path, "is missing", name)
                elif self._hashes[path] != digest:
                    yield Link(path, "is not what the job wrote: damaged, edited or replaced", name)
        for place in ("data", "figures"):
            for file in sorted((ROOT / place / self.quality).rglob("*")):
                path = str(file.relative_to(ROOT))
                if file.is_file() and path not in recorded and path not in own:
                    yield Link(path, "has no parents: no job in the lock made it", path)

    def _intact(self, path: str, job: Job) -> bool:
        return self._hashes[path] == job.outputs[path]

    def _runs(self) -> Iterator[Link]:
        for name, job in self.lock.runs().items():
            expected = data_path(self.quality, *name.split("/"))
            if list(job.outputs) != [expected]:
                yield Link(expected, f"the lock names {', '.join(job.outputs)} in its place", name)
            elif job.parents["build_id"] not in self.lock.builds:
                yield Link(expected, "the lock does not say what its build was made from", name)
            elif self._intact(expected, job) and (fault := run_fault(expected, job, self.lock.builds)):
                yield Link(expected, fault, name)

    def _drawings(self) -> Iterator[Link]:
        outputs = self.lock.outputs()
        for name, job in self.lock.drawings().items():
            if sorted(job.outputs) != sorted(drawings_of(self.quality, name)):
                yield Link(f"figures/{self.quality}/{name}", "the lock does not name its four files", name)
            for path in job.outputs:
                if self._intact(path, job) and (fault := drawing_fault(path, job)):
                    yield Link(path, fault, name)
            shown = job.parents["data"]
            for path, data in shown.items():
                if outputs.get(path) != data["sha256"]:
                    yield Link(f"figures/{self.quality}/{name}.pdf", f"was drawn from another {path}", name)
            if name in self.plan and shown.keys() != set(data_of(self.plan, name, self.quality)):
                yield Link(f"figures/{self.quality}/{name}.pdf", "does not show the runs of the panel", name)

    def _commits(self) -> Iterator[Link]:
        """What is said to be made from a commit must agree with it."""
        if git("rev-parse", "--is-shallow-repository") != b"false\n":  # or none at all
            return
        for commit in sorted({job.commit for job in self.lock.jobs.values() if job.commit}):
            files = files_at(commit, "cpp", "workflow", PACKAGES)
            place = f"commit {commit[:12]}"
            if files is None:
                yield Link(place, "is not in this repository, and products name it")
                continue
            there = {path: hashlib.sha256(content).hexdigest() for path, content in files.items()}
            for name, job in self.lock.jobs.items():
                differing = [
                    path for path, digest in self._made_from(job).items() if there.get(path) != digest
                ]
                if job.commit == commit and not job.dirty and differing:
                    yield Link(place, f"does not hold the {differing[0]} that {name} was made from", name)

    def _made_from(self, job: Job) -> dict[str, str]:
        """Sources of a run's build or of a drawing."""
        if job.is_drawing:
            return job.parents["sources"] | {PACKAGES: job.parents["packages"]}
        sources = self.lock.builds.get(job.parents["build_id"], {"sources": {}})["sources"]
        return {f"cpp/{path}": digest for path, digest in sources.items()}
