"""Prints what a product was made from, down to sources, seeds and locked packages.

Works on a copy anywhere: the file names its parents by hash, and the repository is asked where they are, in the
working tree, in data/ or in a commit.
"""

import argparse
import re
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from rich.console import Console
from rich.markup import escape
from rich.tree import Tree

from workflow.config.plan import ConfigurationError, Panel, load_plan
from workflow.provenance.build_id import content_hashes, include_closure, source_hash
from workflow.provenance.parents import ArtefactError, Parents, file_hash
from workflow.provenance.repository import ROOT, commits, files_at
from workflow.provenance.stale import PACKAGES
from workflow.scripts.load import FormatError, Result, load

SHORT = 16  # digits of a hash that are shown
UNLIMITED = 100_000  # columns, where nobody reads them on a screen
HERE = "as in the working tree"
LOST = "not found in the repository"
CONFIGURATION = "workflow/config"

Found = TypeVar("Found")


def product_tree(path: Path) -> Tree:
    """Raises ArtefactError or FormatError if the file does not say what it was made from."""
    root = f"{path.name}  {short(file_hash(path))}" if path.is_file() else path.name
    if path.suffix == ".h5":
        return run_node(Tree(escape(root)), load(path))
    parents = Parents.of(path)
    tree = Tree(escape(f"{root}  panel {parents.panel} at quality {parents.quality}"))
    found = configuration_place(parents.quality, parents.panel, parents.configuration)
    tree.add(escape(f"configuration  {short(parents.configuration)}  {found}"))
    add_packages(tree, parents)
    scripts = tree.add("scripts")
    for name, digest in parents.sources.items():
        scripts.add(escape(f"{name}  {short(digest)}  {place(name, digest)}"))
    shown: set[str] = set()
    for name, data in parents.data.items():
        node = tree.add(escape(f"{name}  {short(data['sha256'])}  {data_place(name, data['sha256'])}"))
        present = ROOT / name
        if present.is_file() and file_hash(present) == data["sha256"]:
            add_parameters(node, load(present))
        else:
            node.add(f"seed {data['seed']}")
        add_build(node, data["build_id"], parents.builds[data["build_id"]], data["build_id"] in shown)
        shown.add(data["build_id"])
    return tree


def run_node(tree: Tree, result: Result) -> Tree:
    add_parameters(tree, result)
    add_build(tree, result.provenance["build_id"], result.provenance, shown=False)
    return tree


def add_parameters(node: Tree, result: Result) -> None:
    values = ", ".join(f"{name} {value}" for name, value in result.parameters.items() if name != "seed")
    node.add(f"seed {result.provenance['seed']}, streams {result.provenance['streams']}")
    node.add(escape(f"parameters  {values}"))


def add_build(node: Tree, identifier: str, build: dict, shown: bool) -> None:
    title = f"program {build['program']}  build {short(identifier)}"
    if shown:
        node.add(escape(f"{title}  as above"))
        return
    program = node.add(escape(title))
    program.add(escape(f"{build['compiler']}, {build['flags']}"))
    program.add(escape(f"libraries  {build['libraries']}"))
    found, contents = closure(build["program"], build["source_hash"])
    sources = program.add(escape(f"sources  {short(build['source_hash'])}  {found}"))
    for name, digest in (contents or {}).items():
        sources.add(escape(f"cpp/{name}  {short(digest)}"))


def add_packages(tree: Tree, parents: Parents) -> None:
    found, text = content(PACKAGES, parents.packages)
    node = tree.add(escape(f"{PACKAGES}  {short(parents.packages)}  {found}; Python {parents.python}"))
    if names := re.findall(r"^([\w.-]+==[^ ;\\]+)", (text or b"").decode(), re.MULTILINE):
        node.add(escape(", ".join(names)))


def place(path: str, digest: str) -> str:
    return content(path, digest)[0]


def data_place(path: str, digest: str) -> str:
    if not (ROOT / path).is_file():
        return "is not here: `make figures` makes it again"
    return "is here" if file_hash(ROOT / path) == digest else "is here with other bytes"


def content(path: str, digest: str) -> tuple[str, bytes | None]:
    """Where the file with this hash is, and what it holds."""

    def read(root: Path) -> bytes | None:
        holds = (root / path).is_file() and file_hash(root / path) == digest
        return (root / path).read_bytes() if holds else None

    return search(path, read)


def closure(program: str, digest: str) -> tuple[str, dict[str, str] | None]:
    """Where the sources with this hash are, and the hash of each."""
    source = f"observables/{program}.cpp"

    def read(root: Path) -> dict[str, str] | None:
        folder = root / "cpp"
        if not (folder / source).is_file():
            return None
        hashes = content_hashes(folder, include_closure(folder, source))
        return hashes if source_hash(hashes) == digest else None

    return search("cpp", read)


def configuration_place(quality: str, panel: str, digest: str) -> str:
    """Where the configuration asks for the panel as it is."""

    def read(root: Path) -> Panel | None:
        try:
            found = load_plan(quality, root / CONFIGURATION).get(panel)
        except ConfigurationError:
            return None
        return found if found and found.hash() == digest else None

    return search(CONFIGURATION, read)[0]


def search(path: str, read: Callable[[Path], Found | None]) -> tuple[str, Found | None]:
    """Where `read` finds something, the working tree or the newest such commit of the path, and what."""
    if (found := read(ROOT)) is not None:
        return HERE, found
    for commit in commits(path):
        with tempfile.TemporaryDirectory() as folder:
            unpack(commit, path, Path(folder))
            if (found := read(Path(folder))) is not None:
                return f"as in commit {commit[:12]}", found
    return LOST, None


def unpack(commit: str, source: str, folder: Path) -> None:
    for name, text in (files_at(commit, source) or {}).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(text)


def short(digest: str) -> str:
    return digest[:SHORT]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    path = parser.parse_args().file
    try:
        tree = product_tree(path)
    except (ArtefactError, FormatError) as error:
        sys.exit(f"make provenance: {error}")
    Console(highlight=False, width=None if sys.stdout.isatty() else UNLIMITED).print(tree)


if __name__ == "__main__":
    main()
