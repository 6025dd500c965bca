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
    "bench": {"engine", "boltzmann", "model", "numerics", "reference"},  # of tests/cpp
}


def test_includes_run_one_way() -> None:
    included = {
        (source.relative_to(ROOT / "cpp").parts[0], layer)
        for source in (ROOT / "cpp").rglob("*.[ch]pp")
        for layer in re.findall(r'^#include "(\w+)/', source.read_text(), re.MULTILINE)
    }
    assert {own for own, _ in included} <= BELOW.keys()
    assert {(own, layer) for own, layer in included if layer not in BELOW[own] | {own}} == set()
