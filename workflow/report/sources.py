"""The files that the report is written from: unmodified products."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from workflow.claims.data import Data
from workflow.claims.judge import Judgement, judge_all
from workflow.lib.figure_metadata import MetadataError, panel_identity, read_panel
from workflow.lib.files import file_hash
from workflow.lib.load import FormatError, load_statements
from workflow.lib.plan import Panel, data_of
from workflow.lib.record import record_path


class ReportError(ValueError):
    """The report cannot be written; the message has the reason and the remedy."""


@dataclass
class Products:
    """Figures that agree with the record of their panel, and results that agree with their digest. used: hash of each one."""

    root: Path
    quality: str
    plan: dict[str, Panel]
    used: dict[str, str] = field(default_factory=dict)
    records: dict[str, dict[str, Any]] = field(default_factory=dict)  # by panel, from read_panel()

    def judged(self, data: Data) -> list[Judgement]:
        """All claims. Raises ReportError if a result that they depend on was modified."""
        judgements = judge_all(data)
        for path in data.damaged:
            self.file(path)
        for path in {path for judgement in judgements for path in judgement.data}:
            self.file(path)
        return judgements

    def record(self, panel: str) -> dict[str, Any]:
        """Record of a panel, from read_panel(). Raises ReportError."""
        if panel not in self.records:
            try:
                self.records[panel] = read_panel(self.path_of_record(panel))
            except (OSError, MetadataError) as error:
                raise ReportError(
                    f"{panel} is missing, stale or damaged ({error}); run make figures QUALITY={self.quality}"
                ) from error
        return self.records[panel]

    def path_of_record(self, panel: str) -> Path:
        present = panel_identity(panel, self.plan[panel].script, data_of(self.plan, panel, self.quality))
        return record_path(self.root / "figures" / self.quality / panel, present)

    def file(self, path: str) -> Path:
        """Absolute path of a result or figure. Raises ReportError if it is missing or modified."""
        here = self.root / path
        try:
            if path.startswith("figures/"):
                whole = self.record(here.stem)["files"].get(here.name) == file_hash(here)
            else:
                *_, whole = load_statements(here)
            self.used[path] = file_hash(here)
        except (OSError, FormatError) as error:
            raise ReportError(
                f"{path} is missing or damaged; remove it and run make figures QUALITY={self.quality}"
            ) from error
        if not whole:
            raise ReportError(
                f"{path} was modified after it was written; remove it and run make figures QUALITY={self.quality}"
            )
        return here
