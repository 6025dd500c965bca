"""Makes ninja decide by content: what differs from what was built is given a new time, or removed if it was built.

Time stamps say nothing of a source that was copied with its time, or of an executable that was edited; ninja knows
nothing of a new file that an include finds first. Standard library only: this runs before anything is installed.
With --built it notes, after the build, the rules that CMake wrote for ninja: edited ones are written anew.
"""

import hashlib
import json
import os
import runpy
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from workflow.lib.places import require_place, unfinished

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build"
RECORD = BUILD / "built_from.json"
BUILD_ID = Path(__file__).resolve().parents[1] / "provenance/build_id.py"
# What CMake wrote for ninja and for itself, below build.
RULES = ("build.ninja", "CMakeCache.txt", "CMakeFiles/*.ninja", "CMakeFiles/*.cmake", "CMakeFiles/*/*.cmake")
SOURCES = ("cpp/**/*.[ch]pp", "cpp/**/CMakeLists.txt", "tests/cpp/**/*", "workflow/provenance/build_id.py")


def hash_of(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def present() -> dict[str, str]:
    files = {path for pattern in SOURCES for path in ROOT.glob(pattern) if path.is_file()}
    hashes = {str(path.relative_to(ROOT)): hash_of(path) for path in sorted(files)}
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True, check=False).stdout
    return hashes | {"compiler": compiler}


def recorded() -> dict[str, str]:
    try:
        read = dict(json.loads(RECORD.read_text())) if RECORD.is_file() else {}
        return {path: digest for path, digest in read.items() if isinstance(path, str)}
    except (OSError, ValueError, TypeError, RecursionError):
        return {}


def rules() -> dict[str, str]:
    """Hashes by path, which begins with build/."""
    files = (path for pattern in RULES for path in sorted(BUILD.glob(pattern)) if path.is_file())
    return {f"build/{path.relative_to(BUILD)}": hash_of(path) for path in files}


def renew(before: dict[str, str], now: dict[str, str]) -> dict[str, str]:
    """Returns the rules that stay."""
    changed = [path for path in now if before.get(path) != now[path] and path != "compiler"]
    written = {path: digest for path, digest in before.items() if path.startswith("build/")}
    # CMake knows the compiler's version since it was first run.
    if before.get("compiler") != now["compiler"] or written != rules():
        changed.append("cpp/CMakeLists.txt")
        for path in rules():
            (ROOT / path).unlink()
        written = {}
    for path in [*changed, *found_anew()]:
        os.utime(ROOT / path)
    return written


def found_anew() -> list[str]:
    """Programs' sources whose includes lead to other files than when they were built."""
    closure = runpy.run_path(str(BUILD_ID))["include_closure"]
    stale = []
    for identity in (BUILD / "id").glob("*.json"):
        source = f"observables/{identity.stem}.cpp"
        try:
            before = json.loads(identity.read_text())["sources"].keys()
            if (ROOT / "cpp" / source).is_file() and {*closure(ROOT / "cpp", source)} != {*before}:
                stale.append(f"cpp/{source}")
        except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
            identity.unlink(missing_ok=True)  # damaged: written again
    return stale


def remove_edited_executables() -> None:
    """Those that are not as the linker wrote them, by the hash that stands in build/id."""
    for executable in (BUILD / "bin").glob("*"):
        stated = BUILD / "id" / f"{executable.name}.sha256"
        if not (BUILD / "id" / f"{executable.name}.json").is_file():
            continue
        if executable.is_dir() and not executable.is_symlink():
            shutil.rmtree(executable)
        elif (
            not executable.is_file()
            or not stated.is_file()
            or stated.read_text(errors="replace").split()[:1] != [hash_of(executable)]
        ):
            executable.unlink()


def main(arguments: Sequence[str] = ()) -> None:
    for path in (RECORD.with_suffix(".tmp"), BUILD / "bin/any", *(BUILD / "id").glob("*"), BUILD / "id/any"):
        require_place(path, ROOT)
    if arguments == ["--built"]:  # what was hashed before the build is what was built
        return write(recorded() | rules())
    now = present()
    if (BUILD / "build.ninja").is_file():
        now |= renew(recorded(), now)
        remove_edited_executables()
    return write(now)


def write(content: dict[str, str]) -> None:
    if RECORD.is_dir():
        shutil.rmtree(RECORD)
    with unfinished(RECORD.with_suffix(".tmp")) as file:
        file.write_text(json.dumps(content))
        file.replace(RECORD)


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except KeyboardInterrupt:
        sys.exit("Stopped.")
