"""The expansion of the configuration to runs: names, seeds, options, and effort by quality."""

import shutil
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from workflow import plan
from workflow.configuration import EFFORT, FOLDER, ConfigurationError
from workflow.identity import identity
from workflow.plan import BATCH, QUALITIES, Quality, Run, data_path, load_plan


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return Path(shutil.copytree(FOLDER, tmp_path / "config"))


def edit(path: Path, old: str, new: str) -> None:
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new, 1))


@pytest.mark.parametrize("quality", QUALITIES)
def test_every_quality_describes_every_panel(quality: str) -> None:
    for panel in load_plan(quality).values():
        assert (ROOT / f"workflow/figures/{panel.script}.py").is_file()
        assert panel.runs or panel.uses
        for run in panel.runs:
            assert (ROOT / f"cpp/observables/{run.program}.cpp").is_file()
            assert run.replicated == ("seed" in run.options) == ("replicas" in run.options)
            assert run.options.get("replicas", 2) >= 2


def test_names_and_seeds_are_unique() -> None:
    panels = load_plan("paper").values()
    names = [(panel.name, run.name) for panel in panels for run in panel.runs]
    seeds = [run.options["seed"] for panel in panels for run in panel.runs if run.replicated]
    assert len(set(names)) == len(names)
    assert len(set(seeds)) == len(seeds)


def test_seeds_stay_as_they_are() -> None:
    """Results of a release are reproduced by the next one."""
    run = load_plan("paper")["fig05"].run("paper_sigma=0.5")
    assert run.options == {
        **{"cells": 11, "cell-length": 1, "temperature": 500, "relaxation-time": 100},
        **{"observation-time": 100, "particles-per-cell": 20, "sigma": 0.5},
        **{"replicas": 1024, "seed": 3069184982},
    }
    changed = load_plan("paper_seed=7_replicas=5")["fig05"].run("paper_sigma=0.5")
    assert changed.options == run.options | {"replicas": 5, "seed": 3127557821}


def test_replicas_of_the_user_replace_a_target_error() -> None:
    options = {"replicas": 32, "target-error": 0.1, "target-absolute": 0.1, "sigma": 0}
    completed = Quality.of("smoke_replicas=5").complete("fig05", "paper", options)
    assert {key: completed[key] for key in completed if key != "seed"} == {"replicas": 5, "sigma": 0}
    assert Quality.of("smoke_seed=7_replicas=5").arguments == "QUALITY=smoke SEED=7 REPLICAS=5"


def test_a_series_without_replicas_is_left_out(folder: Path) -> None:
    edit(folder / "quality/smoke.yaml", "    dense: {replicas: 2}", "    dense: {replicas: 0}")
    names = [run.name for run in load_plan("smoke", folder)["fig05"].runs]
    assert names
    assert all(name.startswith("paper") for name in names)


def test_a_run_has_no_slash_in_its_name(folder: Path) -> None:
    edit(folder / "paper.yaml", "        cell-length: 1/N\n", "        cell-length: [1/N, 0.1]\n")
    names = {run.name for run in load_plan("smoke", folder)["fig01"].runs}
    assert {"unit-chain_cell-length=1perN", "unit-chain_cell-length=0.1"} < names


def test_quality_changes_effort_only() -> None:
    plans = [load_plan(quality) for quality in QUALITIES]
    for name, panel in plans[0].items():
        for run in panel.runs:
            same = [match for plan in plans for match in plan[name].runs if match.name == run.name]
            physics = [
                {key: value for key, value in match.options.items() if key not in EFFORT} for match in same
            ]
            assert all(options == physics[0] for options in physics)


def test_fig05_covers_the_range_and_its_limits() -> None:
    sigmas = {run.options["sigma"] for run in load_plan("smoke")["fig05"].runs}
    assert {-1, 0, 1} <= sigmas
    assert len([sigma for sigma in sigmas if -0.99 <= sigma <= 0.99]) >= 19


def test_an_error_replaces_replicas() -> None:
    quality = Quality.of("smoke_seed=7_error=0.005_hours=2")
    assert quality.arguments == "QUALITY=smoke SEED=7 ERROR=0.005 HOURS=2.0"
    completed = quality.complete("fig05", "paper", {"replicas": 500, "sigma": 0})
    assert {key: completed[key] for key in completed if key != "seed"} == {
        "replicas": BATCH,
        "target-error": 0.005,
        "sigma": 0,
    }
    assert quality.complete("fig05", "paper", {}, 200)["target-absolute"] == 1
    runs = load_plan("smoke_error=0.01")["ext13"].runs
    assert {run.series: "target-absolute" in run.options for run in runs} == {
        run.series: run.series == "random" for run in runs
    }


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("best", "best is not a quality; choose one of"),
        ("smoke_seed=07", "SEED=07 is invalid"),
        ("smoke_seed=1_seed=2", "seed=2 is given more than once"),
        ("smoke_seed=-1", "SEED=-1 is invalid; allowed: a whole number from 0 to 10^18 - 1"),
        ("smoke_replicas=0", "REPLICAS=0 is invalid"),
        ("smoke_error=0", "ERROR=0 is invalid; allowed: a number greater than 0"),
        ("smoke_error=x", "ERROR=x is invalid"),
        ("smoke_erorr=1", "erorr=1 is no effort; did you mean error?"),
        ("smoke_error=1_replicas=2", "ERROR and REPLICAS both determine"),
        ("smoke_hours=1", "HOURS bounds the time to reach an error"),
    ],
)
def test_invalid_efforts(name: str, message: str) -> None:
    with pytest.raises(ConfigurationError) as error:
        Quality.of(name)
    assert str(error.value).startswith(message)


def test_what_determines_a_result_is_in_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    run = Run("a", "persistence", {"sigma": 0.5, "cells": 8, "seed": 1})
    same = Run("b", "persistence", {"cells": 8.0, "seed": 1, "sigma": 0.5})
    different = [
        Run("a", "persistence", {"sigma": 0.5, "cells": 8, "seed": 2}),
        Run("a", "persistence", {"sigma": 0.5, "cells": 8}),
        Run("a", "ageing", run.options),
        Run("a", "persistence", run.options, hours=2),
    ]
    assert run.identity == same.identity
    monkeypatch.setattr(plan, "build_id", lambda program: "another")
    names = {variant.identity for variant in (run, *different, Run("a", "persistence", run.options))}
    assert len(names) == 2 + len(different)
    assert data_path("standard_seed=7", "fig05", run) == f"data/standard/fig05/a.{run.identity}.h5"


def test_booleans_and_numbers_differ() -> None:
    assert len({identity({"a": one}) for one in (True, False, 1, "1", 1.5)}) == 5
    assert identity(1) == identity(1.0)
