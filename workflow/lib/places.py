"""What may lie where a file is read or written, asked before it is opened.

Opening a pipe waits for ever, a link leads out of the project, and a folder in the place of a file would be noticed only
when the work is done. Standard library only, as it starts for every job.
"""

import errno
import os
import shutil
import stat
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path

LIMITS = {
    getattr(errno, name)
    for name in ("ENOSPC", "EIO", "EDQUOT", "EFBIG", "EMFILE", "ENFILE", "ENOMEM", "EAGAIN")
}
KINDS = {stat.S_IFREG: "a file", stat.S_IFDIR: "a folder", stat.S_IFLNK: "a link", stat.S_IFIFO: "a pipe"}


def regular(path: Path) -> Path:
    """The path, if a file lies there, or nothing. Raises OSError."""
    _require(path, stat.S_IFREG, follow=True)
    return path


def require_place(path: Path, root: Path) -> Path:
    """The path, below root, if a file can be written there: nothing but folders on the way, and a file or nothing at its end.
    Raises OSError. The first folder may be a link, as `data` and `figures` may lie on another disk; nothing below may."""
    _, *folders = reversed(path.relative_to(root).parents)
    for folder in folders:
        _require(root / folder, stat.S_IFDIR, follow=len(folder.parts) == 1)
    _require(path, stat.S_IFREG, follow=False)
    return path


def move(source: Path, target: Path) -> None:
    """In place of what is there, also on another disk; the target is never there by half."""
    try:
        source.replace(target)
    except OSError as error:
        if error.errno != errno.EXDEV:
            raise
        copy(source, target)
        source.unlink()


def copy(source: Path, target: Path) -> None:
    """In place of what is there, which stays until all is written."""
    with unfinished(target.with_name(f"{target.name}.tmp")) as written:
        with regular(source).open("rb") as old, written.open("wb") as new:
            shutil.copyfileobj(old, new)
            new.flush()
            os.fsync(new.fileno())
        written.replace(target)


@contextmanager
def unfinished(path: Path) -> Iterator[Path]:
    """A file that is written, to be given its name when it is whole. If it cannot be, it does not stay, and the error names it."""
    regular(path)
    try:
        yield path
    except OSError as error:
        if error.filename is None and error.errno is not None:
            error.filename = str(path)
        raise
    finally:
        path.unlink(missing_ok=True)


def write_together(contents: Mapping[Path, bytes]) -> None:
    """Each gets its name when all are written, so that a full disk leaves those that were there."""
    with ExitStack() as written:
        files = {}
        for path, content in contents.items():
            files[path] = written.enter_context(unfinished(path.with_name(f"{path.name}.tmp")))
            files[path].write_bytes(content)
        for path, file in files.items():
            file.replace(path)


def damaged(path: Path, error: Exception) -> OSError:
    """Of a file of the repository, with what was wrong when it was read."""
    return OSError(errno.EINVAL, f"damaged; take it from the repository again ({error!r})", str(path))


def is_limit(error: Exception) -> bool:
    """Whether the machine has no more disk, files or memory, or a limit forbids it: no fault of a file, nor of a module."""
    return isinstance(error, OSError) and error.errno in LIMITS


def in_one_line(error: OSError) -> str:
    """Which file, and what is wrong with it."""
    names = [str(name) for name in (error.filename, error.filename2) if name is not None]
    return f"{' to '.join(names)}: {error.strerror}" if names else str(error)


def _require(path: Path, kind: int, follow: bool) -> None:
    try:
        found = stat.S_IFMT(path.stat(follow_symlinks=follow).st_mode)
    except FileNotFoundError:
        return
    if found != kind:
        text = f"{KINDS.get(found, 'a device or socket')} lies where {KINDS[kind]} belongs; move it away"
        raise OSError(errno.EINVAL, text, str(path))
