"""Writes a panel: PDF, PNG, SVG and the plotted numbers as CSV, each stating its parents, and `<panel>.json`, which states all.

Equal inputs give equal bytes: no file but the last, which names the commit, has a time, a host, a user or an absolute path.
"""

import hashlib
import io
import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from workflow.lib.figure_metadata import PARENTS_LINE, Parents, commit
from workflow.lib.files import write_together
from workflow.lib.style import FONTS

CREATOR = "lorentz-gas"


@dataclass(frozen=True)
class Text:
    title: str
    caption: str  # one line


def save(figure: Figure, table: str, stem: Path, text: Text, parents: Parents) -> None:
    """Writes stem.pdf, .png, .svg, .csv and .json, all or none. The table is that of columns.as_csv()."""
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
    for kind, metadata in pictures.items():
        contents[kind] = _picture(figure, kind, metadata)
        figure.set_layout_engine("none")  # that of the first holds for all
    units, numbers = table.split("\n", maxsplit=1)
    head = [f"# {text.title}", units, f"# caption: {text.caption}", PARENTS_LINE + parents.digest()]
    contents["csv"] = "\n".join([*head, numbers]).encode()
    hashes = {
        f"{stem.name}.{kind}": hashlib.sha256(content).hexdigest() for kind, content in contents.items()
    }
    record = {"panel": stem.name, "quality": stem.parent.name, **asdict(text), **commit(), "files": hashes}
    contents["json"] = (
        json.dumps(record | {"parents": vars(parents)}, indent=1, ensure_ascii=False) + "\n"
    ).encode()
    stem.parent.mkdir(parents=True, exist_ok=True)
    write_together({stem.with_suffix(f".{kind}"): content for kind, content in contents.items()})


def _picture(figure: Figure, kind: str, metadata: dict[str, Any]) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format=kind, metadata=metadata)
    return _with_fallbacks(buffer.getvalue()) if kind == "svg" else buffer.getvalue()


def _with_fallbacks(picture: bytes) -> bytes:
    """matplotlib names one font only for the letters of a formula."""
    first, *others = (name if name == "serif" else f"'{name}'" for name in FONTS)
    one = f"font-family: {first}"
    return picture.replace(f'{one}"'.encode(), f'{", ".join([one, *others])}"'.encode())
