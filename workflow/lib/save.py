"""Writes a panel: PDF, PNG, SVG and the plotted numbers as CSV, each naming its parents by hash.

Equal inputs give equal bytes: no file holds a time, a host, a user or an absolute path.
"""

import io
from pathlib import Path

from matplotlib.figure import Figure

from workflow.lib.parents import PARENTS_LINE, Parents

CREATOR = "lorentz-gas"


CAPTION_LINE = "# caption: "


def save(figure: Figure, table: str, stem: Path, title: str, caption: str, parents: Parents) -> None:
    """Writes stem.pdf, .png, .svg and .csv, all or none. The table is that of columns.as_csv(), the caption one line."""
    described = parents.as_json()
    pictures = {
        "pdf": {
            "Title": title,
            "Creator": CREATOR,
            "Producer": CREATOR,
            "Subject": described,
            "Keywords": caption,
            "CreationDate": None,
        },
        "png": {"Title": title, "Software": CREATOR, "Description": described, "Comment": caption},
        "svg": {"Title": title, "Creator": CREATOR, "Description": described, "Date": None},
    }
    contents = {kind: _picture(figure, kind, metadata) for kind, metadata in pictures.items()}
    units, numbers = table.split("\n", maxsplit=1)
    contents["csv"] = "\n".join(
        [f"# {title}", PARENTS_LINE + described, units, CAPTION_LINE + caption, numbers]
    ).encode()
    stem.parent.mkdir(parents=True, exist_ok=True)
    unfinished = {kind: stem.with_suffix(f".{kind}.tmp") for kind in contents}
    for kind, path in unfinished.items():
        path.write_bytes(contents[kind])
    for kind, path in unfinished.items():
        path.replace(stem.with_suffix(f".{kind}"))


def _picture(figure: Figure, kind: str, metadata: dict) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format=kind, metadata=metadata)
    return buffer.getvalue()
