"""Missing files, atomic writing, and errors of the system in one line."""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path


def missing(paths: Iterable[str]) -> list[str]:
    """The paths at which there is nothing."""
    return [path for path in paths if not os.path.exists(path)]


def write_atomically(contents: Mapping[Path, bytes]) -> None:
    """Writes all files under temporary names, then renames them in order. If the disk is full, the old
    files are kept. Raises OSError."""
    files = {path: path.with_name(f"{path.name}.{os.getpid()}.tmp") for path in contents}
    try:
        for path, file in files.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(contents[path])
        for path, file in files.items():
            file.replace(path)
    finally:
        for file in files.values():
            file.unlink(missing_ok=True)


def format_os_error(error: OSError) -> str:
    """File name and error as one line."""
    names = [str(name) for name in (error.filename, error.filename2) if name is not None]
    return f"{' to '.join(names)}: {error.strerror}" if names else str(error)
