"""Copies rendered files from the store, build/figures/QUALITY/NAME.IDENTITY.*, to figures/QUALITY/NAME.* where they differ."""

import json
import sys
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

from workflow.lib.files import in_one_line, write_together

RENDERED = "build/figures"
FIGURES = "figures"
KINDS = ("pdf", "png", "svg", "csv", "html")


def copies(stem: Path) -> dict[Path, Path]:
    """Paths of the copies of a product, with their originals. stem: STORE/QUALITY/NAME.IDENTITY."""
    folder = Path(FIGURES) / stem.parent.name
    originals = [stem.with_name(f"{stem.name}.{kind}") for kind in KINDS]
    return {folder / f"{stem.stem}{path.suffix}": path for path in originals if path.exists()}


def read_record(path: Path | str) -> dict[str, Any]:
    """Record of a panel; empty if it is missing or damaged."""
    with suppress(OSError, ValueError):
        return dict(json.loads(Path(path).read_text("utf-8")))
    return {}


def publish(stems: Iterable[str]) -> None:
    """Copies the files of products where they differ. Raises OSError."""
    for stem in stems:
        contents = {copy: original.read_bytes() for copy, original in copies(Path(stem)).items()}
        write_together({path: content for path, content in contents.items() if not _has(path, content)})


def _has(path: Path, content: bytes) -> bool:
    return path.is_file() and path.read_bytes() == content


if __name__ == "__main__":
    try:
        publish(sys.argv[1:])
    except OSError as error:
        sys.exit(in_one_line(error))
