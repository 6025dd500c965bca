"""Includes in cpp and imports in workflow go one way: a layer is understood without those above it."""

import re

import pytest

from tests.python.conftest import ROOT

# Every layer with the layers that its files may include besides their own.
BELOW = {
    "numerics": set(),
    "model": {"numerics"},
    "statistics": {"numerics"},
    "engine": {"model", "numerics"},
    "boltzmann": {"model", "numerics"},
    "program": {"statistics", "numerics"},
    "sampling": {"engine", "program", "statistics", "model", "numerics"},
    "observables": {"sampling", "engine", "boltzmann", "program", "statistics", "model", "numerics"},
}

# All that runs while a panel is rendered is in its script, physics, lib and render, which its identity
# hashes, or in `inputs` of the panel. Nothing outside of the study imports it.
PYTHON = {
    "lib": set(),
    "physics": {"lib"},
    "figures": {"lib", "physics"},
    "render": {"lib", "physics"},
    "pipeline": {"lib", "render"},
    "study": {"lib", "physics", "render", "pipeline"},
}


@pytest.mark.parametrize(
    ("folder", "files", "included", "allowed"),
    [
        ("cpp", "**/*.[ch]pp", r'^#include "(\w+)/', BELOW),
        ("workflow", "*/**/*.py", r"(?:\bfrom|^import) workflow(?:\.(\w+))?", PYTHON),
    ],
    ids=["cpp", "workflow"],
)
def test_includes_run_one_way(folder: str, files: str, included: str, allowed: dict[str, set[str]]) -> None:
    found = {
        (source.relative_to(ROOT / folder).parts[0], layer)
        for source in (ROOT / folder).glob(files)
        for layer in re.findall(included, source.read_text(), re.MULTILINE)
    }
    assert {own for own, _ in found} <= allowed.keys()
    assert {(own, layer) for own, layer in found if layer not in allowed[own] | {own}} == set()
