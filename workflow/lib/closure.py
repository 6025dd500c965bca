"""Closure of a script: everything of the project that it reads."""

import ast
import os
import re
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from workflow.lib.files import ROOT, file_hash

PACKAGES = "uv.lock"
PATH = re.compile(r"\w[\w.-]*(/\w[\w.-]*)*")  # a literal that may name a file


def sources_of(script: str) -> list[str]:
    """Sorted paths of the closure of a script: the modules of the project that it imports, and the files that these read, directly or
    indirectly. A file is taken as read if a literal of a module names it, relative to the module's folder or one above it; a folder is
    taken with its content."""
    closure: set[str] = set()
    waiting = [script]
    while waiting:
        path = waiting.pop()
        if path not in closure and (ROOT / path).is_file():
            closure.add(path)
            if path.endswith(".py"):
                waiting += _used(path, (ROOT / path).read_text("utf-8"))
    return sorted(closure)


@cache  # panels have most modules in common
def _used(path: str, source: str) -> tuple[str, ...]:
    try:
        nodes = [*ast.walk(ast.parse(source))]
    except SyntaxError:  # reported where the script runs
        return ()
    used = [alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names]
    package = Path(path).parts[:-1]
    for node in nodes:
        if isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else ()
            module = ".".join([*above, *([node.module] if node.module else [])])
            used += [module, *(f"{module}.{alias.name}" for alias in node.names)]
    modules = [name.replace(".", "/") + ".py" for name in used if name.partition(".")[0] == package[0]]
    literals = {
        node.value for node in nodes if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    return (*modules, *(file for literal in literals for file in _files_named(literal, Path(path).parent)))


def _files_named(literal: str, folder: Path) -> Iterator[str]:
    if not PATH.fullmatch(literal):
        return
    for above in (folder, *folder.parents):
        candidate = above / literal
        if (ROOT / candidate).is_file():
            yield str(candidate)
        elif (ROOT / candidate).is_dir() and above == folder:
            content = (ROOT / candidate).rglob("*")
            yield from (
                str(file.relative_to(ROOT)) for file in content if file.is_file() and file.suffix != ".pyc"
            )


@cache
def _hash(path: str) -> str:
    return file_hash(ROOT / path)


def hashes_of(script: str) -> dict[str, str]:
    """sha256 of every file in the closure of a script, and of the locked packages. Raises OSError."""
    return {path: _hash(path) for path in (*sources_of(script), PACKAGES)}


class FilesRead:
    """Files of the project that this process reads from now on, modules included."""

    def __init__(self) -> None:
        self._opened: set[str] = set()
        sys.addaudithook(self._note)

    def _note(self, event: str, arguments: tuple[object, ...]) -> None:
        if (
            event == "open"
            and isinstance(arguments[0], str)
            and not int(str(arguments[2])) & (os.O_WRONLY | os.O_RDWR)
        ):
            self._opened.add(arguments[0])

    def beside(self, closure: Iterable[str]) -> list[str]:
        """Sorted paths of the files that are not in a closure; products, environment and caches are no sources."""
        modules = {
            str(module.__file__) for module in [*sys.modules.values()] if getattr(module, "__file__", None)
        }
        paths = (Path(name).resolve() for name in self._opened | modules)
        names = {
            str(path.relative_to(ROOT)) for path in paths if path.is_relative_to(ROOT) and path.is_file()
        }
        made = {
            name
            for name in names
            if name.startswith((".", "build/", "figures/")) or name.endswith((".h5", ".pyc"))
        }
        return sorted(names - made - {*closure})
