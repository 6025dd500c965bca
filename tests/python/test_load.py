"""The loader takes the order of the dimensions from the dimension scales, and names units of all that it returns."""

import os
from collections.abc import Mapping
from pathlib import Path

import h5py
import numpy as np
import pytest

from workflow.lib.load import FORMAT, FORMAT_VERSION, FormatError, Quantity, load

TIME, CELL = np.array([1.0, 2.0, 4.0]), np.array([0.5, 1.5, 2.5])
MEAN = np.arange(9.0).reshape(3, 3)  # a square: lengths do not tell its dimensions apart


def write(path: Path, axes: Mapping[str, np.ndarray], values: Mapping[str, np.ndarray]) -> h5py.Group:
    """A file with one quantity, `energy`, whose dimensions are the axes in their order."""
    with h5py.File(path, "w") as file:
        file.create_group("parameters")
        file.create_group("provenance").attrs.update({"format": FORMAT, "format_version": FORMAT_VERSION})
        group = file.create_group("results/energy")
        for name, array in {**axes, **values}.items():
            group[name] = array
            units = (
                name if name in axes and name != "cell" else "1" if name in ("cell", "count") else "energy"
            )
            group[name].attrs.update({"units": units, "description": f"what {name} is"})
        for name in axes:
            group[name].make_scale(name)
        for name in values:
            for i, axis in enumerate(axes):
                group[name].dims[i].attach_scale(group[axis])


@pytest.fixture
def measured() -> dict[str, np.ndarray]:
    return {"mean": MEAN, "standard_error": MEAN / 10, "count": np.full((3, 3), 7, dtype="u8")}


def energy(path: Path) -> Quantity:
    return load(path)["energy"]


def test_a_square_has_its_dimensions_in_the_order_of_its_scales(tmp_path: Path, measured: dict) -> None:
    write(tmp_path / "a.h5", {"time": TIME, "cell": CELL}, measured)
    write(tmp_path / "b.h5", {"cell": CELL, "time": TIME}, measured)
    assert list(energy(tmp_path / "a.h5").axes) == ["time", "cell"]
    assert list(energy(tmp_path / "b.h5").axes) == ["cell", "time"]
    assert energy(tmp_path / "a.h5").to_xarray()["mean"].sel(time=4, cell=0.5) == MEAN[2, 0]
    assert energy(tmp_path / "b.h5").to_xarray()["mean"].sel(time=4, cell=0.5) == MEAN[0, 2]


def test_xarray_has_units_and_descriptions(tmp_path: Path, measured: dict) -> None:
    write(tmp_path / "a.h5", {"time": TIME, "cell": CELL}, measured)
    dataset = energy(tmp_path / "a.h5").to_xarray()
    assert set(dataset.data_vars) == {"mean", "standard_error", "count"}
    assert all(dataset[name].dims == ("time", "cell") for name in dataset.data_vars)
    for name, array in {**measured, "time": TIME, "cell": CELL}.items():
        np.testing.assert_array_equal(dataset[name], array)
    units = {"mean": "energy", "standard_error": "energy", "count": "1", "time": "time", "cell": "1"}
    for name, text in units.items():
        assert dataset[name].attrs == {"units": text, "description": f"what {name} is"}


def test_frame_has_a_row_per_value(tmp_path: Path, measured: dict) -> None:
    write(tmp_path / "a.h5", {"time": TIME, "cell": CELL}, measured)
    frame = energy(tmp_path / "a.h5").to_frame()
    assert list(frame) == ["time", "cell", "mean", "standard_error", "count"]
    assert len(frame) == 9
    row = frame[(frame.time == 4) & (frame.cell == 0.5)]
    assert row[["mean", "standard_error", "count"]].to_numpy().tolist() == [[MEAN[2, 0], MEAN[2, 0] / 10, 7]]
    assert frame.attrs["units"] == {
        "time": "time",
        "cell": "1",
        "mean": "energy",
        "standard_error": "energy",
        "count": "1",
    }
    assert frame.attrs["description"]["mean"] == "what mean is"


def test_a_number_and_what_is_computed(tmp_path: Path) -> None:
    write(tmp_path / "a.h5", {}, {"mean": np.array(2.0), "discretisation_error": np.array(0.5)})
    frame, dataset = energy(tmp_path / "a.h5").to_frame(), energy(tmp_path / "a.h5").to_xarray()
    assert frame.to_dict("records") == [{"mean": 2.0, "discretisation_error": 0.5}]
    assert dataset["mean"].dims == ()
    assert dataset["discretisation_error"] == 0.5


def test_dimensions_without_a_scale_of_their_own_are_refused(tmp_path: Path, measured: dict) -> None:
    for number, spoil in enumerate(
        (
            lambda group: group["mean"].dims[1].detach_scale(group["cell"]),
            lambda group: group["mean"].dims[1].attach_scale(group["time"]),
            lambda group: group.__delitem__("cell"),
        )
    ):
        path = tmp_path / f"{number}.h5"
        write(path, {"time": TIME, "cell": CELL}, measured)
        with h5py.File(path, "r+") as file:
            spoil(file["results/energy"])
        with pytest.raises(FormatError, match="each dimension needs one dimension scale"):
            load(path)


def test_what_belongs_to_no_dimension_is_refused(tmp_path: Path, measured: dict) -> None:
    write(tmp_path / "a.h5", {"time": TIME, "cell": CELL}, measured)
    with h5py.File(tmp_path / "a.h5", "r+") as file:
        file["results/energy/more"] = TIME
    with pytest.raises(FormatError, match="more belong to no dimension"):
        load(tmp_path / "a.h5")


@pytest.mark.parametrize("link", [h5py.ExternalLink("b.h5", "/results"), h5py.SoftLink("/parameters")])
def test_no_link_is_followed(tmp_path: Path, measured: dict, link: object) -> None:
    for name in ("a.h5", "b.h5"):
        write(tmp_path / name, {"time": TIME, "cell": CELL}, measured)
    with h5py.File(tmp_path / "a.h5", "r+") as file:
        del file["results"]
        file["results"] = link
    with pytest.raises(FormatError, match="results is a link"):
        load(tmp_path / "a.h5")


def test_no_pipe_is_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "a.h5")
    with pytest.raises(FormatError, match="a pipe lies where a file belongs"):
        load(tmp_path / "a.h5")


def test_a_name_that_is_no_text_is_no_result(tmp_path: Path, measured: dict) -> None:
    """One bit flipped in the name of a dataset, which h5py tells as an error of the system."""
    path = tmp_path / "a.h5"
    write(path, {"time": TIME, "cell": CELL}, measured)
    content = path.read_bytes()
    assert b"standard_error" in content
    path.write_bytes(content.replace(b"standard_error", b"\xf3tandard_error"))
    with pytest.raises(FormatError, match="is not a result file"):
        load(path)
