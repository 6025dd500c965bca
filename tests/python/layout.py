"""Validator of result files against docs/format.md.

The structure of a file, as JSON, has to satisfy docs/format.schema.json. The consistency of shapes, axes and numbers, which a schema
cannot express, is checked here.
"""

import json
import math
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from jsonschema import Draft202012Validator, FormatChecker

from workflow.config.describe import signature
from workflow.lib.load import NOT_REACHED
from workflow.lib.units import UnitsError, parse

FORMATS = FormatChecker(formats=())
SCHEMA = Path(__file__).parents[2] / "docs/format.schema.json"
MEASURED = {"standard_error", "count"}
COMPUTED = {"discretisation_error"}
NOT_AXES = {"mean"} | MEASURED | COMPUTED
# Attributes in which HDF5 stores dimension scales.
OF_SCALES = {"CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST", "DIMENSION_LABELS"}


@FORMATS.checks("units", raises=UnitsError)
def _are_units(text: object) -> bool:
    return not isinstance(text, str) or parse(text) is not None


def faults(path: Path) -> list[str]:
    """Faults of a result file, each with its path in the file."""
    try:
        with h5py.File(path) as file:
            described = describe(file) | _summary(file)
    except (OSError, RuntimeError, KeyError, UnicodeDecodeError) as error:
        return [f"{path}: it is not a whole HDF5 file: {error}"]
    found = _against_schema(described)
    of_program = [fault for fault in found if fault.startswith("/quantities")]
    found = [fault for fault in found if fault not in of_program] or _inconsistencies(described) or of_program
    return [f"{path}: {fault}" for fault in found]


def describe(node: h5py.Group | h5py.Dataset) -> dict[str, Any]:
    """The structure below a node as JSON: attributes; members of a group; dtype, shape and dimension scales of a
    dataset, of a 0-d one also the value."""
    own = [name for name in node.attrs if isinstance(node, h5py.Group) or name not in OF_SCALES]
    described: dict[str, Any] = {"attributes": {name: _scalar(node.attrs[name]) for name in own}}
    if isinstance(node, h5py.Group):
        return described | {"members": {name: describe(member) for name, member in node.items()}}
    described |= {"dtype": _type_name(node.dtype), "shape": list(node.shape or ()), "is_scale": node.is_scale}
    described["scales"] = [[str(scale.name) for scale in dimension.values()] for dimension in node.dims]
    return described | ({"value": _plain(node[()])} if node.shape == () else {})


def _summary(file: h5py.File) -> dict[str, Any]:
    """Program and signatures of the complete quantities, to which the schema of the program refers."""
    program = _text(file.get("provenance", file), "program")
    means = {name: group["mean"] for name, group in file.get("results", {}).items() if "mean" in group}
    return {"program": program, "quantities": {name: _signature_of(mean) for name, mean in means.items()}}


def _signature_of(mean: h5py.Dataset) -> str:
    scales = [scale for dimension in mean.dims for scale in dimension.values()]
    axes = {Path(scale.name or "").name: _text(scale, "units") for scale in scales}
    return signature(_text(mean, "units"), axes)


def _text(node: h5py.Group | h5py.Dataset, attribute: str) -> str:
    return str(_scalar(node.attrs[attribute]).get("value")) if attribute in node.attrs else ""


def _scalar(value: Any) -> dict[str, Any]:
    array = np.asarray(value)
    if array.shape:
        return {"dtype": f"array of {_type_name(array.dtype)}"}
    return {"dtype": _type_name(array.dtype), "value": _plain(array[()])}


def _type_name(dtype: np.dtype) -> str:
    return "text" if dtype.kind in "SU" else dtype.name


def _plain(value: Any) -> Any:
    """JSON has no nan and no inf; they become text that float() reads."""
    plain = value.decode() if isinstance(value, bytes) else value.item()
    return str(plain) if isinstance(plain, float) and not math.isfinite(plain) else plain


def _against_schema(described: dict[str, Any]) -> list[str]:
    validator = Draft202012Validator(json.loads(SCHEMA.read_text()), format_checker=FORMATS)
    errors = sorted(validator.iter_errors(described), key=lambda error: [str(part) for part in error.path])
    return [
        f"{'/'.join(['', *(str(part) for part in error.path if part != 'members')]) or '/'}: {error.cause or error.message}"
        for error in errors
    ]


def _inconsistencies(described: dict[str, Any]) -> list[str]:
    quantities = {
        name: group["members"] for name, group in described["members"]["results"]["members"].items()
    }
    found = [
        f"/results/{name}: {fault}"
        for name, parts in quantities.items()
        for fault in _of_quantity(parts, f"/results/{name}")
    ]
    provenance = {
        name: attribute["value"]
        for name, attribute in described["members"]["provenance"]["attributes"].items()
    }
    return found + [f"/provenance: {fault}" for fault in _of_convergence(provenance, quantities)]


def _of_quantity(parts: dict[str, dict[str, Any]], path: str) -> list[str]:
    found = []
    if parts.keys() & (MEASURED | COMPUTED) not in (MEASURED, COMPUTED):
        found.append("it needs either standard_error and count, or discretisation_error")
    shape = parts["mean"]["shape"]
    for name in sorted(parts.keys() & (MEASURED | COMPUTED)):
        if parts[name]["shape"] != shape:
            found.append(f"{name} has the shape {parts[name]['shape']}, mean has {shape}")
        units = [parts[one]["attributes"]["units"]["value"] for one in (name, "mean")]
        if name != "count" and units[0] != units[1]:
            found.append(f"{name} is in {units[0]}, mean is in {units[1]}")
    axes = {f"{path}/{name}": part["shape"] for name, part in parts.items() if name not in NOT_AXES}
    scales = parts["mean"]["scales"]
    if sorted(scales) != sorted([axis] for axis in axes):
        return [*found, f"the dimension scales of mean are {scales}, its axes are {[*axes]}"]
    if [axes[axis] for (axis,) in scales] != [[length] for length in shape]:
        found.append(f"mean has the shape {shape}, its axes have the lengths {axes}")
    for name in sorted(parts.keys() & (MEASURED | COMPUTED)):
        if parts[name]["scales"] != scales:
            found.append(
                f"the dimension scales of {name} are {parts[name]['scales']}, those of mean {scales}"
            )
    return found


def _of_convergence(provenance: dict[str, Any], quantities: dict[str, dict[str, Any]]) -> list[str]:
    """Consistency of `converged` with target and error; nothing is required of a run that stopped early."""
    state = provenance["converged"]
    if state == NOT_REACHED:
        return []
    found = []
    target, achieved = float(provenance["target_error"]), float(provenance["achieved_error"])
    if state == "reached" and not achieved <= target:
        found.append(f"{state}, though achieved_error = {achieved} is not within target_error = {target}")
    if state == "no target" and not math.isnan(target):
        found.append(f"{state}, though target_error = {target}")
    name = provenance["target_quantity"]
    mean = quantities.get(name, {}).get("mean", {}).get("value", 0.0)  # the target may be several quantities
    if not math.isfinite(float(mean)):
        found.append(f"{state}, though {name} is {mean}")
    return found
