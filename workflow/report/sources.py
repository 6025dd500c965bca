"""Where the report's content comes from: products that are what their jobs wrote, sources, and what the runs cost."""

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from workflow.claims.data import Data
from workflow.claims.judge import CLAIMS_FILE, Judgement, judge_all
from workflow.lib.citation import CITATION
from workflow.lib.costs import cost_file
from workflow.lib.parents import PACKAGES, file_hash
from workflow.lib.plan import Panel
from workflow.provenance.lock import Lock, LockError
from workflow.provenance.sources import sources_of

SCRIPT = "workflow/report/write.py"
PARENTS = re.compile(r'<script type="application/json" id="parents">(.*?)</script>', re.DOTALL)

Costs = dict[str, float]  # CPU seconds by panel/run


class ReportError(ValueError):
    """The report cannot be written; the message says why and what to do."""


@dataclass
class Products:
    """Files that jobs wrote. Every one that is asked for is compared with the lock, and remembered with its hash."""

    root: Path
    lock: Lock
    used: dict[str, str] = field(default_factory=dict)

    @classmethod
    def of(cls, quality: str, root: Path) -> "Products":
        """Raises ReportError if there is no lock that can be read."""
        try:
            return cls(root, Lock.read(quality))
        except LockError as error:
            raise ReportError(f"{error}: run make figures") from error

    def judged(self, data: Data) -> list[Judgement]:
        """All claims, by files that are what their jobs wrote. Raises ReportError."""
        judgements = judge_all(data)
        for path in {path for judgement in judgements for path in judgement.data}:
            self.file(path)
        return judgements

    def file(self, path: str) -> Path:
        """Raises ReportError if it is not what its job wrote."""
        recorded, place = self.lock.outputs().get(path), self.root / path
        found = file_hash(place) if place.is_file() else None
        if found is None or found != recorded:
            raise ReportError(
                f"{path} is {'missing' if found is None else 'not what its job wrote'}: run make figures"
            )
        self.used[path] = found
        return place


def source_hashes(root: Path) -> dict[str, str]:
    """Of modules, templates, the table of claims, the citation and the locked packages."""
    folder = (root / SCRIPT).parent
    beside = [
        str(path.relative_to(root))
        for each in (folder, folder / "pages")
        for path in sorted(each.iterdir())
        if path.is_file()
    ]
    paths = {*sources_of(SCRIPT), *beside, CLAIMS_FILE, CITATION, PACKAGES}
    return {path: file_hash(root / path) for path in sorted(paths)}


def measured_costs(quality: str, plan: Mapping[str, Panel]) -> Costs:
    """Those that are known, to three digits."""
    names = [(panel.name, run.name) for panel in plan.values() for run in panel.runs]
    found = {f"{panel}/{run}": cost_file(quality, panel, run) for panel, run in names}
    return {name: float(f"{cost['cpu_seconds']:.3g}") for name, cost in found.items() if cost}


def parents_in(report: Path) -> dict[str, Any]:
    """What a report says that it was written from. Raises ReportError."""
    try:
        found = PARENTS.search(report.read_text())
        return json.loads(found[1]) if found else {}
    except (OSError, ValueError) as error:
        raise ReportError(f"{report} does not say what it was written from: {error}") from error


def total(costs: Costs, names: Iterable[str]) -> float | None:
    """None where one is not known."""
    names = list(names)
    return sum(costs[name] for name in names) if all(name in costs for name in names) else None
