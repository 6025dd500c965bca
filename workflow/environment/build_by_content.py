"""Makes ninja decide by content: what differs from what was built is given a new time, or removed if it was built.

Time stamps say nothing of a source that was copied with its time, or of an executable that was edited. Standard
library only: this runs before anything is installed.
"""

import hashlib
import json
import os
import shutil
import subprocess
from pathlib import Path

from workflow.lib.places import require_place

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build"
RECORD = BUILD / "built_from.json"
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
        return dict(json.loads(RECORD.read_text())) if RECORD.is_file() else {}
    except (OSError, ValueError, TypeError):
        return {}


def renew(before: dict[str, str], now: dict[str, str]) -> None:
    changed = [path for path in now if before.get(path) != now[path] and path != "compiler"]
    if before and before.get("compiler") != now["compiler"]:  # CMake knows its version since it was first run
        changed.append("cpp/CMakeLists.txt")
        for name in ("CMakeCache.txt", "build.ninja"):
            (BUILD / name).unlink(missing_ok=True)
    for path in changed:
        os.utime(ROOT / path)


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
            or stated.read_text().split()[:1] != [hash_of(executable)]
        ):
            executable.unlink()


def main() -> None:
    for path in (RECORD.with_suffix(".tmp"), BUILD / "bin/any", *(BUILD / "id").glob("*"), BUILD / "id/any"):
        require_place(path, ROOT)
    now = present()
    if (BUILD / "build.ninja").is_file():
        renew(recorded(), now)
        remove_edited_executables()
    if RECORD.is_dir():
        shutil.rmtree(RECORD)
    unfinished = RECORD.with_suffix(".tmp")
    unfinished.write_text(json.dumps(now))
    unfinished.replace(RECORD)


if __name__ == "__main__":
    main()
