"""The loader takes the order of the dimensions from the dimension scales, and gives the units of all values."""

import errno
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path

import h5py
import numpy as np
import pytest

from workflow.identity import result_identity
from workflow.lib.load import (
    FORMAT,
    FORMAT_VERSION,
    FormatError,
    Quantity,
    load,
    load_provenance,
    results_digest,
)

BUILT = {"program": "ageing", "words": "--cells 4 --sigma 0.5", "source_hash": "0123"}
TIME, CELL = np.array([1.0, 2.0, 4.0]), np.array([0.5, 1.5, 2.5])
MEAN = np.arange(9.0).reshape(3, 3)  # square, so that lengths do not identify the dimensions


def write(path: Path, axes: Mapping[str, np.ndarray], values: Mapping[str, np.ndarray]) -> h5py.Group:
    """A file with one quantity, `energy`, whose dimensions are the axes in their order."""
    with h5py.File(path, "w") as file:
        file.create_group("parameters")
        stated = {"format": FORMAT, "format_version": FORMAT_VERSION, **BUILT}
        file.create_group("provenance").attrs.update(stated)
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
        seal(file)


def seal(file: h5py.File) -> None:
    """Writes the digest of the present values into the file, as a program does."""
    file["provenance"].attrs["results_digest"] = results_digest(file["results"])


MEASURED = {"mean": MEAN, "standard_error": MEAN / 10, "count": np.full((3, 3), 7, dtype="u8")}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    write(tmp_path / "a.h5", {"time": TIME, "cell": CELL}, MEASURED)
    return tmp_path / "a.h5"


def energy(path: Path) -> Quantity:
    return load(path)["energy"]


def test_dimensions_follow_their_scales(path: Path, tmp_path: Path) -> None:
    write(tmp_path / "b.h5", {"cell": CELL, "time": TIME}, MEASURED)
    one, other = (energy(each).to_xarray() for each in (path, tmp_path / "b.h5"))
    assert one["mean"].dims == ("time", "cell")
    assert other["mean"].dims == ("cell", "time")
    assert one["mean"].sel(time=4, cell=0.5) == MEAN[2, 0]
    assert other["mean"].sel(time=4, cell=0.5) == MEAN[0, 2]


def test_xarray_and_frame(path: Path) -> None:
    dataset, frame = energy(path).to_xarray(), energy(path).to_frame()
    units = {"time": "time", "cell": "1", "mean": "energy", "standard_error": "energy", "count": "1"}
    assert [*frame] == [*units]
    for name, array in {**MEASURED, "time": TIME, "cell": CELL}.items():
        np.testing.assert_array_equal(dataset[name], array)
        assert dataset[name].attrs == {"units": units[name], "description": f"what {name} is"}
    row = frame[(frame.time == 4) & (frame.cell == 0.5)]
    assert row[["mean", "standard_error", "count"]].to_numpy().tolist() == [[MEAN[2, 0], MEAN[2, 0] / 10, 7]]
    assert frame.attrs["units"] == units
    assert frame.attrs["description"]["mean"] == "what mean is"


def test_a_computed_number(tmp_path: Path) -> None:
    write(tmp_path / "a.h5", {}, {"mean": np.array(2.0), "discretisation_error": np.array(0.5)})
    assert energy(tmp_path / "a.h5").to_frame().to_dict("records") == [
        {"mean": 2.0, "discretisation_error": 0.5}
    ]
    assert energy(tmp_path / "a.h5").to_xarray()["mean"].dims == ()


@pytest.mark.parametrize(
    "spoil",
    [
        lambda group: group["mean"].dims[1].detach_scale(group["cell"]),
        lambda group: group.__delitem__("cell"),
        lambda group: group.__delitem__("count"),
    ],
)
def test_a_quantity_without_an_axis_or_a_value_is_damaged(
    path: Path, spoil: Callable[[h5py.Group], object]
) -> None:
    with h5py.File(path, "r+") as file:
        spoil(file["results/energy"])
        seal(file)
    with pytest.raises(FormatError, match="is damaged"):
        load(path)


def test_an_unknown_quantity_is_named_with_those_that_there_are(path: Path) -> None:
    """The path of the file is given as text."""
    assert load(str(path)).path == path
    with pytest.raises(FormatError, match=r"a\.h5 has no quantity enrgy; did you mean energy\?$"):
        load(str(path))["enrgy"]


def attribute(name: str, value: object) -> Callable[[Path], object]:
    def change(path: Path) -> None:
        with h5py.File(path, "r+") as file:
            file["provenance"].attrs[name] = value

    return change


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (Path.unlink, " is missing"),
        (lambda path: path.write_bytes(path.read_bytes()[:3000]), " is damaged, or not a result file: "),
        (lambda path: path.write_text("text"), " is damaged, or not a result file: "),
        (lambda path: h5py.File(path, "w").close(), ": not a result of this project"),
        (attribute("format", "another"), ": not a result of this project"),
        (attribute("format_version", 2), ": format version 2, not 3; remake it with make figures"),
    ],
)
def test_what_is_no_result(path: Path, change: Callable[[Path], object], words: str) -> None:
    change(path)
    for read in (load, load_provenance):
        with pytest.raises(FormatError) as error:
            read(path)
        assert str(error.value).startswith(f"{path}{words}")
        assert "\n" not in str(error.value)


def test_unreadable_is_not_damaged(monkeypatch: pytest.MonkeyPatch) -> None:
    """Root can read every file, so h5py is replaced by a function that fails as if permission were denied."""

    def denied(*_: object, **__: object) -> None:
        raise PermissionError(
            errno.EACCES, "Unable to synchronously open file (unable to open file: errno = 13)"
        )

    monkeypatch.setattr(h5py, "File", denied)
    with pytest.raises(PermissionError, match=r"Permission denied: 'a\.h5'"):
        load("a.h5")


def test_the_digest_of_results_by_hand_and_of_any_change(path: Path) -> None:
    parts = sorted({**MEASURED, "cell": CELL, "time": TIME}.items())
    content = b"".join(f"/results/energy/{name}".encode() + values.tobytes() for name, values in parts)
    with h5py.File(path, "r+") as file:
        assert results_digest(file["results"]) == f"{zlib.crc32(content):08x}"
        file["results/energy/mean"][1, 2] += 1e-9
        assert results_digest(file["results"]) != f"{zlib.crc32(content):08x}"
    with pytest.raises(
        FormatError, match="edited or damaged: its values differ from those written; remove it"
    ):
        load(path)


@pytest.mark.parametrize("name", BUILT)
def test_a_name_of_another_result_is_refused(path: Path, name: str) -> None:
    """Detected mistakes: another program, option or source; any name without an identity is accepted."""
    right = path.rename(path.with_name(f"all.{result_identity(*BUILT.values())}.h5"))
    assert load(right).path == right
    attribute(name, "other")(right)
    with pytest.raises(FormatError, match="its content is that of another result"):
        load(right)
    assert load(right.rename(path)).path == path
