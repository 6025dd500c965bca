"""The repository around the products: its commit, its files, and whether they have been changed since."""

import io
import os
import platform
import subprocess
import tempfile
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from workflow.lib.parents import file_hash
from workflow.lib.places import regular, unfinished

ROOT = Path(__file__).parents[2]
PLACES = (".", "data", "figures")
CODE = (
    "cpp",
    "profiles",
    "workflow",
    "GNUmakefile",
    "makefile",
)  # make reads the last two before the Makefile
# What decides beside the code: bands of the verdicts, the citation, layouts of files, packages, make and Snakemake.
DECIDING = (
    *CODE,
    "Makefile",
    "Snakefile",
    "CITATION.cff",
    "data/claims.csv",
    "docs/format.schema.json",
    "requirements.lock",
)
# Nothing that is configured may show git another history than the one whose hashes it names, or other files.
NOTHING_MORE: Mapping[str, str] = {}  # beside what every call of git is given
PLAIN = {
    "GIT_NO_REPLACE_OBJECTS": "1",
    "GIT_GRAFT_FILE": os.devnull,
    "GIT_CONFIG_COUNT": "2",  # no command that the repository names is run
    "GIT_CONFIG_KEY_0": "core.fsmonitor",
    "GIT_CONFIG_VALUE_0": "false",
    "GIT_CONFIG_KEY_1": "core.hooksPath",
    "GIT_CONFIG_VALUE_1": os.devnull,
}


class DamagedError(OSError):
    """The repository's objects are not what their names say."""


class FileHashes(dict[str, str | None]):
    """sha256 of the project's files by relative path, none where there is no file that can be read; each is read only once. A link is no
    file of the project, and what lies behind one is none; `data` and `figures` themselves may be links."""

    def __missing__(self, path: str) -> str | None:
        parts = (part for part in (path, *map(str, Path(path).parents)) if part not in PLACES)
        try:
            linked = any((ROOT / part).is_symlink() for part in parts)
            self[path] = file_hash(ROOT / path) if not linked and (ROOT / path).is_file() else None
        except OSError:
            self[path] = None
        return self[path]

    def of(self, paths: Collection[str]) -> dict[str, str]:
        """Of these files. Raises FileNotFoundError if one is not there or cannot be read."""
        found = {path: digest for path in paths if (digest := self[path])}
        if lacking := [path for path in paths if path not in found]:
            raise FileNotFoundError(
                f"{lacking[0]} is no file of the project: missing, or behind a link; move the link away"
            )
        return found


def write_whole(path: Path, text: str) -> None:
    """So that the file is never there by half."""
    with unfinished(path.with_suffix(".tmp")) as file:
        file.write_text(text)
        file.replace(path)


def run_git(
    *arguments: str, given: bytes = b"", variables: Mapping[str, str] = NOTHING_MORE
) -> subprocess.CompletedProcess[bytes] | None:
    """None where git is not installed. The variables are those of its environment. Raises OSError if git would wait for ever."""
    if (ROOT / ".git").is_dir():
        regular(ROOT / ".git/HEAD")
    try:
        return subprocess.run(
            ["git", *arguments],
            cwd=ROOT,
            env=os.environ | PLAIN | {"GIT_WORK_TREE": str(ROOT)} | dict(variables),
            input=given,
            capture_output=True,
            check=False,
        )
    except FileNotFoundError:
        return None


def git(*arguments: str, given: bytes = b"", variables: Mapping[str, str] = NOTHING_MORE) -> bytes | None:
    """What git prints, or nothing where it fails: not installed, outside a repository, or an unknown commit."""
    done = run_git(*arguments, given=given, variables=variables)
    return done.stdout if done and done.returncode == 0 else None


def no_history() -> str | None:
    """Why nothing can be compared with commits; none if it can."""
    done = run_git("rev-parse", "--is-shallow-repository")
    if done is None:
        return "git is not installed"
    if done.returncode == 0 and git("ls-files", "-z") is None:
        return "git does not list the files here"
    for line in done.stderr.decode(errors="replace").splitlines():
        if "git config" in line and "safe.directory" in line:  # what git says to another user than the owner
            return f"the repository is another user's, which git reads after: {line.strip()}"
    if done.returncode:
        return "this is no repository that git reads"
    return "the repository is shallow" if done.stdout == b"true\n" else None


def state() -> dict[str, Any]:
    """Commit and whether tracked files differ from it or others lie among the code; the commit is null outside a
    repository."""
    commit = git("rev-parse", "HEAD")
    if commit is None or not (ROOT / ".git").exists():
        return {"commit": None, "dirty": None}
    changed = git("status", "--porcelain", "--untracked-files=no")
    listed = git("ls-files", "-v")
    known = changed is not None and listed is not None
    marked = (line for line in (listed or b"").splitlines() if line[:1] == b"S" or line[:1].islower())
    unseen = any(marked)  # assume-unchanged, skip-worktree
    return {
        "commit": commit.decode().strip(),
        "dirty": not known or bool(changed) or unseen or bool(untracked()) or deciding_differ(),
    }


def deciding_differ() -> bool:
    """Whether a file that decides differs from the commit, by its content: git's status believes an index of times."""
    entries = [
        (entry.split(b" ", 2)[2].split(b"\t", 1))
        for entry in (git("ls-tree", "-r", "-z", "HEAD", "--", *DECIDING) or b"").split(b"\0")
        if entry
    ]
    paths = [path for _, path in entries]
    listed = b"".join(path + b"\n" for path in paths)
    there = git("hash-object", "--no-filters", "--stdin-paths", given=listed)
    return there is None or there.split() != [name for name, _ in entries]


def untracked() -> list[str]:
    """Files among the code that the commit does not have, whether git is told to ignore them or not; without byte
    code, which nothing here reads (launch.py)."""
    there = paths_of(git("ls-files", "--cached", "--others", "-z", "--", *CODE))
    committed = {*paths_of(git("ls-tree", "-r", "-z", "--name-only", "HEAD", "--", *CODE))}
    return [
        path
        for path in sorted({*there} - committed)
        if os.path.lexists(ROOT / path) and "__pycache__" not in Path(path).parts
    ]


def paths_of(listed: bytes | None) -> list[str]:
    """What git lists with -z; a name may be no UTF-8."""
    return [os.fsdecode(path) for path in (listed or b"").split(b"\0") if path]


def files_at(commit: str, *folders: str) -> dict[str, bytes] | None:
    """Contents by path at a commit; nothing if the repository does not have it. Raises DamagedError if an object is not what its
    name says."""
    if not is_commit(commit):
        return None
    if complaint := fsck(commit):
        raise DamagedError(complaint)
    return stored_at(commit, *folders)


def is_commit(name: str) -> bool:
    return git("cat-file", "-t", name) == b"commit\n"


def fsck(*commits: str) -> str | None:
    """What is wrong with the repository's objects, all of which are read, and with what the commits need, or without any all
    branches and tags."""
    checked = run_git("fsck", "--no-dangling", "--no-progress", "--no-reflogs", *commits)
    if checked is not None and checked.returncode == 0:
        return None
    lines = (checked.stderr + checked.stdout).decode(errors="replace").splitlines() if checked else []
    said = [line for line in lines if not line.startswith("hint:")]
    return f"git fsck complains: {(said or ['it does not say of what'])[0]}"


def stored_at(commit: str, *folders: str) -> dict[str, bytes] | None:
    """Contents by path at a commit as they are stored, without the filters that a checkout applies, unchecked; a submodule has
    none. Nothing if the repository does not have the commit, or not all of it."""
    if not is_commit(commit):
        return None
    listed = git("ls-tree", "-r", "-z", "--full-tree", commit, "--", *folders)
    if listed is None:
        return None
    entries = [
        (*entry.split(b"\t", 1)[0].split(), entry.split(b"\t", 1)[1])
        for entry in listed.split(b"\0")
        if entry
    ]
    names = [(name, os.fsdecode(path)) for _, kind, name, path in entries if kind == b"blob"]
    packed = git("cat-file", "--batch", given=b"".join(name + b"\n" for name, _ in names))
    if packed is None:
        return None
    contents, stream = {}, io.BytesIO(packed)
    for _, path in names:
        *_, size = stream.readline().split()
        if size == b"missing":
            return None
        contents[path] = stream.read(int(size))
        stream.readline()
    return contents


def commits(*paths: str) -> list[str]:
    """Those that changed one of the paths, newest first."""
    return (git("log", "--all", "--format=%H", "--", *paths) or b"").decode().split()


def commit_with(file: Path) -> tuple[str, str] | None:
    """The commit that first had these bytes, and at which path; nothing where none did."""
    blob = (git("hash-object", "--no-filters", "--", str(file.absolute())) or b"").decode().strip()
    log = git("log", "--all", f"--find-object={blob}", "--format=%x01%H", "--name-only") if blob else None
    *_, first = (log or b"").decode(errors="replace").split("\x01")
    commit, *paths = first.split("\n\n")
    return (commit.strip(), paths[0].splitlines()[0]) if paths else None


def signature(commit: str) -> str:
    """Whether the commit is signed, and by whom if git can verify it by the settings of its user. Those of the repository
    are not read: who forges its history writes them too."""
    objects = os.fsdecode(git("rev-parse", "--path-format=absolute", "--git-path", "objects") or b"").strip()
    kind = os.fsdecode(git("rev-parse", "--show-object-format") or b"sha1").strip()
    with tempfile.TemporaryDirectory() as folder:
        apart = {"GIT_DIR": folder}
        git("init", "--quiet", "--template=", f"--object-format={kind}", variables=apart)
        apart |= {"GIT_OBJECT_DIRECTORY": objects}
        if git("verify-commit", commit, variables=apart) is not None:
            shown = ["show", "--no-patch", "--no-show-signature", "--format=%GS%x00%GK", commit]
            signer, key = (git(*shown, variables=apart) or b"\0").decode(errors="replace").strip().split("\0")
            return f"signed by {signer or 'nobody known'}, key {key}"
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
