"""Check of result files against docs/format.md: valid files pass, and every kind of defect is found."""

from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.python.conftest import Program
from tests.python.layout import OF_SCALES, faults

Break = Callable[[h5py.File], None]


@pytest.fixture
def result(program: Program, tmp_path: Path) -> Path:
    """A result with a scalar quantity and one with an axis."""
    done = program("waiting_time", target_error=100)
    assert done.returncode == 0, done.stderr
    return tmp_path / "out.h5"


def replace(file: h5py.File, path: str, values: object) -> None:
    """Other values, with the same attributes and dimension scales."""
    group, name = file[path].parent, Path(path).name
    attributes = {key: value for key, value in file[path].attrs.items() if key not in OF_SCALES}
    users = {
        (user, i)
        for user, dataset in group.items()
        for i, dimension in enumerate(dataset.dims)
        for scale in dimension.values()
        if name in (user, Path(scale.name).name)
    }
    scales = {user_and_i: axis_of(group, *user_and_i) for user_and_i in users}
    for (user, i), axis in scales.items():
        group[user].dims[i].detach_scale(group[axis])
    del file[path]
    file[path] = values
    file[path].attrs.update(attributes)
    if name in scales.values():
        file[path].make_scale(name)
    for (user, i), axis in scales.items():
        group[user].dims[i].attach_scale(group[axis])


def axis_of(group: h5py.Group, dataset: str, i: int) -> str:
    return Path(group[dataset].dims[i][0].name).name


def detached(path: str) -> Break:
    def spoil(file: h5py.File) -> None:
        dataset = file[path]
        dataset.dims[0].detach_scale(dataset.dims[0][0])

    return spoil


def attribute(path: str, name: str, value: object) -> Break:
    return lambda file: file[path].attrs.__setitem__(name, value)


def without(path: str) -> Break:
    return lambda file: file.__delitem__(path)


def without_attribute(path: str, name: str) -> Break:
    return lambda file: file[path].attrs.__delitem__(name)


def shortened(path: str) -> Break:
    return lambda file: replace(file, path, file[path][:-1])


def retyped(path: str, dtype: str) -> Break:
    return lambda file: replace(file, path, file[path][()].astype(dtype))


def in_units(place: str, units: str) -> Break:
    def spoil(file: h5py.File) -> None:
        for name in ("mean", "standard_error"):
            file[place][name].attrs["units"] = units

    return spoil


def renamed_axis(file: h5py.File, place: str, old: str, new: str) -> None:
    """The dimension scale, a reference to the dataset itself, follows the name."""
    file.move(f"{place}/{old}", f"{place}/{new}")


def test_measured_and_computed_files_have_no_fault(result: Path, program: Program, tmp_path: Path) -> None:
    assert faults(result) == []
    none = dict.fromkeys(("cells", "particles_per_cell", "relaxation_time", "observation_time", "replicas"))
    done = program("boltzmann", output="computed.h5", **none, target_error=1e-2)
    assert done.returncode == 0, done.stderr
    assert faults(tmp_path / "computed.h5") == []


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (without("results"), ["/: 'results' is a required property"]),
        (without("provenance"), ["'provenance' is a required property"]),
        (lambda file: file.create_group("extra"), ["'extra' was unexpected"]),
        (without("results/exponent/mean"), ["/results/exponent: 'mean' is a required property"]),
        (without("results/exponent/count"), ["/results/exponent", "either standard_error and count"]),
        (
            lambda file: file.copy("results/exponent/mean", "results/exponent/discretisation_error"),
            ["/results/exponent", "or discretisation_error"],
        ),
        (without("results/density/tau"), ["/results/density", "its axes are []"]),
        (
            detached("results/density/mean"),
            [
                "/results/density: the dimension scales of mean are [[]], its axes are ['/results/density/tau']"
            ],
        ),
        (
            detached("results/density/count"),
            [
                "/results/density: the dimension scales of count are [[]], those of mean [['/results/density/tau']]"
            ],
        ),
        (
            lambda file: (
                file["results/density/mean"].dims[0].attach_scale(file["results/exponent_by_cut/cut"])
            ),
            ["/results/density: the dimension scales of mean", "/results/exponent_by_cut/cut"],
        ),
        (shortened("results/density/tau"), ["/results/density", "tau': [119]"]),
        (shortened("results/density/standard_error"), ["/results/density: standard_error has the shape"]),
        (shortened("results/density/count"), ["/results/density: count has the shape"]),
        (retyped("results/density/mean", "f4"), ["/results/density/mean/dtype: 'float64' was expected"]),
        (retyped("results/density/count", "i4"), ["/results/density/count/dtype: 'uint64' was expected"]),
        (
            without_attribute("results/density/tau", "units"),
            ["/results/density/tau/attributes: 'units' is a required property"],
        ),
        (
            attribute("results/density/mean", "units", "length"),
            ["/results/density: standard_error is in", "mean is in length"],
        ),
        (
            attribute("results/density/tau", "units", "furlong"),
            [
                "/results/density/tau/attributes/units/value: 'furlong' in 'furlong' is not a unit; use powers of 1, length"
            ],
        ),
        (
            without_attribute("results/density/mean", "description"),
            ["/results/density/mean/attributes: 'description' is a required property"],
        ),
        (
            lambda file: file.copy("results/exponent", "results/other"),
            ["/quantities", "'other' was unexpected"],
        ),
        (without("results/exponent_spread"), ["/quantities", "'exponent_spread' is a required property"]),
        (in_units("results/exponent", "length"), ["/quantities/exponent: '1' was expected"]),
        (
            lambda file: renamed_axis(file, "results/density", "tau", "time"),
            ["/quantities/density: '1/time [tau in time]' was expected"],
        ),
        (
            attribute("provenance", "build_id", "0" * 63),
            ["/provenance/attributes/build_id", "does not match"],
        ),
        (attribute("provenance", "source_hash", "G" * 64), ["/provenance/attributes/source_hash"]),
        (attribute("provenance", "format_version", np.int64(1)), ["format_version", "3 was expected"]),
        (attribute("provenance", "seed", 1.0), ["/provenance/attributes/seed/dtype"]),
        (attribute("provenance", "host", "here"), ["/provenance/attributes", "'host' was unexpected"]),
        (without_attribute("provenance", "streams"), ["'streams' is a required property"]),
        (attribute("provenance", "target_error", 0.0), ["/provenance: reached, though achieved_error"]),
        (attribute("provenance", "achieved_error", np.nan), ["/provenance: reached, though achieved_error"]),
        (attribute("provenance", "converged", "no target"), ["/provenance: no target, though target_error"]),
        (attribute("provenance", "converged", "True"), ["/provenance/attributes/converged", "not one of"]),
        (
            lambda file: file["results/exponent/mean"].write_direct(np.array(np.nan)),
            ["/provenance: reached, though exponent is nan"],
        ),
        (attribute("parameters", "sigma", [0.5, 0.5]), ["/parameters/attributes/sigma/dtype", "array"]),
    ],
)
def test_each_fault_is_found_where_it_is(result: Path, spoil: Break, words: list[str]) -> None:
    with h5py.File(result, "r+") as file:
        spoil(file)
    found = faults(result)
    assert len(found) == 1
    for word in [str(result), *words]:
        assert word in found[0]


def test_half_a_file_is_not_a_result(result: Path) -> None:
    result.write_bytes(result.read_bytes()[:2000])
    assert "not a whole HDF5 file" in faults(result)[0]
