"""How the project is cited."""

from pathlib import Path
from typing import Any

import yaml

from workflow.lib.places import damaged, regular

CITATION = "CITATION.cff"
NEEDED = ("title", "version", "license", "authors")


def citation(root: Path) -> dict[str, Any]:
    """CITATION.cff. Raises OSError if it is missing or damaged."""
    path = regular(root / CITATION)
    try:
        cited: dict[str, Any] = yaml.safe_load(path.read_text("utf-8"))
        if lacking := [name for name in NEEDED if not cited[name]]:
            raise ValueError(f"{lacking[0]} is empty")
    except (yaml.YAMLError, ValueError, KeyError, TypeError) as error:
        raise damaged(path, error) from error
    return cited
