"""What a figure was made from, and where PDF, PNG, SVG and CSV say it."""

import hashlib
import json
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from workflow.lib.places import regular

PACKAGES = "requirements.lock"
PARENTS_LINE = "# parents: "  # of a CSV
CAPTION_LINE = "# caption: "  # of a CSV
DATA: dict[str, type] = {"sha256": str, "build_id": str, "seed": int}
BUILD: dict[str, type] = {"program": str, "source_hash": str, "compiler": str, "flags": str, "libraries": str}


class ArtefactError(ValueError):
    """A file does not say what it was made from."""


@dataclass(frozen=True)
class Parents:
    """Paths are relative to the project, hashes are sha256."""

    panel: str
    quality: str
    data: dict[str, dict[str, Any]]  # path: sha256, build_id, seed
    builds: dict[str, dict[str, Any]]  # build id: program, source_hash, compiler, flags, libraries
    sources: dict[str, str]  # script and the modules that it imports
    packages: str  # the locked Python packages
    python: str  # version, which chooses among them
    configuration: str  # of the panel

    def inputs(self) -> dict[str, str]:
        """Every file that the figure was drawn from, with its hash."""
        data = {path: each["sha256"] for path, each in self.data.items()}
        return data | self.sources | {PACKAGES: self.packages}

    def as_json(self) -> str:
        return json.dumps(vars(self), sort_keys=True)

    @staticmethod
    def of(path: Path) -> "Parents":
        """Raises ArtefactError if the file is missing, damaged, or names no parents."""
        if not path.is_file():
            raise ArtefactError(
                f"{path} names no parents: {'not a file' if path.exists() else 'No such file'}"
            )
        try:
            content = json.loads(_described(path))
        except Exception as error:  # a hostile file may raise anything in the libraries that read pictures
            first = (str(error).splitlines() or [type(error).__name__])[0]
            raise ArtefactError(f"{path} names no parents: {first}") from error
        if not _is_complete(content):
            raise ArtefactError(f"{path} names no parents as this version does: draw it again")
        return Parents(**content)


def caption_of(table: Path) -> str:
    """What the CSV of a panel says of it; nothing before it is drawn."""
    lines = table.read_text("utf-8", "replace").splitlines() if table.is_file() else []
    return "".join(line.removeprefix(CAPTION_LINE) for line in lines if line.startswith(CAPTION_LINE))


def file_hash(path: Path) -> str:
    with regular(path).open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _is_complete(content: Any) -> bool:
    """Whether it has every field of Parents, each of its type, and a build for all data."""
    if not isinstance(content, dict) or content.keys() != {field.name for field in fields(Parents)}:
        return False
    words = ("panel", "quality", "packages", "python", "configuration")
    kinds = [(content["data"], DATA), (content["builds"], BUILD)]
    return (
        all(isinstance(content[name], str) for name in words)
        and isinstance(content["sources"], dict)
        and all(isinstance(digest, str) for digest in content["sources"].values())
        and all(
            isinstance(every, dict) and all(_has(one, kind) for one in every.values())
            for every, kind in kinds
        )
        and all(one["build_id"] in content["builds"] for one in content["data"].values())
    )


def _has(one: Any, kind: dict[str, type]) -> bool:
    return isinstance(one, dict) and {name: type(value) for name, value in one.items()} == kind


def _described(path: Path) -> str:
    """The JSON text, from the place where each format keeps it."""
    readers = {".csv": _of_table, ".svg": _of_svg, ".png": _of_png, ".pdf": _of_pdf}
    if path.suffix not in readers:
        raise ValueError(f"only {', '.join(readers)} and .h5 files do")
    return readers[path.suffix](path)


def _of_table(path: Path) -> str:
    with path.open(encoding="utf-8") as lines:
        lines.readline()
        line = lines.readline()
    if not line.startswith(PARENTS_LINE):
        raise ValueError(f"the second line does not begin with '{PARENTS_LINE.strip()}'")
    return line.removeprefix(PARENTS_LINE)


def _of_svg(path: Path) -> str:
    found = ElementTree.parse(path).find(".//{http://purl.org/dc/elements/1.1/}description")
    if found is None or found.text is None:
        raise ValueError("it has no description")
    return found.text


# The libraries that read pictures are imported late: the lock, which reads tables only, starts for every job.
def _of_png(path: Path) -> str:
    from PIL import Image  # noqa: PLC0415

    with Image.open(path, formats=["PNG"]) as picture:
        return str(picture.info["Description"])


def _of_pdf(path: Path) -> str:
    from pypdf import PdfReader  # noqa: PLC0415

    metadata = PdfReader(path).metadata
    if metadata is None or metadata.subject is None:
        raise ValueError("it has no subject")
    return metadata.subject
