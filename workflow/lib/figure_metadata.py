"""Where a figure comes from: its parents, by hash, embedded in PDF, PNG and SVG and stated in full in `<panel>.json`.

A CSV states one digest of the parents.
"""

import ast
import hashlib
import json
import logging
import subprocess
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

if TYPE_CHECKING:  # its libraries take half a second, which every start of Snakemake would pay
    from workflow.lib.load import Result

ROOT = Path(__file__).parents[2]
PACKAGES = "uv.lock"
BUILD = ("program", "source_hash", "compiler", "flags", "libraries")
PARENTS_LINE = "# parents: sha256 "  # of a CSV


class MetadataError(ValueError):
    """A file does not state its parents."""


@dataclass(frozen=True)
class Parents:
    """Paths are relative to the project, hashes are sha256."""

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
        """Of the panel that a script renders to figures/QUALITY/PANEL.*"""
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
        """Raises MetadataError."""
        try:
            return cls(**json.loads(text))
        except (ValueError, TypeError) as error:
            raise MetadataError(f"other metadata than this version writes: {error}") from error

    def inputs(self) -> dict[str, str]:
        """Every file that the figure was made from, with its hash."""
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
    """sha256. Raises OSError."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def digest_of_files(paths: Iterable[str]) -> str:
    """One sha256 over files of the project, by name and content. Raises OSError."""
    lines = "".join(f"{path} {file_hash(ROOT / path)}\n" for path in paths)
    return hashlib.sha256(lines.encode()).hexdigest()


def sources_of(script: str) -> list[str]:
    """Paths of the script and of every module of the project that it imports, directly or not, sorted."""
    found: set[str] = set()
    waiting = [script]
    while waiting:
        path = waiting.pop()
        if path not in found and (ROOT / path).is_file():
            found.add(path)
            waiting += _imported((ROOT / path).read_text("utf-8"))
    return sorted(found)


@cache  # panels share most of their imports
def _imported(source: str) -> tuple[str, ...]:
    """Modules in `import workflow.a.b`, `from workflow.a.b import c` and `from workflow.a import b`, as paths."""
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
    """Of the repository that tracks this project, and whether its tracked files are unchanged; None where there is none."""
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
    """`<panel>.json`: panel, quality, title, caption, commit, clean, files (name: sha256), parents. Raises MetadataError,
    OSError."""
    try:
        content: dict[str, Any] = json.loads(path.read_text("utf-8"))
        return content | {"parents": Parents(**content["parents"]), "files": dict(content["files"])}
    except (ValueError, TypeError, KeyError) as error:
        raise MetadataError(f"{path} is not the record of a panel: {error}") from error


def embedded(path: Path) -> str:
    """What the file states of its parents: their JSON, or the digest of it in a CSV. Raises MetadataError, OSError."""
    readers = {".csv": _of_table, ".svg": _of_svg, ".png": _of_png, ".pdf": _of_pdf}
    if path.suffix not in readers:
        raise MetadataError(
            f"{path.name}: only {', '.join(readers)} and .h5 files state where they come from"
        )
    path.open("rb").close()
    try:
        return readers[path.suffix](path)
    except Exception as error:  # a damaged file may raise anything in the libraries that read pictures
        first = (str(error).splitlines() or [type(error).__name__])[0]
        raise MetadataError(f"{path.name} does not state where it comes from: {first}") from error


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

    logging.getLogger("pypdf").setLevel(logging.CRITICAL)  # the error says it once
    return str(PdfReader(path).metadata["/Subject"])  # type: ignore[index]
