"""Whether a result file follows docs/format.md.

The file's structure is described as JSON and held against docs/format.schema.json; what a schema cannot say, how
shapes, axes and numbers fit together, is checked here.
"""

import json
import math
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from jsonschema import Draft202012Validator, FormatChecker

from workflow.provenance.repository import ROOT
from workflow.scripts.load import NOT_REACHED
from workflow.scripts.units import UnitsError, parse

FORMATS = FormatChecker(formats=())
SCHEMA = ROOT / "docs/format.schema.json"
MEASURED = {"standard_error", "count"}
COMPUTED = {"discretisation_error"}
NOT_AXES = {"mean"} | MEASURED | COMPUTED


@FORMATS.checks("units", raises=UnitsError)
def _are_units(text: object) -> bool:
    return not isinstance(text, str) or parse(text) is not None


def faults(path: Path) -> list[str]:
    """What is wrong with a result file, each with its place in the file; empty if nothing is."""
    try:
        with h5py.File(path) as file:
            described = describe(file)
    except (OSError, RuntimeError, KeyError, UnicodeDecodeError) as error:
        return [f"{path}: it is not a whole HDF5 file: {error}"]
    found = _against_schema(described) or _inconsistencies(described)
    return [f"{path}: {fault}" for fault in found]


def describe(node: h5py.Group | h5py.Dataset) -> dict:
    """The structure below a node as JSON: attributes; members of a group; dtype and shape of a dataset, of a 0-d
    one also the value."""
    described: dict = {"attributes": {name: _scalar(value) for name, value in node.attrs.items()}}
    if isinstance(node, h5py.Group):
        return described | {"members": {name: describe(member) for name, member in node.items()}}
    described |= {"dtype": _type_name(node.dtype), "shape": list(node.shape or ())}
    return described | ({"value": _plain(node[()])} if node.shape == () else {})


def _scalar(value: Any) -> dict:
    array = np.asarray(value)
    if array.shape:
        return {"dtype": f"array of {_type_name(array.dtype)}"}
    return {"dtype": _type_name(array.dtype), "value": _plain(array[()])}


def _type_name(dtype: np.dtype) -> str:
    return "text" if dtype.kind in "SU" else dtype.name


def _plain(value: Any) -> Any:
    """JSON knows no nan and no inf; they become text, which float() reads."""
    plain = value.decode() if isinstance(value, bytes) else value.item()
    return str(plain) if isinstance(plain, float) and not math.isfinite(plain) else plain


def _against_schema(described: dict) -> list[str]:
    validator = Draft202012Validator(json.loads(SCHEMA.read_text()), format_checker=FORMATS)
    errors = sorted(validator.iter_errors(described), key=lambda error: [str(part) for part in error.path])
    return [
        f"{'/'.join(['', *(str(part) for part in error.path if part != 'members')]) or '/'}: {error.cause or error.message}"
        for error in errors
    ]


def _inconsistencies(described: dict) -> list[str]:
    quantities = {
        name: group["members"] for name, group in described["members"]["results"]["members"].items()
    }
    found = [
        f"/results/{name}: {fault}" for name, parts in quantities.items() for fault in _of_quantity(parts)
    ]
    provenance = {
        name: attribute["value"]
        for name, attribute in described["members"]["provenance"]["attributes"].items()
    }
    return found + [f"/provenance: {fault}" for fault in _of_convergence(provenance, quantities)]


def _of_quantity(parts: dict[str, dict]) -> list[str]:
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
    # The members of a group have no order, so lengths are all that ties axes to dimensions.
    axes = {name: part["shape"][0] for name, part in parts.items() if name not in NOT_AXES}
    if sorted(axes.values()) != sorted(shape):
        found.append(f"mean has the shape {shape}, its axes have the lengths {axes}")
    return found


def _of_convergence(provenance: dict[str, Any], quantities: dict[str, dict]) -> list[str]:
    """A run may have stopped for want of time with its target within reach: then `converged` promises nothing."""
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
