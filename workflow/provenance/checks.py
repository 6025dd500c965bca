"""Checks of results and figures against the present sources, parameters, build and packages.

The names of products have the identity of what determines them. Where the planned one is missing, another one of its run or panel
is compared, so that the difference can be named.
"""

import re
import tomllib
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from functools import cache
from importlib import metadata
from itertools import zip_longest
from pathlib import Path
from typing import Any

from workflow.lib.closure import PACKAGES, hashes_of
from workflow.lib.figure_metadata import (
    BUILD,
    MetadataError,
    Parents,
    embedded,
    panel_identity,
    read_panel,
)
from workflow.lib.files import ROOT, file_hash
from workflow.lib.identity import IDENTITY
from workflow.lib.load import FormatError, load_statements
from workflow.lib.plan import Panel, Run, data_path, with_used
from workflow.lib.polynomial import at_size
from workflow.lib.record import record_path, records_of
from workflow.provenance.build_id import BuildError, built, sources_of_program

SIZES = (2, 3, 5)  # N at which polynomials are compared


class Kind(Enum):
    BROKEN = "broken"
    UNCHECKED = "not checked"  # a comparison is impossible
    OBSOLETE = "obsolete"  # no plan names it


@dataclass(frozen=True)
class Fault:
    path: str
    reason: str
    kind: Kind = Kind.BROKEN

    def __str__(self) -> str:
        return f"{self.kind.value}: {self.path}: {self.reason}"


@dataclass(frozen=True)
class Products:
    """Results and figures of one quality, with the effort of the command line."""

    quality: str
    plan: dict[str, Panel]

    def results_of(self, panel: str) -> list[str]:
        """Paths of the results that a panel plots."""
        return [self.result(used.name, run) for used in with_used(self.plan, panel) for run in used.runs]

    def result(self, panel: str, run: Run) -> str:
        """Path of the result of a run: the planned one, or else the most recent of this run, preferably one without faults."""
        try:
            planned = data_path(self.quality, panel, run)
        except BuildError:  # an unpacked crate has no build
            planned = f"data/{self.quality.partition('_')[0]}/{panel}/{run.name}.h5"
        if _there(planned):
            return planned
        pattern = re.compile(rf"{re.escape(run.name)}\.{IDENTITY}\.h5")
        existing = [path for path in (ROOT / planned).parent.glob("*.h5") if pattern.fullmatch(path.name)]
        fitting = [path for path in existing if not self._fault(str(path.relative_to(ROOT)), run)]
        latest = max(fitting or existing, key=lambda path: path.stat().st_mtime, default=ROOT / planned)
        return str(latest.relative_to(ROOT))

    def stem(self, panel: str) -> str:
        return f"figures/{self.quality}/{panel}"

    def record(self, panel: Panel) -> str:
        """Path of the record of a panel: that of its present results and sources, or else a former one."""
        present = panel_identity(panel.name, panel.script, self.results_of(panel.name))
        path = record_path(Path(self.stem(panel.name)), present)
        records = [] if (ROOT / path).exists() else records_of(ROOT / self.stem(panel.name))
        return str(records[0].relative_to(ROOT)) if records else str(path)

    def files_of(self, panel: Panel) -> list[str]:
        """Paths of the figure files of a panel, then of their record. Raises MetadataError, OSError."""
        record = self.record(panel)
        return [*(f"figures/{self.quality}/{name}" for name in read_panel(ROOT / record)["files"]), record]

    def is_made(self, panel: str) -> bool:
        """Whether any product of the panel exists. A panel without products is not a fault: a crate may have only some panels."""
        data = [self.result(panel, run) for run in self.plan[panel].runs]
        return any(map(_there, data)) or bool(records_of(ROOT / self.stem(panel)))

    def faults(self, panel: str) -> Iterator[Fault]:
        """Faults of the results that the panel plots, then of its figure."""
        for used in with_used(self.plan, panel):
            for run in used.runs:
                if fault := self.fault_of_result(used.name, run):
                    yield fault
        if fault := self.fault_of_figure(self.plan[panel]):
            yield fault

    def fault_of_result(self, panel: str, run: Run) -> Fault | None:
        return self._fault(self.result(panel, run), run)

    def _fault(self, path: str, run: Run) -> Fault | None:
        if not _there(path):
            return Fault(path, "is missing")
        try:
            stated, parameters, whole = load_statements(ROOT / path)
        except OSError as error:
            return Fault(path, f"cannot be read: {error.strerror}", Kind.UNCHECKED)
        except FormatError as error:
            return Fault(
                path,
                str(error)
                .removeprefix(f"{ROOT / path}")
                .strip(": ")
                .replace("make it again", f"run make figures QUALITY={self.quality}"),
            )
        if not whole:
            reason = "edited or damaged: its values differ from those written"
            return Fault(path, f"{reason}; remove it and run make figures QUALITY={self.quality}")
        for name, value in run.options.items():
            if name in parameters and not _agree(value, parameters[name]):
                return Fault(path, f"stale: it has --{name} {parameters[name]}, the configuration {value}")
        return _fault_of_build(path, run.program, stated)

    def fault_of_figure(self, panel: Panel) -> Fault | None:
        record = self.record(panel)
        if not _there(record):
            return Fault(record, "is missing")
        try:
            stated = read_panel(ROOT / record)
            files = {str(Path(record).with_name(name)): digest for name, digest in stated["files"].items()}
            for path, digest in files.items():
                if not _there(path):
                    return Fault(path, "is missing")
                if file_hash(ROOT / path) != digest:
                    reason = f"edited or replaced: it differs from its hash in {Path(record).name}; run make figures QUALITY={self.quality}"
                    return Fault(path, reason)
            return self._fault_of_parents(panel, stated["parents"], [*files])
        except MetadataError as error:
            return Fault(record, str(error))
        except OSError as error:
            reason = f"cannot be read: {error.strerror}"
            return Fault(str(error.filename or record), reason, Kind.UNCHECKED)

    def _fault_of_parents(self, panel: Panel, parents: Parents, files: list[str]) -> Fault | None:
        for path in files:
            if embedded(ROOT / path) not in (parents.as_json(), parents.identity):
                reason = f"edited or replaced: its parents differ from those in its record; remove it and run make figures QUALITY={self.quality}"
                return Fault(path, reason)
        picture, present = files[0], self.results_of(panel.name)
        if differing := [*({*parents.data} ^ {*present})]:
            return Fault(picture, f"stale: it plots other results than the configuration: {min(differing)}")
        for path, result in parents.data.items():
            if not _there(path):
                return Fault(picture, f"its result {path} is missing")
            if _hash(ROOT / path) != result["sha256"]:
                return Fault(picture, f"stale: {path} has changed")
        sources = hashes_of(f"workflow/figures/{panel.script}.py")
        changed = dict(sources.items() ^ parents.sources.items())
        return Fault(picture, f"stale: {min(changed)} has changed") if changed else None


def _there(path: str) -> bool:
    """Whether a file exists; true if its folder cannot be read, so that reading the file states why."""
    try:
        return (ROOT / path).exists()
    except OSError:
        return True


@cache
def _hash(path: Path) -> str:
    return file_hash(path)


def _fault_of_build(path: str, program: str, stated: dict[str, Any]) -> Fault | None:
    if stated["program"] != program:
        return Fault(path, f"was written by {stated['program']}, not by {program}")
    if stated["source_hash"] != _source_hash(program):
        return Fault(path, f"stale: the sources of {program} have changed")
    try:
        build = _built(program)
    except BuildError:  # an unpacked crate has no build: its sources decide
        return None
    for name in BUILD:
        if build[name] != stated[name]:
            reason = (
                f"by another {name.removesuffix('s')}: {stated[name]}, the present build has {build[name]}"
            )
            return Fault(path, reason, Kind.UNCHECKED)
    return None


_source_hash = cache(sources_of_program)
_built = cache(built)


def _agree(option: Any, stated: Any) -> bool:
    """Whether an option has the value that a file states in canonical form."""
    if str(option) == str(stated):
        return True
    pairs = [*zip_longest(str(option).split(","), str(stated).split(","), fillvalue="nan")]
    return all(at_size(one, size) == at_size(other, size) for one, other in pairs for size in SIZES)


@cache
def other_package() -> str | None:
    """First installed package whose version is not the locked one."""
    locked = defaultdict(set)
    for entry in tomllib.loads((ROOT / PACKAGES).read_text())["package"]:
        locked[entry["name"]].add(entry.get("version"))
    for package in metadata.distributions():
        name = re.sub(r"[-_.]+", "-", package.metadata["Name"]).lower()
        if name in locked and package.version not in locked[name]:
            return f"{name} {package.version} is installed, {PACKAGES} has {', '.join(locked[name])}"
    return None
