"""The repository around the products: its commit, its files, and whether they have been changed since."""

import io
import platform
import subprocess
import tarfile
from pathlib import Path

from workflow.lib.parents import file_hash

ROOT = Path(__file__).parents[2]


class FileHashes(dict[str, str | None]):
    """sha256 of the project's files by relative path, none where there is no file; each is read only once."""

    def __missing__(self, path: str) -> str | None:
        self[path] = file_hash(ROOT / path) if (ROOT / path).is_file() else None
        return self[path]


def git(*arguments: str) -> bytes | None:
    """What git prints, or nothing where it fails: not installed, outside a repository, or an unknown commit."""
    try:
        done = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, check=False)
    except FileNotFoundError:
        return None
    return done.stdout if done.returncode == 0 else None


def state() -> dict:
    """Commit and whether tracked files differ from it; the commit is null outside a repository."""
    commit = git("rev-parse", "HEAD")
    if commit is None or not (ROOT / ".git").exists():
        return {"commit": None, "dirty": None}
    changed = git("status", "--porcelain", "--untracked-files=no")
    return {"commit": commit.decode().strip(), "dirty": bool(changed)}


def files_at(commit: str, *folders: str) -> dict[str, bytes] | None:
    """Contents by path at a commit; nothing if the repository does not have it."""
    packed = git("archive", "--format=tar", commit, "--", *folders)
    if packed is None:
        return None
    with tarfile.open(fileobj=io.BytesIO(packed)) as archive:
        return {member.name: archive.extractfile(member).read() for member in archive if member.isfile()}


def commits(*paths: str) -> list[str]:
    """Those that changed one of the paths, newest first."""
    return (git("log", "--all", "--format=%H", "--", *paths) or b"").decode().split()


def signature(commit: str) -> str:
    """Whether the commit is signed, and git can verify it."""
    if git("verify-commit", commit) is not None:
        return "signed"
    signed = b"\ngpgsig" in (git("cat-file", "commit", commit) or b"").partition(b"\n\n")[0]
    return "signed, but git cannot verify it" if signed else "not signed"


def machine() -> str:
    """Kind of machine, within which equal inputs give equal bytes: processor and C library. No host name."""
    cpu = Path("/proc/cpuinfo")
    models = (
        [line for line in cpu.read_text().splitlines() if line.startswith("model name")]
        if cpu.exists()
        else []
    )
    model = models[0].split(":", 1)[1].strip() if models else platform.processor()
    return ", ".join(filter(None, [platform.machine(), model, " ".join(platform.libc_ver())]))
