"""Reads result files (docs/format.md)."""

import io
import json
import re
import zlib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, SupportsIndex

import h5py
import numpy as np

if TYPE_CHECKING:
    import pandas as pd

from workflow.lib.identity import IDENTITY, named_identity, result_identity, run_of, series_of
from workflow.lib.suggestion import suggestion
from workflow.lib.units import parse

FORMAT = "lorentz-gas"
FORMAT_VERSION = 7
DIGITS = 8  # of the CRC-32 at the end of a file
REMEDY = "; remove it and make it again"
NOT_REACHED = "not reached"
UNDEFINED = "target quantity not defined"
NOT_TESTED = "stationarity not tested"
NOT_STATIONARY = "not stationary"
ALL_AGREE = "all replicas agree, so that no error is known"
VALUES = (
    "mean",
    "standard_error",
    "discretisation_error",
    "count",
)  # datasets of a quantity, besides its axes

Index = SupportsIndex | tuple[SupportsIndex, ...]  # of a value in the arrays of a quantity


class FormatError(ValueError):
    """The file is missing, damaged or not a result of this project, or has no such quantity."""


@dataclass(frozen=True)
class Quantity:
    """Estimate with errors over axes, which map names to coordinates in the order of the dimensions.

    A measured quantity has a standard error and a count of replicas, a computed one a discretisation error;
    the others are None. control_variates: number of those fitted.
    """

    mean: np.ndarray
    standard_error: np.ndarray | None
    discretisation_error: np.ndarray | None
    count: np.ndarray | None
    axes: dict[str, np.ndarray]
    units: str
    axis_units: dict[str, str]
    control_variates: int

    @property
    def error(self) -> np.ndarray:
        """Standard error. Raises FormatError for a computed quantity."""
        return _measured(self.standard_error)

    @property
    def replicas(self) -> np.ndarray:
        """Number of replicas. Raises FormatError for a computed quantity."""
        return _measured(self.count)

    @property
    def dof(self) -> np.ndarray:
        """Degrees of freedom of the standard error. Raises FormatError for a computed quantity."""
        return self.replicas - 1.0 - self.control_variates

    def to_frame(self) -> "pd.DataFrame":
        """One row per value; attrs["units"] maps columns to theirs."""
        import pandas as pd  # noqa: PLC0415  0.4 s, which make status does not need

        grids = np.meshgrid(*self.axes.values(), indexing="ij")
        axes = {name: grid.ravel() for name, grid in zip(self.axes, grids, strict=True)}
        frame = pd.DataFrame(axes | {name: array.ravel() for name, array in self.arrays().items()})
        units = dict.fromkeys(VALUES, self.units) | {"count": "1"} | self.axis_units
        frame.attrs["units"] = {name: units[name] for name in frame}
        return frame

    def arrays(self) -> dict[str, np.ndarray]:
        """Mean, errors and count by their names."""
        values = {name: getattr(self, name) for name in VALUES}
        return {name: np.asarray(array) for name, array in values.items() if array is not None}


def _measured(array: np.ndarray | None) -> np.ndarray:
    if array is None:
        raise FormatError("a computed quantity has no standard error and no count: use discretisation_error")
    return array


@dataclass(frozen=True, repr=False)
class Result:
    path: Path
    parameters: dict[str, Any]
    provenance: dict[str, Any]
    quantities: dict[str, Quantity]
    parameter_units: dict[str, str] = field(default_factory=dict)  # of those that have a dimension
    parameter_roles: dict[str, str] = field(default_factory=dict)  # physics, effort or output
    parameter_rules: dict[str, str] = field(default_factory=dict)  # the rule of its options

    def __repr__(self) -> str:
        """Path, program with options, warnings."""
        command = f"{self.provenance.get('program')} {self.provenance.get('option_words', '')}"
        return f"{self.path}\n{command}\nwarnings: {'; '.join(self.warnings) or 'none'}"

    def __getitem__(self, name: str) -> Quantity:
        if name not in self.quantities:
            raise FormatError(f"{self.path} has no quantity {name}; {suggestion(name, self.quantities)}")
        return self.quantities[name]

    @property
    def run(self) -> str:
        """Name of the run."""
        return run_of(self.path)

    @property
    def series(self) -> str:
        """Name of the series of the run, which is followed by `_option=value`."""
        return series_of(self.run)

    def ends(self, name: str) -> tuple[float, float]:
        """A parameter of the left and of the right bath."""
        return float(self.parameters[f"{name}_left"]), float(self.parameters[f"{name}_right"])

    def columns(self, *names: str) -> dict[str, Any]:
        """Means and errors of quantities, as columns or numbers of a table: kappa and kappa_error."""
        columns: dict[str, Any] = {}
        for name in names:
            columns |= {name: self[name].mean[()], f"{name}_error": self[name].error[()]}
        return columns

    @property
    def replicas(self) -> int:
        """Number of replicas. Raises FormatError for a computed result."""
        return max(int(quantity.replicas.max(initial=0)) for quantity in self.quantities.values())

    @property
    def converged(self) -> str:
        """State of the target error: reached, not reached, or no target."""
        return str(self.provenance["converged"])

    @property
    def warnings(self) -> list[str]:
        """Reasons to doubt the numbers: a missed target error, a target quantity that is NaN, a window
        that is not stationary or was not tested."""
        reasons = []
        target = self.quantities.get(self.provenance.get("target_quantity", ""))
        if target is not None and np.isnan(target.mean).any():
            reasons.append(UNDEFINED)
        elif self.converged == NOT_REACHED:
            agree = target is not None and target.count is not None and np.isnan(target.error).any()
            reasons.append("target error not reached" + (f": {ALL_AGREE}" if agree else ""))
        if "stationary" in self.quantities:
            if np.isnan(self["stationary"].mean):
                reasons.append(NOT_TESTED)
            elif self["stationary"].mean != 1:
                reasons.append(NOT_STATIONARY)
        return reasons

    @property
    def usable(self) -> bool:
        """Whether there are no warnings."""
        return not self.warnings


def load(path: Path | str) -> Result:
    """Reads a result file. Raises FormatError, also after an edit or a change of name, and OSError if the
    file is unreadable."""
    with _verified(path) as (file, provenance):
        quantities: dict[str, dict[str, h5py.Dataset]] = {}
        for name, dataset in datasets_of(file).items():
            *_, quantity, part = name.split("/")
            quantities.setdefault(quantity, {})[part] = dataset
        read = {name: _quantity(parts) for name, parts in quantities.items()}
        parameters, *described = (
            _attributes(file[f"parameter{kind}"]) for kind in ("s", "_units", "_roles", "_rules")
        )
        return Result(Path(path), parameters, provenance, read, *described)


def load_provenance(path: Path | str) -> dict[str, Any]:
    """The provenance of a result file, which is checked as by load()."""
    with _verified(path) as (_, provenance):
        return provenance


def is_intact(content: bytes) -> bool:
    """Whether a result file ends with the CRC-32 of what precedes it."""
    return content[-DIGITS:] == b"%08x" % zlib.crc32(content[:-DIGITS])


def datasets_of(file: h5py.File) -> dict[str, h5py.Dataset]:
    """All datasets by their paths. To open a dataset takes ten times as long as to read it."""
    nodes: dict[str, h5py.Group | h5py.Dataset] = {}
    file.visititems(lambda name, node: nodes.update({f"/{name}": node}))
    return {path: node for path, node in nodes.items() if isinstance(node, h5py.Dataset)}


@contextmanager
def _verified(path: Path | str) -> Iterator[tuple[h5py.File, dict[str, Any]]]:
    """Opens a result file after checking identity and checksum. HDF5 gets its bytes: it refuses a file
    that the same process has open with another kind of lock. Results are written under another name and
    renamed, and need no lock."""
    try:
        content = Path(path).read_bytes()
        with h5py.File(io.BytesIO(content)) as file:
            provenance = _attributes(file["provenance"]) if "provenance" in file else {}
            if provenance.get("format") != FORMAT:
                raise FormatError("not a result of this project")
            if (version := provenance.get("format_version")) != FORMAT_VERSION:
                raise FormatError(
                    f"format version {version}, not {FORMAT_VERSION}; remake it with make figures"
                )
            own = result_identity(*(provenance[name] for name in ("program", "option_words", "source_hash")))
            if (named_identity(path) or own) != own:
                raise FormatError(
                    f"it contains another result: other options or sources, copied or exchanged{REMEDY}"
                )
            if not is_intact(content):
                raise FormatError(f"edited or damaged: its content differs from its checksum{REMEDY}")
            yield file, provenance
    except FileNotFoundError as error:
        raise FormatError(f"{path} is missing") from error
    except FormatError as error:
        raise FormatError(f"{path}: {error}") from error
    except (OSError, LookupError, RuntimeError, ValueError) as error:
        if isinstance(error, OSError) and error.errno:  # the file is unreadable, not damaged
            raise
        if not re.search(rf"\.{IDENTITY}\.h5$", str(path)):  # the name is not one that the project gives
            raise FormatError(
                f"{path} is damaged, or not a result file: {error}; name a result file"
            ) from error
        raise FormatError(f"{path} is damaged: {error}{REMEDY}") from error


def _attributes(group: h5py.Group) -> dict[str, Any]:
    """Attributes as int, float, bool or str."""
    texts = {name: _text(value) for name, value in group.attrs.items()}
    return {name: value.item() if isinstance(value, np.generic) else value for name, value in texts.items()}


def _text(value: Any) -> Any:
    return value.decode() if isinstance(value, bytes) else value


def _quantity(parts: dict[str, h5py.Dataset]) -> Quantity:
    mean = parts["mean"]
    names = ("discretisation_error",) if "discretisation_error" in parts else ("standard_error", "count")
    # The names of the axes as mean.dims has them, which opens every axis again.
    scales = mean.attrs.get("DIMENSION_LIST", ())
    axes = [h5py.h5r.get_name(scale[0], mean.id).decode().rpartition("/")[2] for scale in scales]
    stored = {"mean": mean, **{name: parts[name] for name in (*names, *axes)}}
    units = {name: _text(dataset.attrs["units"]) for name, dataset in stored.items()}
    for text in units.values():
        parse(text)
    return Quantity(
        mean[()],
        **{name: stored[name][()] if name in names else None for name in VALUES[1:]},
        axes={name: stored[name][()] for name in axes},
        units=units["mean"],
        axis_units={name: units[name] for name in axes},
        control_variates=int(mean.attrs.get("control_variates", 0)),
    )


def cost_file(result: Path) -> Path:
    """The file of the cost, beside the result."""
    return result.with_suffix(".cost.json")


def cpu_seconds(result: Path) -> float | None:
    """CPU time of a result; None if the file of its cost is missing or damaged."""
    with suppress(OSError, ValueError, KeyError):
        return float(json.loads(cost_file(result).read_text())["cpu_seconds"])
    return None
