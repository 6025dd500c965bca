"""Writes a panel: PDF, PNG, SVG, the plotted numbers as CSV, and their record, PANEL.IDENTITY.json.

Equal inputs give equal bytes, except for the commit in the record: no file has a time, host, user or absolute
path. Each file has a line with panel, quality and identity. A panel has one record, which is written last:
files without it are stale.
"""

import io
import json
import platform
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure
from numpy._core import _multiarray_umath as processor  # type: ignore[attr-defined]

from workflow.lib.identity import ROOT, sha256, siblings
from workflow.render.files import write_atomically
from workflow.render.record import identity_line, record_name

CREATOR = "lorentz-gas"
RENDERING = ("matplotlib", "numpy", "scipy", "pandas", "pillow", "fonttools")  # packages


@dataclass(frozen=True)
class Text:
    title: str
    caption: str  # without line breaks
    parameters: str  # of the plotted runs, in sentences

    def __str__(self) -> str:
        return f"{self.caption} {self.parameters}".rstrip()


@dataclass(frozen=True)
class Parents:
    identity: str  # of the panel
    results: Sequence[Path]
    sources: Mapping[str, str]  # hashes by path
    warnings: Mapping[str, list[str]]  # of results, by path


def save(figure: Figure, table: str, stem: Path, text: Text, parents: Parents) -> None:
    """Writes stem.pdf, .png, .svg, .csv and the record, all or none. table: text from columns.as_csv()."""
    panel, quality = stem.name, stem.parent.name
    line = identity_line(panel, quality, parents.identity)
    pictures: dict[str, dict[str, Any]] = {
        "pdf": {
            "Title": text.title,
            "Creator": CREATOR,
            "Producer": CREATOR,
            "Subject": line,
            "Keywords": str(text),
            "CreationDate": None,
        },
        "png": {"Title": text.title, "Software": CREATOR, "Description": line, "Comment": str(text)},
        "svg": {"Title": text.title, "Creator": CREATOR, "Description": line, "Date": None},
    }
    contents = {}
    if layout := figure.get_layout_engine():
        layout.execute(figure)
    # With a layout engine, savefig would lay the figure out again for every format.
    with mpl.rc_context({"figure.constrained_layout.use": False}):
        figure.set_layout_engine(None)
        for kind, metadata in pictures.items():
            contents[kind] = _picture(figure, kind, metadata)
    units, numbers = table.split("\n", maxsplit=1)
    contents["csv"] = "\n".join(
        [f"# {text.title}", units, f"# caption: {text}", f"# {line}", numbers]
    ).encode()
    record = {"panel": panel, "quality": quality, "identity": parents.identity, **asdict(text)}
    record |= {"commit": commit(), "renderer": renderer(), "warnings": dict(parents.warnings)}
    record |= {"parents": [*map(str, parents.results)], "sources": dict(parents.sources)}
    write_product(stem, parents.identity, contents, record)


def write_product(stem: Path, identity: str, contents: Mapping[str, bytes], record: dict[str, Any]) -> None:
    """Writes the files of a panel or report by kind, and their record, and removes that of former files.
    Raises OSError."""
    record = record | {"files": {kind: sha256(content) for kind, content in contents.items()}}
    text = json.dumps(record, indent=1, ensure_ascii=False) + "\n"
    path = stem.with_name(record_name(stem.name, identity))
    files = {stem.with_name(f"{stem.name}.{kind}"): content for kind, content in contents.items()}
    write_atomically(files | {path: text.encode()})
    for former in (sibling for sibling in siblings(path) if sibling != path):
        former.unlink()


def commit() -> str:
    """Commit of the repository, with -dirty if tracked files have changed; empty without a repository."""
    command = [
        "git",
        "--no-optional-locks",
        "--git-dir=.git",
        "describe",
        "--always",
        "--dirty",
        "--abbrev=40",
        "--exclude=*",
    ]
    try:
        return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()
    except OSError:  # no git
        return ""


def renderer() -> str:
    """What the bytes of a picture depend on besides its parents: Python, processor with the instructions that
    NumPy chooses by it, as others round differently, versions of packages."""
    versions = ", ".join(f"{name} {version(name)}" for name in RENDERING)
    chosen = [
        name
        for name in (*processor.__cpu_baseline__, *processor.__cpu_dispatch__)
        if processor.__cpu_features__[name]
    ]
    return f"Python {platform.python_version()} on {platform.machine()} {' '.join(chosen)}, {versions}"


def _picture(figure: Figure, kind: str, metadata: dict[str, Any]) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format=kind, metadata=metadata)
    return buffer.getvalue()
