"""The layers of cpp: includes go one way, so that each layer is understood without those above it."""

import re
from pathlib import Path

CPP = Path(__file__).parents[2] / "cpp"

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
    "bench": {"sampling", "engine", "boltzmann", "program", "model", "numerics", "reference"},  # of tests/cpp
}


def includes(folder):
    """Pairs of a source file and a layer from which it includes a file."""
    for source in sorted(folder.rglob("*.[ch]pp")):
        for layer in re.findall(r'^#include "(\w+)/', source.read_text(), re.MULTILINE):
            yield source, layer


def upward(folder, below):
    return [
        f"{source.relative_to(folder)} includes {layer}/"
        for source, layer in includes(folder)
        if layer != (own := source.relative_to(folder).parts[0]) and layer not in below.get(own, set())
    ]


def test_every_folder_is_a_layer():
    assert {folder.name for folder in CPP.iterdir() if folder.is_dir()} == set(BELOW)


def test_includes_run_one_way():
    assert upward(CPP, BELOW) == []


def test_an_include_of_a_layer_above_is_found(tmp_path):
    (tmp_path / "model").mkdir()
    (tmp_path / "model" / "chain.hpp").write_text(
        '#include "engine/path.hpp"\n#include "numerics/random.hpp"\n'
    )
    assert upward(tmp_path, BELOW) == ["model/chain.hpp includes engine/"]
