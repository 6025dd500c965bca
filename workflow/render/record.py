"""The record of a panel or of the report, PANEL.IDENTITY.json beside its files: hashes of these and of their
sources, and the results that they are made from.

The identity is a hash of all that determines the files: names of the results, sources, locked packages.
"""

import json
import re
from collections.abc import Iterable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from workflow.lib.identity import IDENTITY, ROOT, identity_of, sha256

FORMATS = ("pdf", "png", "svg", "csv")  # of the files of a panel
SHARED = ("workflow/lib", "workflow/physics", "workflow/render", "uv.lock")  # on which all figures depend
IDENTITY_LINE = re.compile(rf"panel ([\w-]+), quality ([\w=.-]+), identity ({IDENTITY})".encode())


def panel_identity(panel: str, results: Iterable[str], sources: dict[str, str]) -> str:
    """Identity of a panel. results: paths of the plotted results, without their folders; sources:
    sources_of_panel()."""
    return identity_of(panel, ["/".join(Path(path).parts[-2:]) for path in results], sources)


def sources_of_panel(script: str, inputs: Iterable[str] = ()) -> dict[str, str]:
    """Hashes of the script of a panel, a path, of what all scripts share, and of the other files and folders
    that it uses. Raises OSError."""
    return {path: content_hash(path) for path in (script, *SHARED, *inputs)}


def record_name(product: str, identity: str) -> str:
    """Name of the record of a panel or of the report."""
    return f"{product}.{identity}.json"


def read_record(path: Path | str) -> dict[str, Any]:
    """A record; empty if it is missing or damaged."""
    with suppress(OSError, ValueError):
        return dict(json.loads(Path(path).read_text("utf-8")))
    return {}


def identity_line(panel: str, quality: str, identity: str) -> str:
    """Identification line in each file of a panel."""
    return f"panel {panel}, quality {quality}, identity {identity}"


def read_identity_line(content: bytes) -> tuple[str, str, str] | None:
    """Panel, quality and identity that a file of a panel states; None for other files."""
    found = IDENTITY_LINE.search(content)
    return (found[1].decode(), found[2].decode(), found[3].decode()) if found else None


@cache
def content_hash(path: str, root: Path = ROOT) -> str:
    """sha256 of a file, or of names and contents of the files in a folder but hidden ones, backups and
    compiled modules. Raises OSError."""
    if not (root / path).is_dir():
        return sha256((root / path).read_bytes())
    names = sorted(file.relative_to(root).as_posix() for file in (root / path).rglob("*") if file.is_file())
    kept = [name for name in names if not name.endswith("~") and not re.search(r"/\.|__pycache__", name)]
    lines = [f"{name} {sha256((root / name).read_bytes())}\n" for name in kept]
    return sha256("".join(lines).encode())
