"""Results from Python: reuse, lists of values, errors, interruption."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.python.conftest import soon
from workflow.lib.identity import ROOT
from workflow.lib.load import load
from workflow.pipeline import measure as module
from workflow.pipeline.measure import MeasureError, measure

SMALL = {"cells": 4, "gamma": "N", "replicas": 4, "relaxation_time": 1, "observation_time": 2}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(module, "MEASURED", tmp_path)
    return tmp_path


def test_a_result_is_reused_for_equal_options(folder: Path) -> None:
    def files() -> list[tuple[Path, int]]:
        return sorted((path, path.stat().st_mtime_ns) for path in folder.glob("*.h5"))

    measure("steady_profile", **SMALL)
    first = files()
    measure("steady_profile", **dict(reversed(SMALL.items())))
    assert files() == first
    measure("steady_profile", **SMALL, seed=2)
    assert len(files()) == 2


def test_points_have_seeds_of_their_own(folder: Path) -> None:
    """So their errors are independent; a given seed is that of all points."""
    for given, number in (({}, 3), ({"seed": 5}, 1)):
        measure("conductivity", **SMALL, **given, sigma=[0.1, 0.2, 0.3])
        assert len({load(path).parameters["seed"] for path in folder.glob("*.h5")}) == number
        for path in folder.glob("*.h5"):
            path.unlink()


def test_a_result_that_was_edited_is_measured_again(folder: Path) -> None:
    before = measure("steady_profile", **SMALL)["density"].to_dataset()
    (path,) = folder.glob("*.h5")
    with h5py.File(path, "r+") as file:
        file["results/density/mean"][...] *= 1.001
    with pytest.warns(UserWarning, match="edited"):
        again = measure("steady_profile", **SMALL)["density"].to_dataset()
    assert again.identical(before)


@pytest.mark.parametrize(
    ("program", "options", "message"),
    [
        ("conductivity", {"cell": 4}, "conductivity has no option cell; did you mean cells?"),
        ("conductivity", {"sigma": 2}, "conductivity: error: --sigma"),
        ("conductivity", {"cells": [8, 8]}, "cells has no value, or one twice"),
    ],
)
def test_errors_are_one_line(program: str, options: dict[str, object], message: str, folder: Path) -> None:
    with pytest.raises(MeasureError) as error:
        measure(program, **options)
    assert str(error.value).startswith(message)
    assert "\n" not in str(error.value)
    assert not [*folder.glob("*.h5")]


def test_lists_give_a_dimension_each() -> None:
    """In the order given, and of mixed types."""
    tree = measure("steady_profile", **SMALL | {"cells": [4.0, 2], "gamma": ["N", np.int64(1)]})
    current = tree["energy_current_mean"]["mean"]
    assert current.coords["cells"].values.tolist() == [4, 2]
    assert current.coords["gamma"].values.tolist() == ["N", 1]
    alone = measure("steady_profile", **SMALL | {"gamma": 1})
    assert float(current[0, 1]) == float(alone["energy_current_mean"]["mean"])
    profile = tree["density"]["mean"][1, 0]
    assert np.isfinite(profile).values.tolist() == [True, True, False, False]
    assert tree["converged"].values.tolist() == [["no target"] * 2] * 2
    assert "cells" not in tree.attrs


def test_a_list_of_times_is_one_value() -> None:
    options = {"cells": 4, "replicas": 4}
    tree = measure("particle_count", **options, times=[1, 2.5, 4])
    assert tree["plateau"].coords["time"].values.tolist() == [1, 2.5, 4]
    assert "times" not in tree["log_slope"].dims
    both = measure("particle_count", **options, times=["1,2.5,4", "1,2"])["log_slope"]
    assert dict(both.sizes) == {"times": 2}
    assert float(both["mean"][0]) == float(tree["log_slope"]["mean"])


def test_doubts_are_warned_of() -> None:
    options = {"start": "empty", "relaxation_time": 0, "observation_time": 5, "cells": 64, "replicas": 32}
    with pytest.warns(UserWarning, match="conductivity: not stationary"):
        assert measure("conductivity", **options)["doubts"].item() == "not stationary"
    with pytest.warns(UserWarning, match="stationarity not tested"):
        measure("conductivity", **options | {"replicas": 1})


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_call_is_continued(folder: Path, number: signal.Signals) -> None:
    """Ctrl-C, and the end of a session: the program writes a checkpoint and exits. Otherwise it would continue alone, at the same time as
    that of the next call. test_interruption.py compares the bytes."""
    options = {"cells": 4, "relaxation_time": 1, "observation_time": 200, "replicas": 1000, "threads": 1}
    code = (
        f"from pathlib import Path; from workflow.pipeline import measure as m; m.MEASURED = Path({str(folder)!r}); "
        f"m.measure('persistence', **{options})"
    )
    command = ["env", "--default-signal=INT", sys.executable, "-c", code]
    session = subprocess.Popen(command, cwd=ROOT, stderr=subprocess.DEVNULL)

    def running() -> bool:
        found = ["pgrep", "-f", f"bin/persistence .*{folder}"]
        return subprocess.run(found, check=False, capture_output=True).returncode == 0

    soon(running)
    time.sleep(1)
    session.send_signal(number)
    assert session.wait() != 0
    soon(lambda: not running())
    assert [*folder.glob("*.checkpoint")]
    measure("persistence", **options)
    assert not [*folder.glob("*.checkpoint")]
