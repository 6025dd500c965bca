"""Parents of a figure, by hash: embedded in PDF, PNG and SVG, as a digest in CSV, and in full in `<panel>.json`."""

import ast
import hashlib
import json
import logging
import re
import subprocess
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

if TYPE_CHECKING:  # imports that would delay every start of Snakemake by 0.5 s
    from workflow.lib.load import Result

ROOT = Path(__file__).parents[2]
PACKAGES = "uv.lock"
BUILD = ("program", "source_hash", "compiler", "flags", "libraries")
TABLE = re.compile(r'with_name\("([\w.]+)"\)')  # a table that a module reads from its own folder
PARENTS_LINE = "# parents: sha256 "  # of a CSV


class MetadataError(ValueError):
    """A file has no readable record of its parents."""


@dataclass(frozen=True)
class Parents:
    """Inputs of a panel. Paths are relative to the project, hashes are sha256."""

    panel: str
    quality: str
    data: dict[str, dict[str, Any]]  # path: sha256, build_id, seed
    builds: dict[str, dict[str, str]]  # build id: program, source_hash, compiler, flags, libraries
    sources: dict[str, str]  # the script and the modules that it imports
    packages: str  # uv.lock
    python: str  # version
    configuration: str  # of the panel

    @classmethod
    def of(cls, script: str, stem: Path, configuration: str, results: "Sequence[Result]") -> "Parents":
        """Parents of the panel that the script renders to figures/QUALITY/PANEL.*"""
        stated = {str(result.path): result.provenance for result in results}
        return cls(
            panel=stem.name,
            quality=stem.parent.name,
            data={
                path: {"sha256": file_hash(Path(path)), "build_id": one["build_id"], "seed": int(one["seed"])}
                for path, one in stated.items()
            },
            builds={one["build_id"]: {name: one[name] for name in BUILD} for one in stated.values()},
            sources={path: file_hash(ROOT / path) for path in sources_of(script)},
            packages=file_hash(ROOT / PACKAGES),
            python=f"{sys.version_info.major}.{sys.version_info.minor}",
            configuration=configuration,
        )

    @classmethod
    def parse(cls, text: str) -> "Parents":
        """Inverse of as_json. Raises MetadataError."""
        try:
            return cls(**json.loads(text))
        except (ValueError, TypeError) as error:
            raise MetadataError(f"metadata of another version, not readable here: {error}") from error

    def inputs(self) -> dict[str, str]:
        """All input files with their hashes."""
        return (
            {path: one["sha256"] for path, one in self.data.items()}
            | self.sources
            | {PACKAGES: self.packages}
        )

    def as_json(self) -> str:
        return json.dumps(vars(self), sort_keys=True)

    def digest(self) -> str:
        return hashlib.sha256(self.as_json().encode()).hexdigest()


def file_hash(path: Path) -> str:
    """sha256 of the content. Raises OSError."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def digest_of_files(paths: Iterable[str]) -> str:
    """sha256 over names and contents of files of the project. Raises OSError."""
    lines = "".join(f"{path} {file_hash(ROOT / path)}\n" for path in paths)
    return hashlib.sha256(lines.encode()).hexdigest()


def sources_of(script: str) -> list[str]:
    """Sorted paths of the script, of all modules of the project that it imports, directly or indirectly, and of their tables."""
    found: set[str] = set()
    waiting = [script]
    while waiting:
        path = waiting.pop()
        if path not in found and (ROOT / path).is_file():
            found.add(path)
            source = (ROOT / path).read_text("utf-8") if path.endswith(".py") else ""
            waiting += _imported(source)
            waiting += [str(Path(path).with_name(name)) for name in TABLE.findall(source)]
    return sorted(found)


@cache  # panels have most imports in common
def _imported(source: str) -> tuple[str, ...]:
    """Paths of the modules in `import workflow.a.b`, `from workflow.a.b import c` and `from workflow.a import b`."""
    try:
        nodes = [*ast.walk(ast.parse(source))]
    except SyntaxError:  # reported where the script runs
        return ()
    names = [alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names]
    for node in nodes:
        if isinstance(node, ast.ImportFrom) and node.module:
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return tuple(name.replace(".", "/") + ".py" for name in names if name.startswith("workflow."))


def commit() -> dict[str, Any]:
    """Commit of the repository, and whether the tracked files are unchanged; None without a repository."""
    try:
        tracked = _git("ls-files", "Snakefile")
        changed = _git("status", "--porcelain", "--untracked-files=no", "--", ".")
        return {
            "commit": _git("rev-parse", "HEAD") if tracked else None,
            "clean": not changed if tracked else None,
        }
    except (OSError, subprocess.CalledProcessError):
        return {"commit": None, "clean": None}


def _git(*arguments: str) -> str:
    done = subprocess.run(
        ["git", "--no-optional-locks", "-C", ROOT, *arguments], capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


def read_panel(path: Path) -> dict[str, Any]:
    """Reads `<panel>.json`: panel, quality, title, caption, commit, clean, files (name: sha256), parents. Raises MetadataError,
    OSError."""
    try:
        content: dict[str, Any] = json.loads(path.read_text("utf-8"))
        return content | {"parents": Parents(**content["parents"]), "files": dict(content["files"])}
    except (ValueError, TypeError, KeyError) as error:
        raise MetadataError(f"{path} is not the record of a panel: {error}") from error


def embedded(path: Path) -> str:
    """Parents recorded in a file: their JSON, or its digest in a CSV. Raises MetadataError, OSError."""
    readers = {".csv": _of_table, ".svg": _of_svg, ".png": _of_png, ".pdf": _of_pdf}
    if path.suffix not in readers:
        raise MetadataError(f"{path.name} has no provenance: only {', '.join(readers)} and .h5 files have")
    path.open("rb").close()
    try:
        return readers[path.suffix](path)
    except Exception as error:  # the libraries raise many types for a damaged file
        first = (str(error).splitlines() or [type(error).__name__])[0]
        raise MetadataError(f"{path.name} has no provenance: {first}") from error


def _of_table(path: Path) -> str:
    with path.open(encoding="utf-8") as lines:
        return next(line for line in lines if line.startswith(PARENTS_LINE)).split()[-1]


def _of_svg(path: Path) -> str:
    found = ElementTree.parse(path).find(".//{http://purl.org/dc/elements/1.1/}description")
    assert found is not None
    return str(found.text)


def _of_png(path: Path) -> str:
    from PIL import Image  # noqa: PLC0415

    with Image.open(path, formats=["PNG"]) as picture:
        return str(picture.info["Description"])


def _of_pdf(path: Path) -> str:
    from pypdf import PdfReader  # noqa: PLC0415

    logging.getLogger("pypdf").setLevel(logging.CRITICAL)  # the raised error suffices
    return str(PdfReader(path).metadata["/Subject"])  # type: ignore[index]
