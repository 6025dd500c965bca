import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

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
    second = files()
    assert len(second) == 2
    monkeypatch.setattr(plan, "source_hash", lambda program: "another")
    monkeypatch.setattr(module, "require_built", lambda program: None)
    monkeypatch.setattr(module, "load", lambda path: load(path.rename(path.with_name("another.h5"))))
    measure("steady_profile", **SMALL)
    assert len(files()) == 3


def test_a_flag() -> None:
    options = {"zero_total_momentum": True, "observation_time": 1, "decades": 1, "replicas": 2}
    tree = measure("displacement", cells=4, **options)
    assert tree.attrs["zero-total-momentum"]
    assert np.isfinite(tree["alpha"]["standard_error"])


def test_a_target_quantity_that_is_not_determined() -> None:
    """Without a moving peak the program exits with status 4, and a result is returned."""
    tree = measure("correlation", cells=25, sigma=-1, observation_time=1, times="0.5,1", replicas=2)
    assert np.isnan(tree["damping_exponent"]["mean"])
    assert np.isfinite(tree["momentum_correlation"]["mean"]).all()


@pytest.mark.parametrize(
    ("program", "options", "message"),
    [
        ("conductivty", {}, "conductivty is not a program; did you mean conductivity?"),
        ("conductivity", {"cell": 4}, "conductivity has no option cell; did you mean cells?"),
        ("conductivity", {"output": "x.h5"}, "conductivity has no option output; "),
        ("conductivity", {"sigma": 2}, "conductivity: error: --sigma"),
        ("conductivity", {"cells": True}, "cells=True: cells is no flag; give a value"),
        ("conductivity", {"cells": []}, "cells has no value, or one twice"),
        ("conductivity", {"cells": [8, 8]}, "cells has no value, or one twice"),
        ("conductivity", {"cells": {4, 8}}, "cells is a set without one order; give a list"),
        ("conductivity", {"cells": np.ones((2, 2))}, "cells is a ndarray without one order; give a list"),
        ("conductivity", {"nu-left": 1, "nu_left": 2}, "nu-left is given twice"),
    ],
)
def test_errors_are_one_line(program: str, options: dict[str, object], message: str, folder: Path) -> None:
    with pytest.raises(MeasureError) as error:
        measure(program, **options)
    assert str(error.value).startswith(message)
    assert "\n" not in str(error.value)
    assert not [*folder.glob("*.h5")]


def test_lists_give_a_dimension_each() -> None:
    tree = measure("steady_profile", **SMALL | {"cells": [2, 4.0], "sigma": np.array([0.2, 0.5])})
    current = tree["energy_current_mean"]
    assert dict(current.sizes) == {"cells": 2, "sigma": 2}
    assert current.coords["cells"].values.tolist() == [2, 4]
    alone = measure("steady_profile", **SMALL | {"sigma": np.float64(0.2)})
    assert float(current["mean"].sel(cells=4, sigma=0.2)) == float(alone["energy_current_mean"]["mean"])
    profile = tree["density"]["mean"].sel(cells=2, sigma=0.5)
    assert np.isfinite(profile).values.tolist() == [True, True, False, False]
    assert tree["converged"].values.tolist() == [["no target"] * 2] * 2
    assert "cells" not in tree.attrs
    assert alone["doubts"].item() == "stationarity not tested"
    assert tree.attrs["gamma"] == "N"


def test_lists_keep_their_order_and_mix_types() -> None:
    tree = measure("conductivity", **SMALL | {"cells": [8, 4], "gamma": ["N", 1]})
    kappa = tree["kappa"]["mean"]
    assert kappa.coords["cells"].values.tolist() == [8, 4]
    assert kappa.coords["gamma"].values.tolist() == ["N", 1]
    alone = measure("conductivity", **SMALL | {"cells": 8, "gamma": 1})
    assert float(kappa[0, 1]) == float(alone["kappa"]["mean"])
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


def running(folder: Path) -> list[int]:
    """Process numbers of the programs that write into a folder."""
    command = ["pgrep", "-f", f"bin/persistence .*{folder}"]
    return [*map(int, subprocess.run(command, check=False, capture_output=True, text=True).stdout.split())]


def wait_until(condition: Callable[[], object]) -> None:
    for _ in range(400):
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError("not within 20 s")


LONG = {"cells": 4, "relaxation_time": 1, "observation_time": 200, "replicas": 20000, "threads": 1}


def test_a_killed_program_is_named(folder: Path) -> None:
    def kill() -> None:
        wait_until(lambda: running(folder))
        os.kill(running(folder)[0], signal.SIGKILL)

    threading.Thread(target=kill).start()
    with pytest.raises(MeasureError, match="persistence was killed by SIGKILL; run it again"):
        measure("persistence", **LONG)


def test_the_program_ends_with_the_session(folder: Path) -> None:
    """The program writes a checkpoint and exits. Otherwise it would continue alone, at the same time as that of the next call."""
    code = (
        f"from pathlib import Path; from workflow import measure as m; m.FOLDER = Path({str(folder)!r}); "
        f"m.measure('persistence', **{LONG})"
    )
    session = subprocess.Popen([sys.executable, "-c", code], cwd=ROOT, stderr=subprocess.DEVNULL)
    wait_until(lambda: running(folder))
    time.sleep(0.5)
    session.terminate()
    session.wait()
    wait_until(lambda: not running(folder))
    assert [*folder.glob("*.checkpoint")]


def test_points_have_independent_errors() -> None:
    """Currents at two neighbouring sigma in 40 pairs of runs. With a common seed their correlation would be 0.95."""
    sigmas = [0.5, 0.51]
    common = {"cells": 8, "replicas": 4, "relaxation_time": 1}
    times = np.linspace(2, 2.4, 40)
    shared, own = (
        [
            [
                float(
                    measure("conductivity", **common, **seed, sigma=sigma, observation_time=time)[
                        "energy_current_plain"
                    ]["mean"]
                )
                for sigma in sigmas
            ]
            for time, seed in zip(times, seeds, strict=True)
        ]
        for seeds in ([{"seed": number} for number in range(40)], [{}] * 40)
    )
    assert np.corrcoef(np.transpose(shared))[0, 1] > 0.8
    assert abs(np.corrcoef(np.transpose(own))[0, 1]) < 0.5  # three standard errors


def test_doubts_are_warned_of() -> None:
    options = {"start": "empty", "relaxation_time": 0, "observation_time": 5, "cells": 64, "replicas": 32}
    with pytest.warns(UserWarning, match="conductivity: not stationary"):
        assert measure("conductivity", **options)["doubts"].item() == "not stationary"
    with pytest.warns(UserWarning, match="stationarity not tested"):
        measure("conductivity", **options | {"replicas": 1})
    with pytest.warns(UserWarning, match="steady_profile: stationarity not tested"):
        measure("steady_profile", **options)


def test_an_interrupted_call_is_continued(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    options = {"cells": 4, "relaxation_time": 1, "observation_time": 200, "replicas": 4000, "threads": 1}
    former = signal.signal(
        signal.SIGINT, signal.default_int_handler
    )  # the workers of pytest ignore this signal
    timer = threading.Timer(1.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
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
