"""Result files of every program: the described quantities with their units and axes, consistent with one another, and the same bytes
for any number of threads."""

from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.python.conftest import Program
from workflow.lib.described import described, with_option
from workflow.lib.units import parse

MEASURED, COMPUTED = {"mean", "standard_error", "count"}, {"mean", "discretisation_error"}
PROVENANCE = {"format", "format_version", "program", "words", "source_hash", "compiler", "flags", "libraries", "seed", "streams",
              "events", "target_quantity", "target_error", "achieved_error", "converged", "results_digest", "units",
              "documentation"}  # fmt: skip


def axes_of(dataset: h5py.Dataset) -> list[h5py.Dataset]:
    return [scale for dimension in dataset.dims for scale in dimension.values()]


def content(path: Path) -> dict[str, object]:
    """Quantities of a file, as described."""
    with h5py.File(path) as file:
        return {
            name: (
                group["mean"].attrs["units"].decode(),
                [(Path(axis.name).name, axis.attrs["units"].decode()) for axis in axes_of(group["mean"])],
            )
            for name, group in file["results"].items()
        }


def inconsistencies(path: Path) -> Iterator[str]:
    with h5py.File(path) as file:
        for name, group in file["results"].items():
            kinds = group.keys() & (MEASURED | COMPUTED)
            if kinds not in (MEASURED, COMPUTED):
                yield f"{name} has {kinds}"
            for kind, dataset in ((kind, group[kind]) for kind in kinds):
                if dataset.shape != tuple(len(axis) for axis in axes_of(dataset)):
                    yield f"{name}/{kind} has another shape than its axes"
                if dataset.dtype != ("uint64" if kind == "count" else "float64"):
                    yield f"{name}/{kind} has the type {dataset.dtype}"
                if kind != "count" and dataset.attrs["units"] != group["mean"].attrs["units"]:
                    yield f"{name}/{kind} has other units than the mean"
                parse(dataset.attrs["units"].decode())
        stated = file["provenance"].attrs
        state = stated["converged"].decode()
        if missing := PROVENANCE - set(stated):
            yield f"{missing} are not stated"
        if state == "reached" and not stated["achieved_error"] <= stated["target_error"]:
            yield "the target error is not reached"
        if state == "no target" and not np.isnan(stated["target_error"]):
            yield "there is a target error"


@pytest.mark.parametrize("name", described())
def test_files_have_the_described_content_and_the_same_bytes_for_any_threads(
    program: Program, tmp_path: Path, name: str
) -> None:
    replicated = name in with_option("replicas")
    for threads in (1, 3):
        done = program(name, output=f"{threads}.h5", **({"threads": threads} if replicated else {}))
        assert done.returncode == 0, done.stderr
    assert (tmp_path / "1.h5").read_bytes() == (tmp_path / "3.h5").read_bytes()
    assert content(tmp_path / "1.h5") == {
        quantity["name"]: (quantity["units"], [(axis["name"], axis["units"]) for axis in quantity["axes"]])
        for quantity in described()[name]["quantities"]
    }
    assert [*inconsistencies(tmp_path / "1.h5")] == []


def test_a_wrong_file_is_found(program: Program, tmp_path: Path) -> None:
    program("waiting_time", target_error=100)
    assert [*inconsistencies(tmp_path / "out.h5")] == []
    with h5py.File(tmp_path / "out.h5", "r+") as file:
        del file["results/exponent/count"]
        file["results/density/mean"].dims[0].detach_scale(file["results/density/mean"].dims[0][0])
        file["results/density/mean"].attrs["units"] = np.bytes_("length")
        file["provenance"].attrs["achieved_error"] = np.nan
        del file["provenance"].attrs["streams"]
    assert len([*inconsistencies(tmp_path / "out.h5")]) == 5
