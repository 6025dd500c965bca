"""Identities of results and panels: the name of a file contains a hash of all that determines it."""

import hashlib
import json
import os
import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DIGITS = 12  # 48 bits: two of a million names are equal with a probability of 0.2 %
IDENTITY = f"[0-9a-f]{{{DIGITS}}}"  # regular expression of an identity
FORMER = "build/records"  # folder of the records of former figures, of which there may be copies
RELEASE = "paper"  # the quality of the release
NUMBERS = "docs/gallery/numbers.csv"  # its numbers, which other qualities state
SHARED = ("workflow/lib", "workflow/physics", "uv.lock")  # on which all figures depend
IDENTITY_LINE = re.compile(rf"panel ([\w-]+), quality ([\w=.-]+), identity ({IDENTITY})".encode())


def identity(*parts: object) -> str:
    """First digits of the sha256 of the parts, values of JSON."""
    return sha256(json.dumps(parts, sort_keys=True).encode())[:DIGITS]


def sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def result_identity(program: str, words: str, sources: str) -> str:
    """Identity of a result. words: options that determine it, as on the command line; sources: their hash,
    from source_hash()."""
    return identity(program, words, sources)


def panel_identity(panel: str, results: Iterable[str], sources: dict[str, str]) -> str:
    """Identity of a panel. results: paths of the plotted results, without their folders; sources:
    sources_of_panel()."""
    return identity(panel, ["/".join(Path(path).parts[-2:]) for path in results], sources)


def sources_of_panel(script: str, reads: Iterable[str] = ()) -> dict[str, str]:
    """Hashes of the script of a panel, of lib and physics, of the locked packages, and of the files and
    folders that it reads. Raises OSError."""
    return {path: content_hash(path) for path in (f"workflow/figures/{script}.py", *SHARED, *reads)}


def named_identity(path: Path | str) -> str:
    """Identity in the name of a file or of a stem, NAME.IDENTITY; empty for other names."""
    named = re.search(rf"\.({IDENTITY})(\.\w+)?$", str(path))
    return named[1] if named else ""


def panel_of(result: Path | str) -> str:
    """The panel to which a result belongs."""
    return Path(result).parent.name


def run_of(result: Path | str) -> str:
    """The name of the run of a result."""
    return re.sub(rf"\.{IDENTITY}$", "", Path(result).stem)


def record_name(product: str, identity: str) -> str:
    """Name of the record of a panel or of the report."""
    return f"{product}.{identity}.json"


def siblings(path: Path | str) -> list[Path]:
    """Files that differ from a path at most in the identity, the newest first."""
    pattern = Path(path).name.replace(named_identity(path), DIGITS * "[0-9a-f]")
    return sorted(Path(path).parent.glob(pattern), key=os.path.getmtime, reverse=True)


def identity_line(panel: str, quality: str, name: str) -> str:
    """Identification line in each file of a panel."""
    return f"panel {panel}, quality {quality}, identity {name}"


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
    kept = [name for name in names if not name.endswith((".pyc", "~")) and "/." not in name]
    lines = [f"{name} {sha256((root / name).read_bytes())}\n" for name in kept]
    return sha256("".join(lines).encode())


def states_release(quality: str, root: Path = ROOT) -> bool:
    """Whether figures and report of a quality also state the verdicts of the release."""
    return quality != RELEASE and (root / NUMBERS).exists()
