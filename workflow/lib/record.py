"""Records of products: a product has a plain name; the name of its record contains the identity of all that determines the product.

The record is the output in the Snakemake workflow: if it is missing, the product is made again.
"""

import glob
import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from workflow.lib.files import content_hash, file_hash, write_together
from workflow.lib.identity import IDENTITY


def record_path(stem: Path, identity_of_panel: str) -> Path:
    """Path of the record of the products stem.*, which contains their identity."""
    return stem.with_name(f"{stem.name}.{identity_of_panel}.json")


def records_of(stem: Path) -> list[Path]:
    """Records of products stem.*, of any identity."""
    name = re.compile(rf"{re.escape(stem.name)}\.{IDENTITY}\.json")
    return sorted(
        path for path in stem.parent.glob(f"{glob.escape(stem.name)}*.json") if name.fullmatch(path.name)
    )


def is_whole(record: Path) -> bool:
    """Whether all files of a record have the hashes that it states."""
    try:
        files = json.loads(record.read_text("utf-8"))["files"]
        return all(file_hash(record.parent / name) == digest for name, digest in files.items())
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return False


def write_with_record(
    stem: Path, identity: str, contents: Mapping[Path, bytes], record: Mapping[str, Any]
) -> None:
    """Writes the files, then their record with the sha256 of each. Former records are removed before the first file is replaced, so
    that no record is beside files of another identity. Names of files are relative to the folder of the record. Raises OSError."""
    files = {str(path.relative_to(stem.parent)): content_hash(content) for path, content in contents.items()}
    stated = json.dumps({**record, "identity": identity, "files": files}, indent=1, ensure_ascii=False) + "\n"
    for path in contents:
        path.parent.mkdir(parents=True, exist_ok=True)
    write_together({**contents, record_path(stem, identity): stated.encode()}, instead_of=records_of(stem))
