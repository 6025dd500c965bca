"""Checks of results and figures against the present sources, parameters, build and packages.

A fault is `broken` if a difference was found, and `not checked` if a comparison is impossible.
"""

import re
import tomllib
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib import metadata
from itertools import zip_longest
from pathlib import Path
from typing import Any

from workflow.lib.configuration import at_size
from workflow.lib.figure_metadata import (
    BUILD,
    PACKAGES,
    ROOT,
    MetadataError,
    Parents,
    embedded,
    file_hash,
    read_panel,
    sources_of,
)
from workflow.lib.load import FormatError, load_statements
from workflow.lib.plan import Panel, Run, data_of, data_path, drawings_of
from workflow.provenance.build_id import BuildError, built, sources_of_program

SIZES = (2, 3, 5)  # N at which polynomials are compared


@dataclass(frozen=True)
class Fault:
    path: str
    reason: str
    broken: bool = True

    def __str__(self) -> str:
        return f"{'broken' if self.broken else 'not checked'}: {self.path}: {self.reason}"


@dataclass(frozen=True)
class Products:
    """Results and figures of one quality."""

    quality: str
    plan: dict[str, Panel]

    def is_made(self, panel: str) -> bool:
        """Whether any product of the panel exists. A panel without products is not a fault: a crate may have only some panels."""
        data = [data_path(self.quality, panel, run.name) for run in self.plan[panel].runs]
        return any((ROOT / path).exists() for path in [*data, *drawings_of(self.quality, panel)])

    def faults(self, panel: str) -> Iterator[Fault]:
        """Faults of the results of the panel, then of its figure."""
        for run in self.plan[panel].runs:
            if fault := self.fault_of_result(panel, run):
                yield fault
        if fault := self.fault_of_figure(self.plan[panel]):
            yield fault

    def fault_of_result(self, panel: str, run: Run) -> Fault | None:
        path = data_path(self.quality, panel, run.name)
        if not (ROOT / path).exists():
            return Fault(path, "is missing")
        try:
            stated, parameters, whole = load_statements(ROOT / path)
        except OSError as error:
            return Fault(path, f"cannot be read: {error.strerror}", broken=False)
        except FormatError as error:
            return Fault(path, str(error).removeprefix(f"{ROOT / path}").strip(": "))
        if not whole:
            return Fault(
                path,
                "edited or damaged: its values differ from those written; remove it and run make figures",
            )
        for name, value in run.options.items():
            if name in parameters and not _agree(value, parameters[name]):
                return Fault(path, f"stale: it has --{name} {parameters[name]}, the configuration {value}")
        return _fault_of_build(path, run.program, stated)

    def fault_of_figure(self, panel: Panel) -> Fault | None:
        *files, record = drawings_of(self.quality, panel.name)
        if missing := [path for path in (*files, record) if not (ROOT / path).exists()]:
            return Fault(missing[0], "is missing")
        try:
            stated = read_panel(ROOT / record)
            for path in files:
                if file_hash(ROOT / path) != stated["files"].get(Path(path).name):
                    return Fault(path, f"edited or replaced: it differs from its hash in {Path(record).name}")
            return self._fault_of_parents(panel, stated["parents"], files)
        except MetadataError as error:
            return Fault(record, str(error))
        except OSError as error:
            return Fault(str(error.filename or record), f"cannot be read: {error.strerror}", broken=False)

    def _fault_of_parents(self, panel: Panel, parents: Parents, files: list[str]) -> Fault | None:
        for path in files:
            if embedded(ROOT / path) not in (parents.as_json(), parents.digest()):
                return Fault(
                    path, "edited or replaced: its parents differ from those in the record of the panel"
                )
        picture = files[0]
        if {*parents.data} != {*data_of(self.plan, panel.name, self.quality)}:
            return Fault(picture, "stale: it plots other runs than the configuration")
        if parents.configuration != panel.hash():
            return Fault(picture, "stale: the configuration of the panel has changed")
        for path, one in parents.data.items():
            if not (ROOT / path).exists():
                return Fault(picture, f"its result {path} is missing")
            if _hash(ROOT / path) != one["sha256"]:
                return Fault(picture, f"stale: {path} has changed")
        sources = [*sources_of(f"workflow/figures/{panel.script}.py"), PACKAGES]
        present = {path: _hash(ROOT / path) for path in sources}
        changed = dict(present.items() ^ (parents.sources | {PACKAGES: parents.packages}).items())
        return Fault(picture, f"stale: {min(changed)} has changed") if changed else None

    def obsolete(self) -> Iterator[Fault]:
        """Results and figures of this quality that are not in the plan."""
        known = {path for panel in self.plan for path in data_of(self.plan, panel, self.quality)}
        known |= {path for panel in self.plan for path in drawings_of(self.quality, panel)}
        for pattern in (f"data/{self.quality}/*/*.h5", f"figures/{self.quality}/*.pdf"):
            for path in sorted(str(one.relative_to(ROOT)) for one in ROOT.glob(pattern)):
                if path not in known:
                    yield Fault(path, "is not in the plan: obsolete or misplaced; remove it")


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
            other = (
                f"by another {name.removesuffix('s')}: {stated[name]}, the present build has {build[name]}"
            )
            return Fault(path, other, broken=False)
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
    for one in tomllib.loads((ROOT / PACKAGES).read_text())["package"]:
        locked[one["name"]].add(one.get("version"))
    for package in metadata.distributions():
        name = re.sub(r"[-_.]+", "-", package.metadata["Name"]).lower()
        if name in locked and package.version not in locked[name]:
            return f"{name} {package.version} is installed, {PACKAGES} has {', '.join(locked[name])}"
    return None
