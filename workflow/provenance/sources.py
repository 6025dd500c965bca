"""Which files of the project a Python script is made of."""

import ast
from pathlib import Path

from workflow.provenance.repository import ROOT


def sources_of(script: str) -> list[str]:
    """The script and every module of the project that it imports, directly or not; relative paths, the script
    first, the others sorted. Raises FileNotFoundError if one is missing."""
    found: set[str] = set()
    waiting = [script]
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            waiting += _imported(ROOT / path)
    return [script, *sorted(found - {script})]


def _imported(path: Path) -> list[str]:
    """Modules named in `import workflow.a.b`, `from workflow.a.b import c` and `from workflow.a import b`."""
    if not path.is_file():
        raise FileNotFoundError(f"{path.relative_to(ROOT)} is missing or not a file")
    names = []
    for node in ast.walk(ast.parse(path.read_text(), path.name)):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    files = [name.replace(".", "/") + ".py" for name in names if name.startswith("workflow.")]
    return [file for file in files if (ROOT / file).is_file()]
