"""A result file is held against docs/format.md: whole files pass, and every way to break one is found."""

from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.python.conftest import Program
from workflow.provenance.layout import faults

Break = Callable[[h5py.File], None]


@pytest.fixture
def result(program: Program, tmp_path: Path) -> Path:
    """One quantity of numbers, one with an axis."""
    done = program("waiting_time", target_error=100)
    assert done.returncode == 0, done.stderr
    return tmp_path / "out.h5"


def replace(file: h5py.File, path: str, values: object) -> None:
    attributes = dict(file[path].attrs)
    del file[path]
    file[path] = values
    file[path].attrs.update(attributes)


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
        (without("results/density/tau"), ["/results/density", "axes have the lengths {}"]),
        (shortened("results/density/tau"), ["/results/density", "'tau'"]),
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
                "/results/density/tau/attributes/units/value: 'furlong' in 'furlong' is not a power of 1, length"
            ],
        ),
        (
            without_attribute("results/density/mean", "description"),
            ["/results/density/mean/attributes: 'description' is a required property"],
        ),
        (
            attribute("provenance", "build_id", "0" * 63),
            ["/provenance/attributes/build_id", "does not match"],
        ),
        (attribute("provenance", "source_hash", "G" * 64), ["/provenance/attributes/source_hash"]),
        (attribute("provenance", "format_version", np.int64(1)), ["format_version", "2 was expected"]),
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
