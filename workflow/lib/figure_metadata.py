"""Parents of a figure, by hash: embedded in PDF, PNG and SVG, and in the record `<panel>.<identity>.json`.

The identity of a panel is a hash of what determines its files: names of its results, which have identities of their own, script with
its closure, and packages. The CSV states it.
"""

import json
import logging
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

from workflow.lib.closure import hashes_of
from workflow.lib.files import ROOT, file_hash
from workflow.lib.identity import identity

if TYPE_CHECKING:  # imports that would delay every start of Snakemake by 0.5 s
    from workflow.lib.load import Result

BUILD = ("program", "source_hash", "compiler", "flags", "libraries")
IDENTITY_LINE = "# identity: "  # begin of the line of a CSV that states the identity of the panel


class MetadataError(ValueError):
    """A file has no readable record of its parents."""


@dataclass(frozen=True)
class Parents:
    """Inputs of a panel. Paths are relative to the project, hashes are sha256."""

    panel: str
    quality: str
    data: dict[str, dict[str, Any]]  # sha256, build_id and seed of each result, by path
    builds: dict[str, dict[str, str]]  # build id: program, source_hash, compiler, flags, libraries
    sources: dict[str, str]  # closure of the script, and the locked packages
    python: str  # version of Python

    @classmethod
    def of(cls, script: str, stem: Path, results: "Sequence[Result]") -> "Parents":
        """Parents of the panel that the script renders to figures/QUALITY/PANEL.*"""
        stated = {str(result.path): result.provenance for result in results}
        return cls(
            panel=stem.name,
            quality=stem.parent.name,
            data={
                path: {
                    "sha256": file_hash(Path(path)),
                    "build_id": provenance["build_id"],
                    "seed": int(provenance["seed"]),
                }
                for path, provenance in stated.items()
            },
            builds={
                provenance["build_id"]: {name: provenance[name] for name in BUILD}
                for provenance in stated.values()
            },
            sources=hashes_of(script),
            python=f"{sys.version_info.major}.{sys.version_info.minor}",
        )

    @classmethod
    def parse(cls, text: str) -> "Parents":
        """Parents from the text of as_json(). Raises MetadataError."""
        try:
            stated = json.loads(text)
            return cls(**stated)
        except ValueError as error:
            raise MetadataError(f"not the parents of a panel: {error}") from error
        except TypeError as error:
            which = (
                f"panel {stated.get('panel')} at quality {stated.get('quality')}"
                if isinstance(stated, dict)
                else "no panel"
            )
            raise MetadataError(
                f"{which}, rendered by another version, whose record of parents is not readable here"
            ) from error

    def inputs(self) -> dict[str, str]:
        """All input files with their hashes."""
        return {path: result["sha256"] for path, result in self.data.items()} | self.sources

    @property
    def identity(self) -> str:
        return _panel_identity(self.panel, [*self.data], self.sources)

    def as_json(self) -> str:
        return json.dumps(vars(self), sort_keys=True)


def panel_identity(panel: str, script: str, data: Sequence[str]) -> str:
    """Identity of a panel that a script renders from the results at these paths. Raises OSError."""
    return _panel_identity(panel, data, hashes_of(f"workflow/figures/{script}.py"))


def _panel_identity(panel: str, data: Sequence[str], sources: dict[str, str]) -> str:
    """The folder of a quality is no part of it: the names of the results determine their content."""
    return identity(panel, ["/".join(Path(path).parts[-2:]) for path in data], sources)


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
    """Reads the record of a panel: panel, quality, title, caption, commit, clean, files (name: sha256), parents. Raises MetadataError,
    OSError."""
    try:
        content: dict[str, Any] = json.loads(path.read_text("utf-8"))
        return content | {"parents": Parents(**content["parents"]), "files": dict(content["files"])}
    except (ValueError, TypeError, KeyError) as error:
        raise MetadataError(f"{path} is not the record of a panel: {error}") from error


def embedded(path: Path) -> str:
    """Parents recorded in a file as JSON; in a CSV the identity of its panel. Raises MetadataError, OSError."""
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
        return next(line for line in lines if line.startswith(IDENTITY_LINE)).split()[-1]


def _of_svg(path: Path) -> str:
    element = ElementTree.parse(path).find(".//{http://purl.org/dc/elements/1.1/}description")
    assert element is not None
    return str(element.text)


def _of_png(path: Path) -> str:
    from PIL import Image  # noqa: PLC0415

    with Image.open(path, formats=["PNG"]) as picture:
        return str(picture.info["Description"])


def _of_pdf(path: Path) -> str:
    from pypdf import PdfReader  # noqa: PLC0415

    logging.getLogger("pypdf").setLevel(logging.CRITICAL)  # the raised error suffices
    return str(PdfReader(path).metadata["/Subject"])  # type: ignore[index]
