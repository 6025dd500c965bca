"""The Python packages in .venv: installed from locks of hashes, and again as soon as a file is not what was installed.

.venv/installed.json has the hashes of the locks and of every file below .venv. A file is read again when its inode,
size or time of change differs; the last, unlike the time of modification, cannot be set. Standard library only: this
runs before anything is installed.
"""

import argparse
import contextlib
import hashlib
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from workflow.lib.locks import only_make

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / ".venv"
RECORD = FOLDER / "installed.json"
PYTHON = FOLDER / "bin/python"

State = dict[
    str, list[str | int]
]  # path below .venv: sha256 or target of a link, inode, size, time of change


def state(known: State) -> State:
    """Of every file; what is not read again is taken from `known`."""
    stamps = {path: stamp(status) for path, status in sorted(files_below(str(FOLDER)))}
    stamps.pop(RECORD.name, None)
    to_read = [path for path, own in stamps.items() if known.get(path, [])[1:] != own]
    with ThreadPoolExecutor() as threads:
        digests = dict(zip(to_read, threads.map(lambda path: digest(FOLDER / path), to_read), strict=True))
    return {path: [digests[path], *own] if path in digests else known[path] for path, own in stamps.items()}


def files_below(folder: str, prefix: str = "") -> Iterator[tuple[str, os.stat_result]]:
    """What is no folder, links among it, by its path below the first folder. One look at each, as this precedes every command."""
    with contextlib.suppress(PermissionError), os.scandir(folder) as entries:
        for entry in entries:
            if entry.is_dir(follow_symlinks=False):
                yield from files_below(entry.path, f"{prefix}{entry.name}/")
            else:
                yield prefix + entry.name, entry.stat(follow_symlinks=False)


def stamp(status: os.stat_result) -> list[int]:
    """What changes with the content."""
    return [status.st_ino, status.st_size, status.st_ctime_ns]


def digest(path: Path) -> str:
    if path.is_symlink():
        return f"link to {path.readlink()}"
    if not path.is_file():
        return "no regular file"
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except PermissionError:
        return "cannot be read"


def record() -> dict[str, Any]:
    """Empty if there is none that can be read."""
    try:
        read = json.loads(RECORD.read_text()) if RECORD.is_file() else {}
        lists = all(isinstance(one, list) and one for one in read["files"].values())
        return read if lists and isinstance(read["locks"], dict) else {}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}


def write(locks: dict[str, str], files: State) -> None:
    unfinished = RECORD.with_suffix(".tmp")
    unfinished.write_text(json.dumps({"locks": locks, "files": files}))
    unfinished.replace(RECORD)


def faults() -> list[str]:
    """Paths below the project's folder of what is not as it was installed: changed, missing or foreign."""
    before = record().get("files")
    if before is None:
        return [str(RECORD.relative_to(ROOT))]
    return differing(before, state(before))


def differing(before: State, now: State) -> list[str]:
    return [
        f".venv/{path}"
        for path in sorted({*before, *now})
        if before.get(path, [0])[0] != now.get(path, [1])[0]
    ]


def install(locks: list[str]) -> None:
    """What the locks say, unless it is there. Packages of a lock that is asked for later are added to it. Without a lock what
    is installed stays; raises OSError."""
    for lock in locks:
        if not (ROOT / lock).is_file():
            raise OSError(f"{lock} is no file: put that of the repository there")
    asked = {lock: digest(ROOT / lock) for lock in locks}
    known, why = record(), ""
    before, there = known.get("files", {}), known.get("locks", {})
    if PYTHON.exists() and there:
        now = state(before)
        wrong = differing(before, now)
        if wrong:
            why = f"{wrong[0]} is not what was installed; all packages are installed again"
        elif any(there[lock] != asked.get(lock, there[lock]) for lock in there):
            why = "Locked packages have changed; all are installed again"
        else:
            missing = [lock for lock in locks if lock not in there]
            if missing:
                with only_make(ROOT):
                    add(missing)
                    write({**there, **asked}, state(now))
            elif now != before and os.access(FOLDER, os.W_OK):
                write(there, now)
            return
    with only_make(ROOT):
        if why:
            print(why, flush=True)
        if FOLDER.exists():
            shutil.rmtree(FOLDER)
        subprocess.run([sys.executable, "-m", "venv", FOLDER], check=True)
        add(locks)
        write(asked, state({}))


def add(locks: list[str]) -> None:
    for lock in locks:
        print(f"Installing Python packages of {lock} into .venv", flush=True)
        command: list[str | Path] = [
            PYTHON,
            "-P",
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
            "--require-hashes",
            "--no-build-isolation",  # which would fetch what builds them, by no hash
            "--use-pep517",
        ]
        subprocess.run([*command, "-r", ROOT / lock], check=True)


def complaint(found: list[str]) -> str | None:
    if not found:
        return None
    more = f", and {len(found) - 1} more" if found[1:] else ""
    return (
        f"{found[0]!r} is not what was installed: changed, missing or foreign{more}; "
        "`make runtime` installs all packages again"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("locks", nargs="*")
    parser.add_argument("--check", action="store_true", help="only say what is not as it was installed")
    parser.add_argument("--idle", action="store_true", help="only see whether a make is running here")
    options = parser.parse_args()
    if options.check:
        sys.exit(complaint(faults()))
    if options.idle:
        with only_make(ROOT):
            return
    try:
        install(options.locks)
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"The Python packages cannot be installed: {error}")


if __name__ == "__main__":
    main()
