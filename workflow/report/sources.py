"""The files that the report is written from: unmodified products, and sources."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from workflow.claims.data import Data
from workflow.claims.judge import CLAIMS_FILE, Judgement, judge_all
from workflow.lib.citation import CITATION
from workflow.lib.figure_metadata import PACKAGES, MetadataError, file_hash, read_panel, sources_of
from workflow.lib.load import FormatError, load_statements

SCRIPT = "workflow/report/write.py"


class ReportError(ValueError):
    """The report cannot be written; the message has the reason and the remedy."""


@dataclass
class Products:
    """Figures that agree with the record of their panel, and results that agree with their digest. used: hash of each one."""

    root: Path
    quality: str
    used: dict[str, str] = field(default_factory=dict)
    records: dict[str, dict[str, Any]] = field(default_factory=dict)  # by panel, from read_panel()

    def judged(self, data: Data) -> list[Judgement]:
        """All claims. Raises ReportError if a result that they depend on was modified."""
        judgements = judge_all(data)
        for path in {path for judgement in judgements for path in judgement.data}:
            self.file(path)
        return judgements

    def record(self, panel: str) -> dict[str, Any]:
        """Raises ReportError."""
        if panel not in self.records:
            try:
                self.records[panel] = read_panel(self.root / f"figures/{self.quality}/{panel}.json")
            except (OSError, MetadataError) as error:
                raise ReportError(
                    f"{panel} is missing or damaged ({error}); run make figures QUALITY={self.quality}"
                ) from error
        return self.records[panel]

    def file(self, path: str) -> Path:
        """Raises ReportError if it is missing or modified."""
        here = self.root / path
        try:
            if path.startswith("figures/"):
                whole = self.record(here.stem)["files"].get(here.name) == file_hash(here)
            else:
                *_, whole = load_statements(here)
            self.used[path] = file_hash(here)
        except (OSError, FormatError) as error:
            raise ReportError(
                f"{path} is missing or damaged; run make figures QUALITY={self.quality}"
            ) from error
        if not whole:
            raise ReportError(f"{path} was modified after it was written; run make audit, then make figures")
        return here


def source_hashes(root: Path) -> dict[str, str]:
    """Of modules, templates, texts, the table of claims, the citation and the locked packages."""
    folder = (root / SCRIPT).parent
    beside = [
        str(path.relative_to(root)) for path in folder.rglob("*") if path.is_file() and path.suffix != ".pyc"
    ]
    paths = {*sources_of(SCRIPT), *beside, CLAIMS_FILE, CITATION, PACKAGES}
    return {path: file_hash(root / path) for path in sorted(paths)}
