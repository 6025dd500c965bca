"""Reads the files that the programs write; the layout is described in docs/format.md."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from workflow.scripts.units import parse

FORMAT = "lorentz-gas"
FORMAT_VERSION = 2
NOT_REACHED = "not reached"


class FormatError(ValueError):
    """The file is not a result of this project, or of a version that this loader does not know."""


@dataclass(frozen=True)
class Quantity:
    """mean, the errors and count have one shape; axes maps names to one-dimensional arrays. What is computed
    has a discretisation error, what is measured a standard error and a count; the others are None.
    control_variates: whether they were used, None where there are none."""

    mean: np.ndarray
    standard_error: np.ndarray | None
    discretisation_error: np.ndarray | None
    count: np.ndarray | None
    axes: dict[str, np.ndarray]
    units: str
    axis_units: dict[str, str]
    control_variates: bool | None


@dataclass(frozen=True)
class Result:
    path: Path
    parameters: dict[str, Any]
    provenance: dict[str, Any]
    quantities: dict[str, Quantity]

    def __getitem__(self, name: str) -> Quantity:
        return self.quantities[name]

    @property
    def converged(self) -> str:
        """Of the target error: reached, not reached, or no target."""
        return self.provenance["converged"]


def load(path: Path) -> Result:
    """One result file. Raises FormatError if it is not one."""
    try:
        with h5py.File(path) as file:
            provenance = _attributes(file["provenance"])
            if (provenance["format"], provenance["format_version"]) != (FORMAT, FORMAT_VERSION):
                raise FormatError(
                    f"{path}: the format is {provenance['format']} {provenance['format_version']}, "
                    f"not {FORMAT} {FORMAT_VERSION}; make the file again"
                )
            quantities = {name: _quantity(group) for name, group in file["results"].items()}
            return Result(path, _attributes(file["parameters"]), provenance, quantities)
    except FormatError:
        raise
    except (OSError, KeyError, TypeError, ValueError, RuntimeError) as error:
        raise FormatError(f"{path} is not a result file: {error}") from error


def _attributes(group: h5py.Group | h5py.Dataset) -> dict[str, Any]:
    return {
        name: value.decode() if isinstance(value, bytes) else value for name, value in group.attrs.items()
    }


def _quantity(group: h5py.Group) -> Quantity:
    values = {name: dataset[()] for name, dataset in group.items()}
    units = {name: _attributes(dataset)["units"] for name, dataset in group.items()}
    for text in units.values():
        parse(text)
    mean = values.pop("mean")
    computed = "discretisation_error" in values
    names = {"discretisation_error"} if computed else {"standard_error", "count"}
    rest = {
        name: values.pop(name) if name in names else None
        for name in ("standard_error", "discretisation_error", "count")
    }
    used = _attributes(group["mean"]).get("control_variates")
    return Quantity(
        mean,
        **rest,
        axes=values,
        units=units["mean"],
        axis_units={name: units[name] for name in values},
        control_variates=None if used is None else bool(used),
    )
