"""Which files of the project a Python script is made of."""

import ast
import errno
from functools import cache
from pathlib import Path

from workflow.provenance.repository import ROOT


def sources_of(script: str) -> list[str]:
    """The script and every module of the project that it imports, directly or not; relative paths, the script
    first, the others sorted. Raises OSError if one is missing or no Python."""
    found: set[str] = set()
    waiting = [script]
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            waiting += _imported(ROOT / path)
    return [script, *sorted(found - {script})]


def _imported(path: Path) -> list[str]:
    if not path.is_file():
        raise FileNotFoundError(errno.ENOENT, "missing or not a file", str(path.relative_to(ROOT)))
    try:
        named = _named(path.read_text("utf-8"))
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:  # also of a byte that is no text
        raise OSError(errno.EINVAL, f"no Python: {error}", str(path.relative_to(ROOT))) from error
    return [file for file in named if (ROOT / file).is_file()]


@cache  # panels share most of what they import
def _named(source: str) -> tuple[str, ...]:
    """Modules in `import workflow.a.b`, `from workflow.a.b import c` and `from workflow.a import b`, as files."""
    names = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return tuple(name.replace(".", "/") + ".py" for name in names if name.startswith("workflow."))
