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

from workflow.lib.load import FormatError, Result, load
from workflow.lib.parents import PACKAGES, ArtefactError, Parents, file_hash
from workflow.lib.plan import ConfigurationError, Panel, load_plan
from workflow.provenance.build_id import content_hashes, include_closure, source_hash
from workflow.provenance.repository import ROOT, commits, files_at

SHORT = 16  # digits of a hash that are shown
UNLIMITED = 100_000  # columns, where nobody reads them on a screen
HERE = "as in the working tree"
LOST = "not found in the repository"
CONFIGURATION = "workflow/config"

Found = TypeVar("Found")


def product_tree(path: Path) -> Tree:
    """Raises ArtefactError or FormatError if the file does not say what it was made from."""
    title = f"{path.name}  {short(file_hash(path))}" if path.is_file() else path.name
    if path.suffix == ".h5":
        tree, result = Tree(escape(title)), load(path)
        add_parameters(tree, result)
        add_build(tree, result.provenance["build_id"], result.provenance)
        return tree
    parents = Parents.of(path)
    tree = Tree(escape(f"{title}  panel {parents.panel} at quality {parents.quality}"))
    found = search(CONFIGURATION, lambda root: asks_for(root, parents))[0]
    tree.add(escape(f"configuration  {short(parents.configuration)}  {found}"))
    found, locked = search(PACKAGES, lambda root: holding(root / PACKAGES, parents.packages))
    node = tree.add(escape(f"{PACKAGES}  {short(parents.packages)}  {found}; Python {parents.python}"))
    if names := re.findall(r"^([\w.-]+==[^ ;\\]+)", (locked or b"").decode(), re.MULTILINE):
        node.add(escape(", ".join(names)))
    scripts = tree.add("scripts")
    for name, digest in parents.sources.items():
        found = search(name, lambda root, name=name, digest=digest: holding(root / name, digest))[0]
        scripts.add(escape(f"{name}  {short(digest)}  {found}"))
    shown: set[str] = set()
    for name, data in parents.data.items():
        add_data(tree, name, data, parents.builds[data["build_id"]], data["build_id"] in shown)
        shown.add(data["build_id"])
    return tree


def add_data(tree: Tree, name: str, data: dict, build: dict, shown: bool) -> None:
    here = holding(ROOT / name, data["sha256"]) is not None
    other = (
        "is here with other bytes"
        if (ROOT / name).is_file()
        else "is not here: `make figures` makes it again"
    )
    node = tree.add(escape(f"{name}  {short(data['sha256'])}  {'is here' if here else other}"))
    if here:
        add_parameters(node, load(ROOT / name))
    else:
        node.add(f"seed {data['seed']}")
    add_build(node, data["build_id"], build, shown)


def add_parameters(node: Tree, result: Result) -> None:
    values = ", ".join(f"{name} {value}" for name, value in result.parameters.items() if name != "seed")
    node.add(f"seed {result.provenance['seed']}, streams {result.provenance['streams']}")
    node.add(escape(f"parameters  {values}"))


def add_build(node: Tree, identifier: str, build: dict, shown: bool = False) -> None:
    program = node.add(
        escape(f"program {build['program']}  build {short(identifier)}{'  as above' if shown else ''}")
    )
    if shown:
        return
    program.add(escape(f"{build['compiler']}, {build['flags']}"))
    program.add(escape(f"libraries  {build['libraries']}"))
    found, contents = search("cpp", lambda root: closure(root / "cpp", build))
    sources = program.add(escape(f"sources  {short(build['source_hash'])}  {found}"))
    for name, digest in (contents or {}).items():
        sources.add(escape(f"cpp/{name}  {short(digest)}"))


def holding(path: Path, digest: str) -> bytes | None:
    """What the file holds, if it has this hash."""
    return path.read_bytes() if path.is_file() and file_hash(path) == digest else None


def closure(folder: Path, build: dict) -> dict[str, str] | None:
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
