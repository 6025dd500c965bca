"""Identity of an executable: a hash of its sources, compiler, flags and libraries, independent of path, host and time.

The include closure of a source consists of the source, all files that it includes with quotes, and for each header `x.hpp` the
source `x.cpp` in the same folder, transitively. CMake runs this module with the system's Python (3.8 or later, standard library only). It
writes OUTPUT.json for the pipeline, OUTPUT.cpp for the executable, each only if it changes, and a dependency file.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
IDENTITY = ("program", "source_hash", "compiler", "flags", "libraries")  # a release does not change results
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


class BuildError(ValueError):
    """The executable is missing or older than its sources."""


def built(program: str) -> dict[str, Any]:
    """Identity of build/bin/PROGRAM: build_id, source_hash, compiler, flags, libraries, sources. Raises BuildError."""
    try:
        identity: dict[str, Any] = json.loads((ROOT / f"build/id/{program}.json").read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise BuildError(f"build/bin/{program} is missing: run make build") from error
    if sources_of_program(program) != identity["source_hash"]:
        raise BuildError(f"build/bin/{program} is not built from the present sources: run make build")
    return identity


def sources_of_program(program: str, root: Path = ROOT / "cpp") -> str:
    """Source hash of the present sources of a program. Raises FileNotFoundError."""
    return source_hash(content_hashes(root, include_closure(root, f"observables/{program}.cpp")))


def include_closure(root: Path, source: str) -> list[str]:
    """Sorted paths, relative to root, of all project files in a build of `source`. Raises FileNotFoundError.

    Quoted includes outside the root belong to libraries, whose versions are part of the identity.
    """
    closure: set[str] = set()
    pending = [source]
    while pending:
        name = pending.pop()
        if name in closure:
            continue
        closure.add(name)
        named = INCLUDE.findall((root / name).read_text("utf-8", "surrogateescape"))
        included = [path for include in named if (path := _included(root, name, include))]
        twins = [str(Path(i).with_suffix(".cpp")) for i in included]
        pending += included + [twin for twin in twins if (root / twin).is_file()]
    return sorted(closure)


def _included(root: Path, source: str, name: str) -> str | None:
    candidates = (os.path.normpath(Path(source).parent / name), os.path.normpath(name))
    return next((path for path in candidates if (root / path).is_file()), None)


def content_hashes(root: Path, closure: list[str]) -> dict[str, str]:
    return {name: hashlib.sha256((root / name).read_bytes()).hexdigest() for name in closure}


def source_hash(contents: dict[str, str]) -> str:
    """sha256 over names and hashes of the files."""
    lines = "".join(f"{name} {contents[name]}\n" for name in sorted(contents))
    return hashlib.sha256(lines.encode()).hexdigest()


def build_id(identity: dict[str, str]) -> str:
    """sha256 over the fields of IDENTITY."""
    named = {name: identity[name] for name in IDENTITY}
    return hashlib.sha256(json.dumps(named, sort_keys=True).encode()).hexdigest()


def write_if_changed(path: Path, text: str) -> None:
    if not path.is_file() or path.read_text("utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")


def cpp_source(identity: dict[str, Any]) -> str:
    names = ("version", "source_hash", "build_id", "compiler", "flags", "libraries")
    fields = ",\n".join(f"    {json.dumps(identity[name])}" for name in names)
    return (
        f'#include "program/build_info.hpp"\n\nconst lorentz::BuildInfo lorentz::build_info{{\n{fields}}};\n'
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    for option in ("root", "source", "version", "compiler", "flags", "libraries", "output", "depfile"):
        parser.add_argument(f"--{option}", required=True)
    options = parser.parse_args()
    root = Path(options.root)

    closure = include_closure(root, options.source)
    contents = content_hashes(root, closure)
    identity = {
        "program": Path(options.source).stem,
        "version": options.version,
        "source_hash": source_hash(contents),
        "compiler": options.compiler,
        "flags": options.flags.replace(";", " "),
        "libraries": options.libraries,
    }
    identity.update(build_id=build_id(identity), sources=contents)

    write_if_changed(Path(f"{options.output}.json"), json.dumps(identity, indent=2) + "\n")
    write_if_changed(Path(f"{options.output}.cpp"), cpp_source(identity))
    files = [f"{options.output}.cpp", *(str(root / name) for name in closure)]
    target, *prerequisites = (name.replace(" ", "\\ ") for name in files)
    Path(options.depfile).write_text(f"{target}: {' '.join(prerequisites)}\n", "utf-8")


if __name__ == "__main__":
    main()
