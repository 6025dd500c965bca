"""The parts of the workflow import one another in one direction."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.python.conftest import ROOT

# What each part may import, besides itself.
ALLOWED = {
    "lib": set(),
    "config": {"lib"},
    "figures": {"lib"},
    "tradeoff": {"lib"},
    "provenance": {"lib", "environment"},
    "execution": {"lib", "tradeoff"},
    "claims": {"lib", "figures"},
    "report": {"lib", "claims", "provenance"},
    "environment": {"lib"},
}


def imported_modules(source: str) -> Iterator[str]:
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from (f"{'.' * node.level}{node.module or ''}.{alias.name}" for alias in node.names)


def imports(root: Path) -> dict[str, set[str]]:
    """Parts of the workflow that the modules of each part import; a relative import stands as it is."""
    graph: dict[str, set[str]] = {}
    for path in (root / "workflow").rglob("*.py"):
        part = path.relative_to(root / "workflow").parts[0]
        named = [name.split(".") for name in imported_modules(path.read_text())]
        parts = {words[1] for words in named if words[0] in ("workflow", "")}
        graph.setdefault(part, set()).update(parts - {part})
    return graph


def wrong_way(graph: dict[str, set[str]]) -> set[tuple[str, str]]:
    return {(part, other) for part, others in graph.items() for other in others - ALLOWED[part]}


def test_imports_run_one_way() -> None:
    graph = imports(ROOT)
    assert graph.keys() == ALLOWED.keys()
    assert graph["figures"] == {"lib"}  # the graph is not empty
    assert wrong_way(graph) == set()


@pytest.mark.parametrize(
    "line",
    [
        "from workflow.provenance.lock import Lock",
        "from workflow.provenance import lock",
        "import workflow.provenance.lock",
        "def late():\n    from workflow import provenance",
    ],
)
def test_an_import_in_the_other_direction_is_found(tmp_path: Path, line: str) -> None:
    (tmp_path / "workflow/lib").mkdir(parents=True)
    (tmp_path / "workflow/lib/load.py").write_text(f"{line}\n")
    assert wrong_way(imports(tmp_path)) == {("lib", "provenance")}
