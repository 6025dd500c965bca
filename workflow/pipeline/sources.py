"""Hashes of the sources of the programs.

CMake runs this module with the system's Python (3.9 or later, standard library only) to write the hash of its
sources into every program: `sources.py CPP FOLDER` writes FOLDER/PROGRAM.cpp from FOLDER/template, if it
changes, and FOLDER/sources.d.
"""

from __future__ import annotations

import hashlib
import re
import sys
from functools import cache
from pathlib import Path
from typing import Any

CPP = Path(__file__).resolve().parents[2] / "cpp"
FLAGS = "flags.cmake"

# What only sampled programs use: collision rules, chains, their dynamics and parameters.
SAMPLED = re.compile(
    "engine/|sampling/(?!momentum_bins|reservoir_parameters)|model/(collision_rule|rules|(closed|open)_chain)"
)

# Numbers with separators and literals are kept, as they may contain the begin of a comment.
TOKEN = re.compile(
    r"""(\b\d(?:'?[\w.])*|R"([^()\\\s]{0,16})\(.*?\)\2"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')"""
    r"""|//[^\n]*|/\*.*?\*/""",
    re.DOTALL,
)


def sha256(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogateescape")).hexdigest()


@cache
def source_hash(program: str, cpp: Path = CPP) -> str:
    """Hash of all sources that can change a result of a program, without comments and empty lines, and of
    the numeric flags. Raises OSError."""
    lines = [
        f"{path} {digest}\n" for path, digest in code_hashes(cpp).items() if determines(path, program, cpp)
    ]
    return sha256("".join(lines))


def sources_changed(provenance: dict[str, Any]) -> bool:
    """Whether a result is of other sources of its program."""
    return bool(provenance["source_hash"] != source_hash(provenance["program"]))


def programs(cpp: Path = CPP) -> list[str]:
    """Names of the programs."""
    return sorted(path.stem for path in (cpp / "observables").glob("[!.]*.cpp"))


def is_sampled(program: str, cpp: Path = CPP) -> bool:
    """Whether a program averages over replicas, hence has a seed. Raises OSError."""
    return "StudyProgram" in text_of(program, cpp)


@cache
def text_of(program: str, cpp: Path) -> str:
    """The main source of a program. Raises OSError."""
    return (cpp / f"observables/{program}.cpp").read_text("utf-8", "surrogateescape")


@cache
def code_hashes(cpp: Path = CPP) -> dict[str, str]:
    """sha256 of the code of every source, by path. Raises OSError."""
    sources = [
        path.relative_to(cpp).as_posix() for kind in ("cpp", "hpp") for path in cpp.rglob(f"[!.]*.{kind}")
    ]
    texts = {path: (cpp / path).read_text("utf-8", "surrogateescape") for path in [*sorted(sources), FLAGS]}
    return {path: sha256(code(text, path)) for path, text in texts.items()}


def determines(path: str, program: str, cpp: Path = CPP) -> bool:
    """Whether a source can change a result of a program: all but other observables, the solver of the
    Boltzmann equation if the program does not include it, and rules and dynamics if it is not sampled."""
    first, *rest = path.split("/")
    if first == "observables":
        return rest[0].partition(".")[0] == program
    if first == "boltzmann":
        return '#include "boltzmann/' in text_of(program, cpp)
    return is_sampled(program, cpp) or not SAMPLED.match(path)


def code(text: str, path: str) -> str:
    """A source without comments and empty lines."""
    bare = re.sub("#.*", "", text) if path == FLAGS else TOKEN.sub(lambda token: token[1] or " ", text)
    return "\n".join(line.rstrip() for line in bare.split("\n") if line.strip())


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
