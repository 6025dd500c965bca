"""Result files of every program: the described quantities with their units and axes, types of all values, and
the same bytes for any number of threads."""

from pathlib import Path
from typing import Any

import h5py
import pytest

from tests.python.conftest import Measure, Program
from tests.python.described import described, options_of_programs
from workflow.lib.load import load

MEASURED, COMPUTED = {"mean", "standard_error", "count"}, {"mean", "discretisation_error"}
PROVENANCE = (
    "format format_version program option_words source_hash compiler flags libraries events "
    "target_quantity target_error achieved_error error_without_control_variates converged"
)
TYPES = {"integer": int, "number": float, "boolean": bool, "string": str}


def types(option: dict[str, Any]) -> set[type]:
    """Types that an option may have."""
    return {TYPES[name] for name in option["types"]}


def axes_of(dataset: h5py.Dataset) -> list[h5py.Dataset]:
    return [scale for dimension in dataset.dims for scale in dimension.values()]


def content(group: h5py.Group) -> tuple[str, list[tuple[str, str]]]:
    """Units and axes of a quantity."""
    axes = [(Path(axis.name).name, axis.attrs["units"].decode()) for axis in axes_of(group["mean"])]
    return group["mean"].attrs["units"].decode(), axes


@pytest.mark.parametrize("name", described())
def test_files_have_the_described_content_and_the_same_bytes_for_any_threads(
    program: Program, tmp_path: Path, name: str
) -> None:
    replicated = "replicas" in options_of_programs()[name]
    for threads in (1, 3):
        done = program(name, output=f"{threads}.h5", **({"threads": threads} if replicated else {}))
        assert done.returncode == 0, done.stderr
    assert (tmp_path / "1.h5").read_bytes() == (tmp_path / "3.h5").read_bytes()
    with h5py.File(tmp_path / "1.h5") as file:
        assert {key: content(group) for key, group in file["results"].items()} == {
            quantity["name"]: (
                quantity["units"],
                [(axis["name"], axis["units"]) for axis in quantity["axes"]],
            )
            for quantity in described()[name]["quantities"]
        }
        for group in file["results"].values():
            kinds = group.keys() & (MEASURED | COMPUTED)
            assert kinds == (MEASURED if replicated else COMPUTED)
            for kind, dataset in ((kind, group[kind]) for kind in kinds):
                assert dataset.shape == tuple(len(axis) for axis in axes_of(dataset))
                assert dataset.dtype == ("int64" if kind == "count" else "float64")
                assert kind == "count" or dataset.attrs["units"] == group["mean"].attrs["units"]
        assert {*file["provenance"].attrs} == {*PROVENANCE.split()}
        signed = {"int64", "float64", "bool"}
        assert {
            file[group].attrs[key].dtype.name
            for group in ("parameters", "provenance")
            for key in file[group].attrs
            if not isinstance(file[group].attrs[key], str | bytes)
        } <= signed | {"bytes"}
    options = options_of_programs()[name]
    result = load(tmp_path / "1.h5")
    for key, value in result.parameters.items():
        option = options[key.replace("_", "-")]
        assert type(value) in types(option), key
        assert result.parameter_roles[key] == option["role"], key


@pytest.mark.parametrize("name", ["conductivity", "boltzmann"])
def test_a_number_has_its_type_where_a_word_may_be(measure: Measure, name: str) -> None:
    """Detected mistakes: whole numbers are stored as floating point, or unsigned, so that 3 - 5 is 1.8e19."""
    result = measure(name, cells=3, gamma=2)
    cells, gamma = result.parameters["cells"], result.parameters["gamma"]
    assert (cells - 5, type(cells), type(gamma)) == (-2, int, float)
    counts = [quantity.count for quantity in result.quantities.values() if quantity.count is not None]
    assert all((count - 100 < 0).all() for count in counts)
