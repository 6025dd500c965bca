"""Citation metadata of the project."""

from pathlib import Path
from typing import Any

from workflow.configuration import ConfigurationError, read

CITATION = "CITATION.cff"
NEEDED = ("title", "version", "license", "authors")


def citation(root: Path) -> dict[str, Any]:
    """Content of CITATION.cff. Raises ConfigurationError if a needed field is missing."""
    cited: dict[str, Any] = read(root, CITATION).content or {}
    if lacking := [name for name in NEEDED if not cited.get(name)]:
        raise ConfigurationError(f"{CITATION} has no {', '.join(lacking)}: add it")
    return cited
