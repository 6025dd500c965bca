"""The files that the report is written from: figures in the store, and unmodified results."""

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from workflow.claims.data import Data
from workflow.claims.judge import Judgement, judge_all
from workflow.identity import sha256
from workflow.plan import Panel, stem_of


class ReportError(ValueError):
    """The report cannot be written; the message has the reason and the remedy."""


@dataclass
class Products:
    """Products of a quality. used: hash of each file that was read."""

    root: Path
    quality: str
    plan: dict[str, Panel]
    used: dict[str, str] = field(default_factory=dict)

    def judged(self, data: Data) -> list[Judgement]:
        """All claims. Raises ReportError if a result that they depend on was modified."""
        judgements = judge_all(data)
        if data.damaged:
            raise ReportError(
                f"{data.damaged[0]} is edited or damaged; remove it and run make figures QUALITY={self.quality}"
            )
        for path in {path for judgement in judgements for path in judgement.data}:
            self.read(path)
        return judgements

    def record(self, panel: str) -> dict[str, Any]:
        """Record of a panel. Raises ReportError."""
        record: dict[str, Any] = json.loads(self.read(f"{self.stem(panel)}.json"))
        return record

    def stem(self, panel: str) -> str:
        return stem_of(self.plan, panel, self.quality)

    def read(self, path: str) -> bytes:
        """Content of a result or figure. Raises ReportError if it is missing."""
        try:
            content = (self.root / path).read_bytes()
        except OSError as error:
            raise ReportError(f"{path} is missing; run make figures QUALITY={self.quality}") from error
        self.used[path] = sha256(content)
        return content
