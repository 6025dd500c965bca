"""The layers of cpp: includes go one way, so that each layer is understood without those above it."""

import re

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


def test_includes_run_one_way() -> None:
    included = {
        (source.relative_to(ROOT / "cpp").parts[0], layer)
        for source in (ROOT / "cpp").rglob("*.[ch]pp")
        for layer in re.findall(r'^#include "(\w+)/', source.read_text(), re.MULTILINE)
    }
    assert {own for own, _ in included} <= BELOW.keys()
    assert {(own, layer) for own, layer in included if layer not in BELOW[own] | {own}} == set()


# The same for the packages of workflow. All that runs while a panel is rendered is in its script, physics,
# lib and
# render, which its identity hashes, or in `inputs` of the panel. Nothing outside of the study imports it.
PYTHON = {
    "lib": set(),
    "physics": {"lib"},
    "figures": {"lib", "physics"},
    "render": {"lib", "physics"},
    "pipeline": {"lib", "render"},
    "study": {"lib", "physics", "render", "pipeline"},
}


def test_imports_run_one_way() -> None:
    imported = {
        (source.relative_to(ROOT / "workflow").parts[0], package)
        for source in (ROOT / "workflow").glob("*/**/*.py")
        for package in re.findall(
            r"(?:\bfrom|^import) workflow(?:\.(\w+))?", source.read_text(), re.MULTILINE
        )
    }
    assert {own for own, _ in imported} <= PYTHON.keys()
    assert {(own, package) for own, package in imported if package not in PYTHON[own] | {own}} == set()
