"""Which jobs have to run again, and why: whatever does not follow from what is there now.

Decided by content alone, so that neither time stamps nor copies nor identical builds make anything run.
Run by make before Snakemake: python -m workflow.provenance.stale moves the outputs of stale jobs to
build/replaced, and Snakemake makes what is missing.
"""

import argparse
import json
from collections.abc import Iterable

from workflow.config.plan import (
    ConfigurationError,
    Panel,
    Run,
    data_of,
    data_path,
    drawings_of,
    load_plan,
    with_used,
)
from workflow.provenance.lock import Lock, LockError, changing
from workflow.provenance.repository import ROOT, FileHashes
from workflow.provenance.sources import sources_of

PACKAGES = "requirements.lock"
REPLACED = "build/replaced"


class Staleness:
    """Reasons by job; the jobs are those of the lock, `panel/run` and `panel`."""

    def __init__(self, quality: str, plan: dict[str, Panel]) -> None:
        self.quality = quality
        self.plan = plan
        try:
            self.lock = Lock.read(quality)
        except LockError:
            self.lock = Lock(quality)
        self._hashes = FileHashes()

    def reasons(self, panels: Iterable[str]) -> dict[str, str]:
        """Stale jobs of the panels, each with its first reason, runs before the drawings that show them."""
        found: dict[str, str] = {}
        for name in panels:
            for panel in with_used(self.plan, name):
                for run in panel.runs:
                    if reason := self._run_reason(panel, run):
                        found[f"{panel.name}/{run.name}"] = reason
        return found | {name: reason for name in panels if (reason := self._drawing_reason(name, found))}

    def outputs(self, job: str) -> list[str]:
        panel, _, run = job.partition("/")
        return [data_path(self.quality, panel, run)] if run else drawings_of(self.quality, panel)

    def _product_reason(self, job: str) -> str | None:
        recorded = self.lock.jobs.get(job)
        for path in self.outputs(job):
            if self._hashes[path] is None:
                return f"{path} is missing"
            if recorded is None:
                return f"{path} has no record in the lock"
            if self._hashes[path] != recorded.outputs.get(path):
                return f"{path} is not what the job wrote"
        return None

    def _run_reason(self, panel: Panel, run: Run) -> str | None:
        job = f"{panel.name}/{run.name}"
        if reason := self._product_reason(job):
            return reason
        parents = self.lock.jobs[job].parents
        build = json.loads((ROOT / f"build/id/{run.program}.json").read_text())
        if parents["build_id"] != build["build_id"]:
            return build_difference(self.lock.builds.get(parents["build_id"], {}), build)
        if parents["arguments"] != run.arguments():
            return f"parameters changed: {argument_difference(parents['arguments'], run.arguments())}"
        return None

    def _drawing_reason(self, name: str, stale: dict[str, str]) -> str | None:
        for panel in with_used(self.plan, name):
            for run in panel.runs:
                if f"{panel.name}/{run.name}" in stale:
                    return f"{data_path(self.quality, panel.name, run.name)} has to be made again"
        return self._product_reason(name) or self._parents_reason(name)

    def _parents_reason(self, name: str) -> str | None:
        parents = self.lock.jobs[name].parents
        sources = sources_of(f"workflow/scripts/{self.plan[name].script}.py")
        for path in sorted({*sources, *parents["sources"]}):
            if parents["sources"].get(path) != (self._hashes[path] if path in sources else None):
                return f"{path} changed"
        if parents["packages"] != self._hashes[PACKAGES]:
            return f"{PACKAGES} changed"
        if parents["configuration"] != self.plan[name].hash():
            return "the panel's configuration changed"
        shown = {path: self._hashes[path] for path in data_of(self.plan, name, self.quality)}
        if {path: data["sha256"] for path, data in parents["data"].items()} != shown:
            return "drawn from other data"
        return None


def build_difference(old: dict, new: dict) -> str:
    """What made the build id differ."""
    before, after = old.get("sources", {}), new["sources"]
    for path in sorted({*before, *after}):
        if before.get(path) != after.get(path):
            return f"cpp/{path} changed"
    for name in ("compiler", "flags", "libraries", "version"):
        if old.get(name) != new[name]:
            return f"{name} of {new['program']} changed: {old.get(name)} to {new[name]}"
    return f"{new['program']} changed"


def argument_difference(old: str, new: str) -> str:
    """The first option that differs."""
    before, after = (dict(word.partition(" ")[::2] for word in text.split("--")[1:]) for text in (old, new))
    for name in sorted({*before, *after}):
        values = [values[name].strip() if name in values else "absent" for values in (before, after)]
        if values[0] != values[1]:
            return f"--{name} from {values[0]} to {values[1]}"
    return "their order"


def set_aside(paths: Iterable[str]) -> bool:
    """Moves what there is of the paths to build/replaced; false if there is nothing."""
    present = [path for path in paths if (ROOT / path).exists()]
    for path in present:
        (ROOT / REPLACED / path).parent.mkdir(parents=True, exist_ok=True)
        (ROOT / path).replace(ROOT / REPLACED / path)
    return bool(present)


def retire(quality: str, plan: dict[str, Panel]) -> None:
    """Products of jobs that the configuration no longer asks for leave the data, the figures and the lock."""
    asked = {*plan, *(f"{name}/{run.name}" for name, panel in plan.items() for run in panel.runs)}
    try:
        unasked = Lock.read(quality).jobs.keys() - asked
    except LockError:
        return
    if not unasked:
        return
    with changing(quality) as lock:
        for name in sorted(unasked):
            set_aside(lock.jobs.pop(name).outputs)
            print(f"{name} is not asked for any more: moved to {REPLACED}")


def main() -> None:
    parser = argparse.ArgumentParser(description="Moves products that have to be made again out of the way")
    parser.add_argument("--quality", required=True)
    parser.add_argument("--panel", help="this panel only")
    options = parser.parse_args()
    try:
        plan = load_plan(options.quality)
    except ConfigurationError:
        return  # Snakemake says what is wrong
    if options.panel and options.panel not in plan:
        return
    staleness = Staleness(options.quality, plan)
    for job, reason in staleness.reasons([options.panel] if options.panel else plan).items():
        if set_aside(staleness.outputs(job)):
            print(f"{job} is made again: {reason}")
    if not options.panel:
        retire(options.quality, plan)


if __name__ == "__main__":
    main()
