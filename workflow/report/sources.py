"""Where the report's content comes from: products that are as they were written, sources, and the cost of the runs."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from workflow.claims.data import Data
from workflow.claims.judge import CLAIMS_FILE, Judgement, judge_all
from workflow.cluster.cost import recorded_seconds
from workflow.lib.citation import CITATION
from workflow.lib.figure_metadata import PACKAGES, MetadataError, file_hash, read_panel, sources_of
from workflow.lib.load import FormatError, load_statements
from workflow.lib.plan import Panel

SCRIPT = "workflow/report/write.py"

Costs = dict[str, float]  # CPU seconds by panel/run


class ReportError(ValueError):
    """The report cannot be written; the message says why and what to do."""


@dataclass
class Products:
    """Figures that are as the record of their panel states, and results that have the values that were written. Each one
    that is used is remembered with its hash."""

    root: Path
    quality: str
    used: dict[str, str] = field(default_factory=dict)
    records: dict[str, dict[str, Any]] = field(
        default_factory=dict
    )  # of panels, as read_panel() returns them

    def judged(self, data: Data) -> list[Judgement]:
        """All claims. Raises ReportError if a result that they rest on is not as it was written."""
        judgements = judge_all(data)
        for path in {path for judgement in judgements for path in judgement.data}:
            self.file(path)
        return judgements

    def record(self, panel: str) -> dict[str, Any]:
        """Raises ReportError."""
        if panel not in self.records:
            path = self.root / f"figures/{self.quality}/{panel}.json"
            try:
                self.records[panel] = read_panel(path)
            except (OSError, MetadataError) as error:
                raise ReportError(f"{panel} is not made, or damaged: run make figures ({error})") from error
        return self.records[panel]

    def file(self, path: str) -> Path:
        """Raises ReportError if it is missing or not as it was written."""
        here = self.root / path
        try:
            if path.startswith("figures/"):
                whole = self.record(here.stem)["files"].get(here.name) == file_hash(here)
            else:
                *_, whole = load_statements(here)
            self.used[path] = file_hash(here)
        except (OSError, FormatError) as error:
            raise ReportError(f"{path} is missing or damaged: run make figures") from error
        if not whole:
            raise ReportError(f"{path} is not as it was written: run make audit, then make figures")
        return here


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
    runs = [(panel.name, run) for panel in plan.values() for run in panel.runs]
    found = {f"{panel}/{run.name}": recorded_seconds(quality, panel, run.name) for panel, run in runs}
    return {name: float(f"{seconds:.3g}") for name, seconds in found.items() if seconds}


def total(costs: Costs, names: Iterable[str]) -> float | None:
    """None where one is not known."""
    names = list(names)
    return sum(costs[name] for name in names) if all(name in costs for name in names) else None
