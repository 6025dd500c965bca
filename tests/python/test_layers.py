"""The layers of cpp: includes go one way, so that each layer is understood without those above it."""

import re

from tests.python.conftest import ROOT
from workflow.pipeline.plan import load_plan

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


# The same for the packages of workflow. All that runs while a panel is rendered is in its script, physics and
# lib, which its identity hashes; and in claims for the panels that declare it in `reads`.
PYTHON = {
    "lib": set(),
    "physics": {"lib"},
    "figures": {"lib", "physics", "claims"},
    "pipeline": {"lib"},
    "claims": {"lib", "physics"},
    "report": {"lib", "physics", "pipeline", "claims"},
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


def test_only_the_picture_of_the_verdicts_imports_claims() -> None:
    scripts = (ROOT / "workflow/figures").glob("*.py")
    assert [path.stem for path in scripts if "workflow.study.claims" in path.read_text()] == ["verdicts"]
    assert {"workflow/claims", "data/claims.csv"} <= {*load_plan("paper")["verdicts"].reads}
