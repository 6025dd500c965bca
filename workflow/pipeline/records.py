"""Records of panels and of the report, which are beside their files."""

import json
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

from workflow.pipeline.plan import Panel, record_of

SHORT = ("accuracy",)  # panels with runs that are too short on purpose


def read_record(path: Path | str) -> dict[str, Any]:
    """Record of a panel or report; empty if it is missing or damaged."""
    with suppress(OSError, ValueError):
        return dict(json.loads(Path(path).read_text("utf-8")))
    return {}


def doubtful(plan: dict[str, Panel], names: Iterable[str], quality: str) -> dict[str, list[str]]:
    """Reasons to doubt a result, by its path, of the results that panels with a present record plot.
    Raises ConfigurationError, OSError."""
    found: dict[str, list[str]] = {}
    for name in names:
        found |= read_record(record_of(plan, name, quality)).get("doubts", {})
    return found
