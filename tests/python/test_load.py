"""The loader takes the order of the dimensions from the dimension scales, gives the units of all values,
and refuses what is damaged, edited or exchanged."""

from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.python.conftest import Program, seal
from workflow.lib.identity import result_identity
from workflow.lib.load import FORMAT_VERSION, FormatError, Quantity, Result, load, load_provenance

FLUX = (
    "results/flux"  # over 4 bonds and 4 bins of the momentum, so that lengths do not identify the dimensions
)
BUILT = ("program", "option_words", "source_hash")


@pytest.fixture
def path(program: Program, tmp_path: Path) -> Path:
    assert program("momentum_flux", cells=3, momentum_bins=4).returncode == 0
    return tmp_path / "out.h5"


def transpose(dataset: h5py.Dataset) -> None:
    scales = [dimension[0] for dimension in dataset.dims]
    for dimension, former, scale in zip(dataset.dims, scales, scales[::-1], strict=True):
        dimension.detach_scale(former)
        dimension.attach_scale(scale)
    dataset[...] = dataset[()].T


def test_load_takes_the_order_of_dimensions_from_their_scales(path: Path) -> None:
    before = load(path)["flux"]
    assert [*before.axes] == ["bond", "momentum"]
    with h5py.File(path, "r+") as file:
        for name in ("mean", "standard_error", "count"):
            transpose(file[FLUX][name])
    seal(path)
    after = load(path)["flux"]
    assert [*after.axes] == ["momentum", "bond"]
    np.testing.assert_array_equal(after.mean.T, before.mean)


def test_to_frame_has_the_values_and_units_of_the_file(path: Path) -> None:
    frame = load(path)["flux"].to_frame()
    assert [*frame] == ["bond", "momentum", "mean", "standard_error", "count"]
    with h5py.File(path) as file:
        for name in frame:
            assert frame.attrs["units"][name] == file[FLUX][name].attrs["units"].decode()
        bond, momentum = file[FLUX]["bond"][1], file[FLUX]["momentum"][2]
        row = frame[(frame.bond == bond) & (frame.momentum == momentum)]
        for name in ("mean", "standard_error", "count"):
            assert row[name].item() == file[FLUX][name][1, 2]


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
        (attribute("format", "another"), ": not a result of this project"),
        (
            attribute("format_version", 2),
            f": format version 2, not {FORMAT_VERSION}; remake it with make figures",
        ),
    ],
)
def test_load_refuses_what_is_no_result(path: Path, change: Callable[[Path], object], words: str) -> None:
    change(path)
    for read in (load, load_provenance):
        with pytest.raises(FormatError) as error:
            read(path)
        assert str(error.value).startswith(f"{path}{words}")
        assert "\n" not in str(error.value)


def test_a_result_that_is_open_elsewhere_in_the_process(path: Path) -> None:
    with h5py.File(path, locking=True):
        assert load(path)["flux"].mean.shape == (4, 4)


def test_a_file_that_cannot_be_opened_is_not_called_damaged(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="Is a directory"):
        load(tmp_path)


def test_an_edited_value_is_refused(path: Path) -> None:
    """A figure would plot values at parameters that are not theirs. tests/cpp/program/hdf5_file_test.cpp
    changes every byte."""
    with h5py.File(path, "r+") as file:
        file["parameters"].attrs["sigma"] = 0.05
    with pytest.raises(FormatError, match="edited or damaged"):
        load(path)


@pytest.mark.parametrize("name", BUILT)
def test_a_name_of_another_result_is_refused(path: Path, name: str) -> None:
    """Detected mistakes: another program, option or source; any name without an identity is accepted."""
    identity = result_identity(*(load_provenance(path)[key] for key in BUILT))
    right = path.rename(path.with_name(f"all.{identity}.h5"))
    assert load(right).path == right
    attribute(name, "other")(right)
    with pytest.raises(FormatError, match="it contains another result"):
        load(right)


def test_the_replicas_of_a_result_are_those_of_its_most_complete_quantity() -> None:
    """Replicas in which a quantity is not defined do not count for it. A computed value has no error."""
    counts = {"front": [8, 64], "rate": [32, 32]}
    quantities = {
        name: Quantity(np.ones(2), np.ones(2), None, np.array(n), {}, "1", {}, 0)
        for name, n in counts.items()
    }
    assert Result(Path(), {"seed": 1}, {}, quantities).replicas == 64
    with pytest.raises(FormatError, match="computed quantity"):
        _ = Quantity(np.ones(2), None, np.zeros(2), None, {}, "1", {}, 0).error
