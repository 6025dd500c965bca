"""Identities: the name of a result or figure contains a hash of all that determines it.

CMake runs this module with the system's Python (3.8 or later, standard library only) to write the hash of its sources into every
program: `identity.py CPP FOLDER` writes FOLDER/PROGRAM.cpp from FOLDER/template, if it changes, and FOLDER/sources.d.
"""

from __future__ import annotations

import hashlib
import json
import re
import sys
from collections.abc import Iterable
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CPP = ROOT / "cpp"
FLAGS = "flags.cmake"
DIGITS = 12  # 48 bits: two of a million names are equal with a probability of 0.2 %
IDENTITY = f"[0-9a-f]{{{DIGITS}}}"  # regular expression of an identity
DRAWING = ("workflow/lib", "uv.lock")  # on which all figures depend

# Numbers with separators and literals are kept, as they may contain the begin of a comment.
TOKEN = re.compile(
    r"""(\b\d(?:'?[\w.])*|R"([^()\\\s]{0,16})\(.*?\)\2"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')"""
    r"""|//[^\n]*|/\*.*?\*/""",
    re.DOTALL,
)
STATEMENT = re.compile(rf"panel ([\w-]+), quality ([\w=.-]+), identity ({IDENTITY})".encode())


def identity(*parts: object) -> str:
    """First digits of the sha256 of the parts, values of JSON."""
    return sha256(json.dumps(parts, sort_keys=True).encode())[:DIGITS]


def sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def result_identity(program: str, words: str, sources: str) -> str:
    """Identity of a result. words: options that determine it, as on the command line; sources: source_hash(program)."""
    return identity(program, words, sources)


def panel_identity(panel: str, results: Iterable[str], sources: dict[str, str]) -> str:
    """Identity of a panel. results: paths of the results that it plots, of which the names count; sources: drawing_sources(script)."""
    return identity(panel, ["/".join(Path(path).parts[-2:]) for path in results], sources)


def drawing_sources(script: str) -> dict[str, str]:
    """Hashes of the script of a panel, of the library of all scripts, and of the locked packages. Raises OSError."""
    return {path: content_hash(path) for path in (f"workflow/figures/{script}.py", *DRAWING)}


def named_identity(path: Path | str) -> str:
    """Identity in the name of a file or of a stem, NAME.IDENTITY; empty for other names."""
    named = re.search(rf"\.({IDENTITY})(\.\w+)?$", str(path))
    return named[1] if named else ""


def statement(panel: str, quality: str, name: str) -> str:
    """The line by which each file of a panel states what it is."""
    return f"panel {panel}, quality {quality}, identity {name}"


def stated(content: bytes) -> tuple[str, str, str] | None:
    """Panel, quality and identity that a file of a panel states; None for other files."""
    found = STATEMENT.search(content)
    return (found[1].decode(), found[2].decode(), found[3].decode()) if found else None


def source_hash(program: str, cpp: Path = CPP) -> str:
    """Hash of all sources that can change a result of a program, without comments and empty lines: of cpp without benchmarks, other
    observables and, but for boltzmann, the solver of the kinetic equation; and of the numeric flags. Raises OSError."""
    lines = [
        f"{path} {digest}\n" for path, digest in code_hashes(cpp).items() if owner(path) in ("", program)
    ]
    return sha256("".join(lines).encode())


def programs(cpp: Path = CPP) -> list[str]:
    """Names of the programs."""
    return sorted(path.stem for path in (cpp / "observables").glob("[!.]*.cpp"))


@cache
def code_hashes(cpp: Path = CPP) -> dict[str, str]:
    """sha256 of the code of every source, by path. Raises OSError."""
    sources = [
        path.relative_to(cpp).as_posix() for kind in ("cpp", "hpp") for path in cpp.rglob(f"[!.]*.{kind}")
    ]
    texts = {path: (cpp / path).read_text("utf-8", "surrogateescape") for path in [*sorted(sources), FLAGS]}
    return {path: sha256(code(text, path).encode("utf-8", "surrogateescape")) for path, text in texts.items()}


def owner(path: str) -> str:
    """The program that alone depends on a source; bench for a benchmark, and empty for a source of all programs."""
    first, *rest = path.split("/")
    if first == "observables":
        return rest[0].partition(".")[0]
    return first if first in ("bench", "boltzmann") else ""


def code(text: str, path: str) -> str:
    """A source without comments and empty lines."""
    bare = re.sub("#.*", "", text) if path == FLAGS else TOKEN.sub(lambda token: token[1] or " ", text)
    return "\n".join(line.rstrip() for line in bare.split("\n") if line.strip())


@cache
def content_hash(path: str, root: Path = ROOT) -> str:
    """sha256 of a file, or of names and contents of the files in a folder but hidden ones, backups and compiled modules. Raises OSError."""
    if not (root / path).is_dir():
        return sha256((root / path).read_bytes())
    names = sorted(file.relative_to(root).as_posix() for file in (root / path).rglob("*") if file.is_file())
    kept = [name for name in names if not name.endswith((".pyc", "~")) and "/." not in name]
    lines = [f"{name} {sha256((root / name).read_bytes())}\n" for name in kept]
    return sha256("".join(lines).encode())


def main(cpp: Path, folder: Path) -> None:
    template = (folder / "template").read_text("utf-8")
    for program in programs(cpp):
        text = template.replace("SOURCE_HASH", source_hash(program, cpp))
        path = folder / f"{program}.cpp"
        if not path.is_file() or path.read_text("utf-8") != text:
            path.write_text(text, "utf-8")
    sources = [str(cpp / path).replace(" ", "\\ ") for path in code_hashes(cpp)]
    (folder / "sources").write_text("\n".join(sources), "utf-8")
    target = str(folder / "sources").replace(" ", "\\ ")
    (folder / "sources.d").write_text(f"{target}: {' '.join(sources)}\n", "utf-8")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
