"""Result files of every program against docs/format.md: the same bytes for any number of threads, the JSON Schema
docs/format.schema.json for the structure, and what a schema cannot express: shapes, axes and convergence."""

import json
import math
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from jsonschema import Draft202012Validator, FormatChecker

from tests.python.conftest import ROOT, Program, command_line
from workflow.lib.described import built, signature
from workflow.lib.load import NOT_REACHED
from workflow.lib.units import UnitsError, parse

FORMATS = FormatChecker(formats=())
FORMATS.checks("units", raises=UnitsError)(lambda text: not isinstance(text, str) or bool(parse(text)))
SCHEMA = json.loads((ROOT / "docs/format.schema.json").read_text())
MEASURED, COMPUTED = {"mean", "standard_error", "count"}, {"mean", "discretisation_error"}
# Attributes in which HDF5 stores dimension scales.
OF_SCALES = {"CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST", "DIMENSION_LABELS"}


def structure(node: h5py.Group | h5py.Dataset) -> dict[str, Any]:
    """A node as JSON: attributes; members of a group; dtype, shape and dimension scales of a dataset."""
    described: dict[str, Any] = {
        "attributes": {name: scalar(value) for name, value in node.attrs.items() if name not in OF_SCALES}
    }
    if isinstance(node, h5py.Group):
        return described | {"members": {name: structure(member) for name, member in node.items()}}
    described |= {"dtype": type_name(node.dtype), "shape": list(node.shape), "is_scale": node.is_scale}
    return described | {"scales": scales(node)}


def scales(dataset: h5py.Dataset) -> list[list[str]]:
    return [[str(scale.name) for scale in dimension.values()] for dimension in dataset.dims]


def scalar(value: Any) -> dict[str, Any]:
    array = np.asarray(value)
    if array.shape:
        return {"dtype": f"array of {type_name(array.dtype)}"}
    plain = array[()].decode() if array.dtype.kind == "S" else array.item()
    is_text = isinstance(plain, float) and not math.isfinite(plain)  # JSON has neither nan nor inf
    return {"dtype": type_name(array.dtype), "value": str(plain) if is_text else plain}


def type_name(dtype: np.dtype) -> str:
    return "text" if dtype.kind in "SU" else dtype.name


def faults(path: Path) -> list[str]:
    """Faults of a result file, each with its path in the file."""
    with h5py.File(path) as file:
        described = structure(file) | of_program(file)
        errors = Draft202012Validator(SCHEMA, format_checker=FORMATS).iter_errors(described)
        found = [f"{'/'.join(map(str, error.path))}: {error.cause or error.message}" for error in errors]
        structural = [fault for fault in found if not fault.startswith("quantities")]
        return structural or [*inconsistencies(file), *found]


def of_program(file: h5py.File) -> dict[str, Any]:
    """Program and signatures of the quantities, to which the schema of the program refers."""
    signatures = {}
    for name, group in file.get("results", {}).items():
        mean = group.get("mean", group)
        axes = [scale for dimension in getattr(mean, "dims", ()) for scale in dimension.values()]
        units = {Path(axis.name or "").name: units_of(axis) for axis in axes}
        signatures[name] = signature(units_of(mean), units)
    program = scalar(file["provenance"].attrs["program"])["value"] if "provenance" in file else ""
    return {"program": program, "quantities": signatures}


def units_of(node: h5py.Group | h5py.Dataset) -> str:
    return str(scalar(node.attrs.get("units", ""))["value"])


def inconsistencies(file: h5py.File) -> Iterator[str]:
    for name, group in file["results"].items():
        values = group.keys() & (MEASURED | COMPUTED)
        if values not in (MEASURED, COMPUTED):
            yield f"{name}: it needs either standard_error and count, or discretisation_error"
        mean, axes = group["mean"], group.keys() - values
        if sorted(scales(mean)) != sorted([f"/results/{name}/{axis}"] for axis in axes):
            yield f"{name}: the dimension scales of mean are {scales(mean)}, its axes are {axes}"
        elif mean.shape != tuple(len(file[axis]) for (axis,) in scales(mean)):
            yield f"{name}: mean has the shape {mean.shape}, which is not that of its axes"
        for kind in values - {"mean"}:
            if group[kind].shape != mean.shape or scales(group[kind]) != scales(mean):
                yield f"{name}: shape or dimension scales of {kind} are not those of mean"
            if kind != "count" and group[kind].attrs["units"] != mean.attrs["units"]:
                yield f"{name}: {kind} is not in the units of mean"
    stated = {name: scalar(value)["value"] for name, value in file["provenance"].attrs.items()}
    state, target, achieved = (
        stated["converged"],
        float(stated["target_error"]),
        float(stated["achieved_error"]),
    )
    if state == "reached" and not achieved <= target:
        yield f"reached, though achieved_error = {achieved} is not within target_error = {target}"
    if state == "no target" and not math.isnan(target):
        yield f"no target, though target_error = {target}"
    name = stated["target_quantity"]  # the target may be several quantities
    if state != NOT_REACHED and name in file["results"] and np.isnan(file[f"results/{name}/mean"][()]):
        yield f"{state}, though {name} is nan"


@pytest.mark.parametrize("name", built())
def test_files_have_the_format_and_the_same_bytes_for_any_threads(
    program: Program, tmp_path: Path, name: str
) -> None:
    def content(threads: int) -> bytes:
        of_replicas = {} if name in ("boltzmann", "trajectories") else {"threads": threads}
        done = program(name, **of_replicas)
        assert done.returncode == 0, done.stderr
        return (tmp_path / "out.h5").read_bytes()

    assert content(1) == content(3)
    assert faults(tmp_path / "out.h5") == []


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Content of a result file with a scalar quantity and one with an axis."""
    path = tmp_path_factory.mktemp("result") / "out.h5"
    subprocess.run(command_line("waiting_time", {"output": path, "target-error": 100}), check=True)
    return path.read_bytes()


Break = Callable[[h5py.File], object]


def without(path: str) -> Break:
    return lambda file: file.__delitem__(path)


def attribute(path: str, name: str, value: object) -> Break:
    return lambda file: file[path].attrs.__setitem__(name, value)


def replaced(path: str, change: Callable[[np.ndarray], np.ndarray]) -> Break:
    """Other values with the same attributes, without dimension scales."""

    def spoil(file: h5py.File) -> None:
        values, kept = file[path][()], {k: v for k, v in file[path].attrs.items() if k not in OF_SCALES}
        del file[path]
        file[path] = change(values)
        file[path].attrs.update(kept)

    return spoil


def detached(path: str) -> Break:
    return lambda file: file[path].dims[0].detach_scale(file[path].dims[0][0])


def in_length(file: h5py.File) -> None:
    for kind in ("mean", "standard_error"):
        file["results/exponent"][kind].attrs["units"] = "length"


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (without("results"), "'results' is a required property"),
        (without("provenance"), "'provenance' is a required property"),
        (lambda file: file.create_group("extra"), "'extra' was unexpected"),
        (without("results/exponent/mean"), "results/members/exponent/members: 'mean' is a required property"),
        (without("results/exponent/count"), "exponent: it needs either standard_error and count"),
        (without("results/density/tau"), "density: the dimension scales of mean are"),
        (detached("results/density/mean"), "density: the dimension scales of mean are [[]]"),
        (detached("results/density/count"), "density: shape or dimension scales of count"),
        (replaced("results/density/standard_error", lambda x: x[:-1]), "scales of standard_error"),
        (replaced("results/density/count", lambda x: x.astype("i4")), "count/dtype: 'uint64' was expected"),
        (attribute("results/density/mean", "units", "length"), "standard_error is not in the units of mean"),
        (attribute("results/density/tau", "units", "furlong"), "'furlong' in 'furlong' is not a unit"),
        (lambda file: file["results/density/mean"].attrs.clear(), "'description' is a required property"),
        (lambda file: file.copy("results/exponent", "results/other"), "'other' was unexpected"),
        (without("results/exponent_spread"), "quantities: 'exponent_spread' is a required property"),
        (in_length, "quantities/exponent: '1' was expected"),
        (lambda file: file.move("results/density/tau", "results/density/t"), "'1/time [tau in time]' was"),
        (attribute("provenance", "build_id", "0" * 63), "build_id/value: '"),
        (attribute("provenance", "host", "here"), "'host' was unexpected"),
        (lambda file: file["provenance"].attrs.__delitem__("streams"), "'streams' is a required property"),
        (attribute("provenance", "target_error", 0.0), "reached, though achieved_error"),
        (attribute("provenance", "achieved_error", np.nan), "reached, though achieved_error"),
        (attribute("provenance", "converged", "no target"), "no target, though target_error"),
        (replaced("results/exponent/mean", lambda x: np.nan * x), "reached, though exponent is nan"),
        (attribute("parameters", "sigma", [0.5, 0.5]), "sigma/dtype: 'array of float64' is not one of"),
    ],
)
def test_each_fault_is_found(result: bytes, tmp_path: Path, spoil: Break, words: str) -> None:
    (tmp_path / "out.h5").write_bytes(result)
    with h5py.File(tmp_path / "out.h5", "r+") as file:
        spoil(file)
    assert any(words in fault for fault in faults(tmp_path / "out.h5"))
