"""Results from Python: reuse, lists of values, errors, interruption."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from tests.python.conftest import soon
from workflow import measure as module
from workflow import plan
from workflow.identity import ROOT
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
    assert len(files()) == 2
    monkeypatch.setattr(plan, "source_hash", lambda program: "another")
    monkeypatch.setattr(module, "require_built", lambda program: None)
    monkeypatch.setattr(module, "load", lambda path: load(path.rename(path.with_name("another.h5"))))
    measure("steady_profile", **SMALL)
    assert len(files()) == 3


def test_points_have_seeds_of_their_own(folder: Path) -> None:
    """So their errors are independent; a given seed is that of all points."""
    for given, number in (({}, 3), ({"seed": 5}, 1)):
        measure("conductivity", **SMALL, **given, sigma=[0.1, 0.2, 0.3])
        assert len({load(path).parameters["seed"] for path in folder.glob("*.h5")}) == number
        for path in folder.glob("*.h5"):
            path.unlink()


def test_a_flag_and_a_target_quantity_that_is_not_determined() -> None:
    """Without a moving peak the program exits with status 4, and a result is returned."""
    options = {"zero_total_momentum": True, "observation_time": 1, "decades": 1, "replicas": 2}
    assert measure("displacement", cells=4, **options).attrs["zero-total-momentum"]
    tree = measure("correlation", cells=25, sigma=-1, observation_time=1, times="0.5,1", replicas=2)
    assert np.isnan(tree["damping_exponent"]["mean"])
    assert np.isfinite(tree["momentum_correlation"]["mean"]).all()


@pytest.mark.parametrize(
    ("program", "options", "message"),
    [
        ("conductivty", {}, "conductivty is not a program; did you mean conductivity?"),
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
    assert alone["doubts"].item() == "stationarity not tested"
    # The positions of scatterers differ between chains.
    assert measure("boltzmann", cells=[2, 4])["energy_current"]["mean"].shape == (2,)


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


def running(folder: Path) -> bool:
    """Whether a program is running that writes into the folder."""
    command = ["pgrep", "-f", f"bin/persistence .*{folder}"]
    return subprocess.run(command, check=False, capture_output=True).returncode == 0


def test_the_program_ends_with_the_session(folder: Path) -> None:
    """The program writes a checkpoint and exits. Otherwise it would continue alone, at the same time as that of the next call."""
    options = {"cells": 4, "relaxation_time": 1, "observation_time": 200, "replicas": 20000, "threads": 1}
    code = (
        f"from pathlib import Path; from workflow import measure as m; m.FOLDER = Path({str(folder)!r}); "
        f"m.measure('persistence', **{options})"
    )
    session = subprocess.Popen([sys.executable, "-c", code], cwd=ROOT, stderr=subprocess.DEVNULL)
    soon(lambda: running(folder))
    time.sleep(0.5)
    session.terminate()
    session.wait()
    soon(lambda: not running(folder))
    assert [*folder.glob("*.checkpoint")]


def test_an_interrupted_call_is_continued(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    options = {"cells": 4, "relaxation_time": 1, "observation_time": 200, "replicas": 1000, "threads": 1}
    former = signal.signal(
        signal.SIGINT, signal.default_int_handler
    )  # the workers of pytest ignore this signal

    def interrupt() -> None:
        soon(lambda: running(folder))
        time.sleep(1)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt).start()
    try:
        with pytest.raises(KeyboardInterrupt):
            measure("persistence", **options, sigma=0.3)
    finally:
        signal.signal(signal.SIGINT, former)
    assert [*folder.glob("*.checkpoint")]
    interrupted = re.search(r"interrupted after (\d+) replicas", capfd.readouterr().err)
    assert interrupted
    assert int(interrupted[1]) > 0
    resumed = measure("persistence", **options, sigma=0.3)
    assert not [*folder.glob("*.checkpoint")]
    for path in folder.glob("*.h5"):
        path.unlink()
    assert float(measure("persistence", **options, sigma=0.3)["mu"]["mean"]) == float(resumed["mu"]["mean"])
