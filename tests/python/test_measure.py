from pathlib import Path

import numpy as np
import pytest

from workflow import measure as module
from workflow.lib import plan
from workflow.lib.load import load
from workflow.measure import MeasureError, measure

SMALL = {"cells": 4, "gamma": "N", "replicas": 4, "relaxation_time": 1, "observation_time": 2}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(module, "FOLDER", tmp_path)
    return tmp_path


def test_result_as_xarray_with_errors(folder: Path) -> None:
    tree = measure("steady_profile", **SMALL)
    (path,) = folder.glob("steady_profile.*.h5")
    result = load(path)
    assert set(tree.children) == set(result.quantities)
    assert (tree.attrs["cells"], tree.attrs["gamma"]) == (4, "N")
    temperature = tree["temperature_scatterer"]
    assert temperature["mean"].dims == ("cell",)
    assert temperature["mean"].attrs["units"] == "temperature"
    assert np.array_equal(temperature["standard_error"], result["temperature_scatterer"].error)


def test_a_result_is_reused_for_equal_options_and_the_same_build(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def files() -> list[tuple[Path, int]]:
        return sorted((path, path.stat().st_mtime_ns) for path in folder.glob("*.h5"))

    measure("steady_profile", **SMALL)
    first = files()
    measure("steady_profile", **dict(reversed(SMALL.items())))
    assert files() == first
    measure("steady_profile", **SMALL, seed=2)
    second = files()
    assert len(second) == 2
    monkeypatch.setattr(plan, "built", lambda program: {"build_id": "another"})
    measure("steady_profile", **SMALL)
    assert len(files()) == 3


def test_a_flag_and_a_target_that_is_not_reached() -> None:
    tree = measure(
        "displacement", cells=4, zero_total_momentum=True, observation_time=1, decades=1, replicas=2,
        max_replicas=2, target_error=1e-9,
    )  # fmt: skip
    assert tree.attrs["zero-total-momentum"]
    assert np.isfinite(tree["alpha"]["standard_error"])


@pytest.mark.parametrize(
    ("program", "options", "message"),
    [
        ("conductivty", {}, "conductivty is not a program; did you mean conductivity?"),
        ("conductivity", {"cell": 4}, "conductivity has no option cell; did you mean cells?"),
        ("conductivity", {"output": "x.h5"}, "conductivity has no option output; "),
        ("conductivity", {"sigma": 2}, "conductivity: error: --sigma"),
    ],
)
def test_errors_are_one_line(program: str, options: dict[str, object], message: str, folder: Path) -> None:
    with pytest.raises(MeasureError) as error:
        measure(program, **options)
    assert str(error.value).startswith(message)
    assert "\n" not in str(error.value)
    assert not [*folder.glob("*.h5")]
