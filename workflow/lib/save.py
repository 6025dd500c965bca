"""Writes a panel: PDF, PNG, SVG, the plotted numbers as CSV, and its record `<panel>.<identity>.json`.

Equal inputs give equal bytes, except for the commit in the record: no file has a time, host, user or absolute path.
"""

import io
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from workflow.lib.figure_metadata import IDENTITY_LINE, Parents, commit
from workflow.lib.record import write_with_record
from workflow.lib.style import FONTS

CREATOR = "lorentz-gas"


@dataclass(frozen=True)
class Text:
    title: str
    caption: str  # text without line breaks


def save(figure: Figure, table: str, stem: Path, text: Text, parents: Parents) -> None:
    """Writes stem.pdf, .png, .svg, .csv and then their record, all or none. table: text from columns.as_csv()."""
    described = parents.as_json()
    pictures: dict[str, dict[str, Any]] = {
        "pdf": {
            "Title": text.title,
            "Creator": CREATOR,
            "Producer": CREATOR,
            "Subject": described,
            "Keywords": text.caption,
            "CreationDate": None,
        },
        "png": {"Title": text.title, "Software": CREATOR, "Description": described, "Comment": text.caption},
        "svg": {"Title": text.title, "Creator": CREATOR, "Description": described, "Date": None},
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
    head = [f"# {text.title}", units, f"# caption: {text.caption}", IDENTITY_LINE + parents.identity]
    contents["csv"] = "\n".join([*head, numbers]).encode()
    record = {"panel": stem.name, "quality": stem.parent.name, **asdict(text), **commit()}
    files = {stem.with_suffix(f".{kind}"): content for kind, content in contents.items()}
    write_with_record(stem, parents.identity, files, record | {"parents": vars(parents)})


def _picture(figure: Figure, kind: str, metadata: dict[str, Any]) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format=kind, metadata=metadata)
    return _with_fallbacks(buffer.getvalue()) if kind == "svg" else buffer.getvalue()


def _with_fallbacks(picture: bytes) -> bytes:
    """Adds the fallback fonts to formulas, where matplotlib names only one."""
    first, *fallbacks = (name if name == "serif" else f"'{name}'" for name in FONTS)
    only = f"font-family: {first}"
    return picture.replace(f'{only}"'.encode(), f'{", ".join([only, *fallbacks])}"'.encode())
