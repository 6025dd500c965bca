"""Prints whether a file is what a job here wrote, and what it was made from, down to sources, seeds and packages.

Works on a copy anywhere: a lock in data/ knows the file by its hash, the file names its parents by theirs, and the
repository is asked where these are, in the working tree, in data/ or in a commit. Status 0 if a job wrote this file or a
commit has it, as those of the gallery, 1 if neither, 3 if no job did of which a lock can be read, and others cannot.
"""

import argparse
import os
import re
import sys
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from rich.console import Console
from rich.markup import escape
from rich.tree import Tree

from workflow.lib.load import Result, load
from workflow.lib.parents import PACKAGES, Parents, file_hash
from workflow.lib.plan import Panel, Quality, is_quality, load_plan, outputs_of
from workflow.lib.strict_yaml import ConfigurationError
from workflow.provenance.build_id import content_hashes, include_closure, source_hash
from workflow.provenance.lock import Lock, LockError
from workflow.provenance.printable import printable
from workflow.provenance.repository import ROOT, commit_with, commits, fsck, stored_at

SHORT = 16  # digits of a hash that are shown
FEW = 2  # entries of a list that are shown where not all are asked for
UNLIMITED = 100_000  # columns, where nobody reads them on a screen
HERE = "as in the working tree"
LOST = "not found in the repository"
CONFIGURATION = "workflow/config"
BAD_INPUT, NOT_CHECKED = 2, 3  # exit statuses

Found = TypeVar("Found")


def remedy(path: str) -> str:
    """What makes a product again, by the quality in whose folder it lies."""
    quality = "".join(path.split("/")[1:2])
    return f"make figures {Quality.of(quality).arguments}" if is_quality(quality) else "make figures"


def makers(digest: str) -> tuple[list[str], list[str]]:
    """The jobs that wrote a file of this hash, in words; and the locks that cannot be read."""
    found, damaged = [], []
    try:
        qualities = sorted(os.listdir(ROOT / "data"))
    except FileNotFoundError:
        qualities = []
    except OSError as error:
        return [], [f"skipped data: {error.strerror}"]
    for quality in filter(is_quality, qualities):
        try:
            os.stat(ROOT / "data" / quality / "lock.json")
            jobs = Lock.read(quality).jobs
            for name, job in jobs.items():
                if any(job.outputs.get(path) == digest for path in outputs_of(quality, name)):
                    state = {True: "uncommitted changes", False: "clean", None: "no repository"}[job.dirty]
                    found.append(
                        f"job {name} of quality {quality} wrote (commit {short(str(job.commit))}, {state})"
                    )
        except (FileNotFoundError, NotADirectoryError):
            continue
        except OSError as error:
            damaged.append(f"skipped data/{quality}: {error.strerror}")
        except LockError as error:
            damaged.append(f"skipped data/{quality}/lock.json: {error}")
    return found, damaged


class Ancestry:
    """Writes the tree, whole or with the first entries of every list only."""

    def __init__(self, full: bool) -> None:
        self.full = full
        self.shown: set[str] = set()  # builds

    def product(self, path: Path) -> Tree:
        """Raises ArtefactError or FormatError if the file does not say what it was made from."""
        title = f"{path.name}  {short(file_hash(path))}"
        if path.suffix == ".h5":
            result = load(path)
            tree = Tree(plain(title))
            add_parameters(tree, result)
            self.add_build(tree, result.provenance["build_id"], result.provenance)
            return tree
        parents = Parents.of(path)
        tree = Tree(plain(f"{title}  panel {parents.panel} at quality {parents.quality}"))
        found = search(CONFIGURATION, lambda root: asks_for(root, parents))[0]
        tree.add(plain(f"configuration  {short(parents.configuration)}  {found}"))
        found, locked = search(PACKAGES, held_below(PACKAGES, parents.packages))
        names = re.findall(r"^([\w.-]+==[^ ;\\]+)", (locked or b"").decode(errors="replace"), re.MULTILINE)
        node = tree.add(plain(f"{PACKAGES}  {short(parents.packages)}  {found}; Python {parents.python}"))
        if self.full and names:
            node.add(plain(", ".join(names)))
        self.add_scripts(tree.add("scripts"), parents.sources)
        for name, data in self.first(tree, parents.data.items(), "files of data"):
            self.add_data(tree, name, data, parents.builds[data["build_id"]])
        return tree

    def first(self, node: Tree, entries: Iterable[Found], what: str) -> Iterable[Found]:
        """Those to show; what is left out is counted once they have been shown."""
        entries = [*entries]
        few = entries if self.full else entries[:FEW]
        yield from few
        if len(few) < len(entries):
            node.add(f"and {len(entries) - len(few)} more {what}; FULL=yes shows them")

    def add_scripts(self, node: Tree, sources: dict[str, str]) -> None:
        for name, digest in self.first(node, sources.items(), "scripts"):
            found = search(name, held_below(name, digest))[0]
            node.add(plain(f"{name}  {short(digest)}  {found}"))

    def add_data(self, tree: Tree, name: str, data: dict[str, Any], build: dict[str, Any]) -> None:
        here = holding(ROOT / name, data["sha256"]) is not None
        other = (
            "is here with other bytes"
            if (ROOT / name).is_file()
            else f"is not here: `{remedy(name)}` makes it again"
        )
        node = tree.add(plain(f"{name}  {short(data['sha256'])}  {'is here' if here else other}"))
        if here:
            add_parameters(node, load(ROOT / name))
        else:
            node.add(f"seed {data['seed']}")
        self.add_build(node, data["build_id"], build)

    def add_build(self, node: Tree, identifier: str, build: dict[str, Any]) -> None:
        above = identifier in self.shown
        self.shown.add(identifier)
        text = f"program {build['program']}  build {short(identifier)}{'  as above' if above else ''}"
        program = node.add(plain(text))
        if above:
            return
        program.add(plain(f"{build['compiler']}, {build['flags']}"))
        program.add(plain(f"libraries  {build['libraries']}"))
        found, contents = search("cpp", lambda root: closure(root / "cpp", build))
        sources = program.add(plain(f"sources  {short(build['source_hash'])}  {found}"))
        for name, digest in self.first(sources, (contents or {}).items(), "sources"):
            sources.add(plain(f"cpp/{name}  {short(digest)}"))


def add_parameters(node: Tree, result: Result) -> None:
    values = ", ".join(f"{name} {value}" for name, value in result.parameters.items() if name != "seed")
    node.add(plain(f"seed {result.provenance['seed']}, streams {result.provenance['streams']}"))
    node.add(plain(f"parameters  {values}"))


def plain(text: str) -> str:
    """Without markup of rich, and printable."""
    return escape(printable(text))


def holding(path: Path, digest: str) -> bytes | None:
    """What the file holds, if it has this hash."""
    return path.read_bytes() if path.is_file() and file_hash(path) == digest else None


def held_below(name: str, digest: str) -> Callable[[Path], bytes | None]:
    """Reads the file below a root, if it has this hash."""
    return lambda root: holding(root / name, digest)


def closure(folder: Path, build: dict[str, Any]) -> dict[str, str] | None:
    """Hashes of the sources that the program is built from, if they are those of the build."""
    source = f"observables/{build['program']}.cpp"
    if not (folder / source).is_file():
        return None
    hashes = content_hashes(folder, include_closure(folder, source))
    return hashes if source_hash(hashes) == build["source_hash"] else None


def asks_for(root: Path, parents: Parents) -> Panel | None:
    """The panel, if the configuration asks for it as it is."""
    try:
        panel = load_plan(parents.quality, root / CONFIGURATION).get(parents.panel)
    except ConfigurationError:
        return None
    return panel if panel and panel.hash() == parents.configuration else None


def search(path: str, read: Callable[[Path], Found | None]) -> tuple[str, Found | None]:
    """Where `read` finds something, the working tree or the newest such commit of the path, and what."""
    if (found := read(ROOT)) is not None:
        return HERE, found
    for commit in commits(path) if fsck() is None else []:  # the audit says what is damaged
        with tempfile.TemporaryDirectory() as folder:
            unpack(commit, path, Path(folder))
            if (found := read(Path(folder))) is not None:
                return f"as in commit {commit[:12]}", found
    return LOST, None


def unpack(commit: str, source: str, folder: Path) -> None:
    for name, text in (stored_at(commit, source) or {}).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(text)


def short(digest: str) -> str:
    return digest[:SHORT]


def refuse(file: Path, why: str) -> NoReturn:
    print(printable(f"make provenance: {file}: {why}"), file=sys.stderr)
    sys.exit(BAD_INPUT)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    parser.add_argument("--full", action="store_true", help="every source, package and file of data")
    options = parser.parse_args()
    try:
        if options.file.exists() and not options.file.is_file():
            refuse(options.file, "is not a file")
        digest = file_hash(options.file)
    except OSError as error:
        refuse(options.file, error.strerror or str(error))
    found, damaged = makers(digest)
    committed = None if found else commit_with(options.file)
    console = Console(highlight=False, width=None if sys.stdout.isatty() else UNLIMITED)
    name = plain(options.file.name)
    if found:
        console.print(f"{name} is what {plain(found[0])}")
    elif committed:
        commit, path = committed
        console.print(f"{name} is what commit {short(commit)} has as {plain(path)}; no job here wrote it")
    elif damaged:
        console.print(f"{name} is not what any job wrote whose lock can be read here, and not every one can")
    else:
        console.print(f"{name} is not what any job here wrote: edited, damaged or made elsewhere")
    for line in damaged:
        console.print(plain(line))
    try:
        tree = Ancestry(options.full).product(options.file)
    except (ValueError, KeyError, AttributeError, OSError) as error:  # a forged file may hold anything
        sys.exit(printable(f"make provenance: {error}"))
    said = "What it says of itself"
    console.print(
        "What it was made from:"
        if found
        else f"{said}:"
        if committed
        else f"{said}, which nothing here confirms:"
    )
    console.print(tree)
    sys.exit(0 if found or committed else NOT_CHECKED if damaged else 1)


if __name__ == "__main__":
    main()
