"""Files of the project: hashes, and atomic writing."""

import hashlib
import os
import signal
import subprocess
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import TracebackType

ROOT = Path(__file__).resolve().parents[2]


def refuse_another_folder() -> None:
    """Exits if the working directory is not the project of this file."""
    if Path.cwd() != ROOT:
        sys.exit(
            f"the working directory is {Path.cwd()}, not the project {ROOT} of this program: change to it, or use make here"
        )


def content_hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def file_hash(path: Path) -> str:
    """sha256 of the content. Raises OSError."""
    return content_hash(path.read_bytes())


def write_together(contents: Mapping[Path, bytes], instead_of: Iterable[Path] = ()) -> None:
    """Writes all files under temporary names, removes the files of `instead_of`, then renames the new ones in order. If the disk is full,
    the old files are kept. Raises OSError."""
    files = {path: path.with_name(f"{path.name}.{os.getpid()}.tmp") for path in contents}
    try:
        for path, file in files.items():
            file.write_bytes(contents[path])
        for path in instead_of:
            path.unlink(missing_ok=True)
        for path, file in files.items():
            file.replace(path)
    finally:
        for file in files.values():
            file.unlink(missing_ok=True)


def in_one_line(error: OSError) -> str:
    """File name and error as one line."""
    names = [str(name) for name in (error.filename, error.filename2) if name is not None]
    return f"{' to '.join(names)}: {error.strerror}" if names else str(error)


def project_files() -> list[str]:
    """Sources: files that git does not ignore, tracked or not; without a repository, all files that are neither products nor hidden."""
    command = ["git", "-C", str(ROOT), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    paths = sorted({path for path in done.stdout.split("\0") if path and (ROOT / path).is_file()})
    if "Snakefile" in paths:
        return paths
    paths = [str(path.relative_to(ROOT)) for path in sorted(ROOT.rglob("*")) if path.is_file()]
    products = (".", "build/", "figures/")
    return [
        path
        for path in paths
        if not path.startswith(products) and not path.endswith((".h5", ".cost.json", ".pyc"))
    ]


def _report(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if isinstance(error, OSError):
        print(in_one_line(error), file=sys.stderr)
        os.dup2(
            os.open(os.devnull, os.O_WRONLY), 1
        )  # at exit Python would try again to flush what a full disk has refused
    else:
        sys.__excepthook__(kind, error, trace)


if Path(sys.argv[0]).resolve().is_relative_to(ROOT / "workflow"):  # a tool: python -m workflow.NAME
    refuse_another_folder()
    signal.signal(
        signal.SIGPIPE, signal.SIG_DFL
    )  # default of command-line tools, as for `make status | head`
    sys.stdout = sys.stdout or open(os.devnull, "w")  # noqa: SIM115  # None if stdout is closed, as by `make status >&-`
    sys.excepthook = _report
