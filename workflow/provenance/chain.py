"""The chain from sources to figures, job by job: what a product was made from against what is there now.

Decided by content alone, so that neither time stamps nor copies nor identical builds make anything run again.
"""

import json
from collections.abc import Iterable, Iterator

from workflow.lib.options import Options
from workflow.lib.parents import PACKAGES
from workflow.lib.plan import Panel, Run, data_of, data_path, outputs_of, with_used
from workflow.provenance.build_id import include_closure
from workflow.provenance.job import Job
from workflow.provenance.lock import Lock, LockError
from workflow.provenance.repository import ROOT, FileHashes
from workflow.provenance.sources import sources_of


class Chain:
    """Jobs are named as in the lock: `panel/run`, and `panel` for a drawing."""

    def __init__(self, quality: str, plan: dict[str, Panel], lock: Lock | None = None) -> None:
        """Where no lock is given it is read; one that cannot be read is taken as empty."""
        self.quality = quality
        self.plan = plan
        try:
            self.lock = lock or Lock.read(quality)
        except LockError:
            self.lock = Lock(quality)
        self.hashes = FileHashes()
        self._program_sources: dict[str, dict[str, str | None]] = {}

    def stale(self, panels: Iterable[str]) -> dict[str, str]:
        """Stale jobs of the panels, each with its first reason, runs before the drawings that show them."""
        panels = list(panels)
        runs = [f"{used}/{run.name}" for name in panels for used, run in self._shown(name)]
        return {job: reason for job in dict.fromkeys([*runs, *panels]) if (reason := self.reason(job))}

    def reason(self, name: str) -> str | None:
        """Why the job has to run again; none if it has not."""
        run = self.planned(name)
        if run is None:
            for panel, shown in self._shown(name):
                if self.reason(f"{panel}/{shown.name}"):
                    return f"{data_path(self.quality, panel, shown.name)} has to be made again"
        job = self.lock.jobs.get(name)
        for path in self.outputs(name):
            if self.hashes[path] is None:
                return f"{path} is missing"
            if job is None:
                return f"{path} has no record in the lock"
            if self.hashes[path] != job.outputs.get(path):
                return f"{path} is not what the job wrote"
        changed = self.changed_build(self.lock.jobs[name]) if run else next(self.changed_inputs(name), None)
        return changed or self.changed_request(name)

    def unmade(self, panel: str) -> bool:
        """Whether nothing of the panel's own is here, neither a result nor a drawing."""
        jobs = [panel, *(f"{panel}/{run.name}" for run in self.plan[panel].runs)]
        return not any(self.hashes[path] for job in jobs for path in self.outputs(job))

    def planned(self, name: str) -> Run | None:
        panel, _, run = name.partition("/")
        runs = self.plan[panel].runs if panel in self.plan else ()
        return next((one for one in runs if one.name == run), None)

    def outputs(self, name: str) -> list[str]:
        return outputs_of(self.quality, name)

    def sources(self, name: str) -> list[str]:
        """The script that draws the panel, and what it imports."""
        return sources_of(f"workflow/figures/{self.plan[name].script}.py")

    def program_sources(self, program: str) -> dict[str, str | None]:
        """Files below cpp that the program is built from, with their hashes; empty if there is no such program."""
        if program not in self._program_sources:
            root = f"observables/{program}.cpp"
            there = (ROOT / "cpp" / root).is_file()
            paths = include_closure(ROOT / "cpp", root) if there else []
            self._program_sources[program] = {path: self.hashes[f"cpp/{path}"] for path in paths}
        return self._program_sources[program]

    def changed_inputs(self, name: str) -> Iterator[str]:
        """Of a drawing: files that it would be made from now, or was made from, and that are not the same."""
        before = self.lock.jobs[name].inputs
        paths = [*self.sources(name), PACKAGES, *data_of(self.plan, name, self.quality)]
        now = {path: self.hashes[path] for path in paths}
        return (f"{path} changed" for path in sorted({*before, *now}) if before.get(path) != now.get(path))

    def changed_request(self, name: str) -> str | None:
        """What the configuration asks for against what was made."""
        job, run = self.lock.jobs[name], self.planned(name)
        if job.is_drawing:
            if name not in self.plan:
                return "there is no such panel"
            same = job.options == {"configuration": self.plan[name].hash()}
            return None if same else "the panel's configuration changed"
        if run is None:
            return "there is no such run"
        difference = difference_of(job.options, run.options)
        return f"parameters changed: {difference}" if difference else None

    def changed_build(self, job: Job) -> str | None:
        """A source of the executable that differs, or another part of its build id where it is built."""
        old = self.lock.builds.get(job.build, {})
        before, after = old.get("sources", {}), self.program_sources(job.tool)
        for path in sorted({*before, *after}):
            if before.get(path) != after.get(path):
                return f"cpp/{path} changed"
        identity = ROOT / f"build/id/{job.tool}.json"
        try:
            build = json.loads(identity.read_text()) if identity.is_file() else None
            if build is None or build["build_id"] == job.build_id:
                return None
            for part in ("compiler", "flags", "libraries", "version"):
                if old.get(part) != build[part]:
                    return f"{part} of {job.tool} changed: {old.get(part)} to {build[part]}"
        except (ValueError, KeyError, TypeError, RecursionError):
            return f"build/id/{job.tool}.json does not say what was built"
        return f"{job.tool} changed"

    def _shown(self, name: str) -> Iterator[tuple[str, Run]]:
        """Runs that a panel shows, each with the panel that it belongs to."""
        return ((panel.name, run) for panel in with_used(self.plan, name) for run in panel.runs)


def difference_of(old: Options, new: Options) -> str | None:
    """The first option that differs."""
    for name in sorted({*old, *new}):
        before, after = (options.get(name, "absent") for options in (old, new))
        if before != after:
            return f"--{name} from {before} to {after}"
    return None
