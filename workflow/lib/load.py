"""Reads the files that the programs write; the layout is described in docs/format.md."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, SupportsIndex

import h5py
import numpy as np
import pandas as pd

from workflow.lib.places import regular
from workflow.lib.units import parse

if TYPE_CHECKING:
    import xarray

FORMAT = "lorentz-gas"
FORMAT_VERSION = 2
NOT_REACHED = "not reached"
VALUES = ("mean", "standard_error", "discretisation_error", "count")  # of a quantity, besides its axes

Index = SupportsIndex | tuple[SupportsIndex, ...]  # of a value among those of a quantity


class FormatError(ValueError):
    """The file is not a result of this project, or of a version that this loader does not know."""


@dataclass(frozen=True)
class Quantity:
    """mean, the errors and count have one shape; axes maps names to coordinates, in the order of the dimensions. What is
    computed has a discretisation error, what is measured a standard error and a count; the others are None.
    control_variates: whether they were used, None where there are none."""

    mean: np.ndarray
    standard_error: np.ndarray | None
    discretisation_error: np.ndarray | None
    count: np.ndarray | None
    axes: dict[str, np.ndarray]
    units: str
    axis_units: dict[str, str]
    descriptions: dict[str, str]  # of the mean, of the errors and of the axes
    control_variates: bool | None

    @property
    def error(self) -> np.ndarray:
        """The standard error of what is measured. Raises FormatError for what is computed."""
        return _measured(self.standard_error)

    @property
    def replicas(self) -> np.ndarray:
        """The count of what is measured. Raises FormatError for what is computed."""
        return _measured(self.count)

    def to_xarray(self) -> "xarray.Dataset":
        """mean, errors and count over the axes; units and description are attributes of each."""
        import xarray  # noqa: PLC0415  # half a second, which no figure needs

        attributes = self._attributes()
        values = {name: (tuple(self.axes), array, attributes[name]) for name, array in self._values().items()}
        axes = {name: (name, array, attributes[name]) for name, array in self.axes.items()}
        return xarray.Dataset(values, axes)

    def to_frame(self) -> pd.DataFrame:
        """One row per value; attrs["units"] and attrs["description"] hold those of the columns."""
        grids = np.meshgrid(*self.axes.values(), indexing="ij")
        axes = {name: grid.ravel() for name, grid in zip(self.axes, grids, strict=True)}
        frame = pd.DataFrame(axes | {name: array.ravel() for name, array in self._values().items()})
        attributes = self._attributes()
        for kind in ("units", "description"):
            frame.attrs[kind] = {name: attributes[name][kind] for name in frame}
        return frame

    def _values(self) -> dict[str, np.ndarray]:
        values = {name: getattr(self, name) for name in VALUES}
        return {name: np.asarray(array) for name, array in values.items() if array is not None}

    def _attributes(self) -> dict[str, dict[str, str]]:
        units = dict.fromkeys(VALUES, self.units) | {"count": "1"} | self.axis_units
        return {name: {"units": units[name], "description": text} for name, text in self.descriptions.items()}


def _measured(array: np.ndarray | None) -> np.ndarray:
    if array is None:
        raise FormatError("the quantity is computed: it has no standard error and no count")
    return array


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
        return str(self.provenance["converged"])

    @property
    def sound(self) -> bool:
        """Whether the target error was not missed and the chain was stationary. Raises KeyError where that is not tested."""
        return bool(self.converged != NOT_REACHED and self["stationary"].mean == 1)


def load(path: Path) -> Result:
    """One result file. Raises FormatError if it is not one."""
    with _opened(path) as (file, provenance):
        quantities = {name: _quantity(group) for name, group in file["results"].items()}
        return Result(path, _attributes(file["parameters"]), provenance, quantities)


def load_parameters(path: Path) -> dict[str, Any]:
    """Of one result file, without its results. Raises FormatError."""
    with _opened(path) as (file, _):
        return _attributes(file["parameters"])


def load_provenance(path: Path) -> dict[str, Any]:
    """Of one result file, without its results. Raises FormatError."""
    with _opened(path) as (_, provenance):
        return provenance


@contextmanager
def _opened(path: Path) -> Iterator[tuple[h5py.File, dict[str, Any]]]:
    """The file and its provenance. Raises FormatError for all that goes wrong while it is open."""
    try:
        with h5py.File(regular(path)) as file:
            if led := file.id.links.visit(_leads_elsewhere, info=True):  # h5py's own visit opens every link
                raise FormatError(f"{led} is a link, which could lead anywhere")
            provenance = _attributes(file["provenance"])
            if (provenance["format"], provenance["format_version"]) != (FORMAT, FORMAT_VERSION):
                raise FormatError(
                    f"the format is {provenance['format']} {provenance['format_version']}, "
                    f"not {FORMAT} {FORMAT_VERSION}; make the file again"
                )
            yield file, provenance
    except FormatError as error:
        raise FormatError(f"{path}: {error}") from error
    except (
        OSError,
        AttributeError,
        KeyError,
        TypeError,
        ValueError,
        RuntimeError,
        MemoryError,
        SystemError,
    ) as error:
        # The last is h5py's for a name that is no text.
        raise FormatError(f"{path} is not a result file: {error}") from error


def _leads_elsewhere(name: bytes, link: h5py.h5l.LinkInfo) -> str | None:
    return None if link.type == h5py.h5l.TYPE_HARD else name.decode(errors="replace")


def _attributes(group: h5py.Group) -> dict[str, Any]:
    return {name: _text(value) for name, value in group.attrs.items()}


def _text(value: Any) -> Any:
    return value.decode() if isinstance(value, bytes) else value


def _quantity(group: h5py.Group) -> Quantity:
    mean = group["mean"]
    names = ("discretisation_error",) if "discretisation_error" in group else ("standard_error", "count")
    axes = axes_of(mean)
    if unknown := group.keys() - {"mean", *names, *axes}:
        raise FormatError(f"{group.name}: {', '.join(sorted(unknown))} belong to no dimension of mean")
    stored = {"mean": mean, **{name: group[name] for name in (*names, *axes)}}
    units, descriptions = (
        {name: _text(dataset.attrs[attribute]) for name, dataset in stored.items()}
        for attribute in ("units", "description")
    )
    for text in units.values():
        parse(text)
    used = mean.attrs.get("control_variates")
    return Quantity(
        mean[()],
        **{name: stored[name][()] if name in names else None for name in VALUES[1:]},
        axes={name: stored[name][()] for name in axes},
        units=units["mean"],
        axis_units={name: units[name] for name in axes},
        descriptions=descriptions,
        control_variates=None if used is None else bool(used),
    )


def axes_of(dataset: h5py.Dataset) -> list[str]:
    """Names of the dimensions, by the HDF5 dimension scale that is attached to each. Raises FormatError."""
    attached = [[str(scale.name) for scale in dimension.values()] for dimension in dataset.dims]
    for names in attached:
        if len(names) != 1 or Path(names[0]).parent != Path(dataset.parent.name):
            raise FormatError(
                f"{dataset.name}: each dimension needs one dimension scale of {dataset.parent.name}, not {attached}; "
                "make the file again"
            )
    return [Path(name).name for (name,) in attached]
