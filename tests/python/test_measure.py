import os
import re
import signal
import threading
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
    options = {"zero_total_momentum": True, "observation_time": 1, "decades": 1, "replicas": 2}
    with pytest.warns(UserWarning, match="target error not reached"):
        tree = measure("displacement", cells=4, **options, time_limit=1e-9, target_error=1e-9)
    assert tree.attrs["zero-total-momentum"]
    assert np.isfinite(tree["alpha"]["standard_error"])


def test_a_target_quantity_that_is_not_determined() -> None:
    """Without a moving peak; the exit status is 4."""
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
    assert tree.attrs["gamma"] == "N"


def test_points_have_independent_errors() -> None:
    """Currents at neighbouring sigma over 40 starts of the measurement: with one seed their correlation is 0.95."""
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
        assert measure("conductivity", **options).attrs["doubts"] == "not stationary"
    with pytest.warns(UserWarning, match="at cells = 4: target error not reached"):
        tree = measure(
            "persistence", cells=[4], replicas=4, target_error=1e-9, time_limit=1e-9, observation_time=1
        )
    assert tree["converged"].item() == "not reached"


def test_an_interrupted_call_is_continued(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    options = {"cells": 4, "relaxation_time": 1, "observation_time": 200, "replicas": 4000, "threads": 1}
    former = signal.signal(signal.SIGINT, signal.default_int_handler)  # workers of pytest ignore it
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
