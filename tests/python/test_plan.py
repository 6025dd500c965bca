"""The expansion of the configuration to runs: names, seeds, options, and effort by quality."""

import shutil
from pathlib import Path

import pytest

from tests.python.conftest import planned, sampled
from workflow.lib.identity import run_name
from workflow.pipeline.configuration import PANELS, ConfigurationError, Options
from workflow.pipeline.plan import Plan, Run
from workflow.pipeline.program import threads_of
from workflow.pipeline.quality import Quality


def test_names_and_seeds_are_unique() -> None:
    panels = [*planned("paper")]
    names = [(panel.name, run.name) for panel in panels for run in panel.runs]
    seeds = [run.options["seed"] for panel in panels for run in panel.runs if sampled(run)]
    assert len(set(names)) == len(names)
    assert len(set(seeds)) == len(seeds)


def test_seeds_stay_as_they_are() -> None:
    """Results of a release are reproduced by the next one."""
    run = planned("paper")["fig05"].run("paper_sigma=0.5")
    assert run.options | {"replicas": 0} == {
        **{"cells": 11, "cell-length": 1, "temperature": 500, "relaxation-time": 100},
        **{"observation-time": 100, "particles-per-cell": 20, "sigma": 0.5},
        **{"replicas": 0, "seed": 3069184982},
    }
    changed = planned("paper_seed=7_replicas=5")["fig05"].run("paper_sigma=0.5")
    assert changed.options == run.options | {"replicas": 5, "seed": 3127557821}


def test_the_effort_of_the_user_replaces_that_of_the_quality() -> None:
    for given in ({"replicas": 32}, {"error": 0.1}):
        completed = Quality.parse("smoke_replicas=5").with_effort("fig05/paper", given | {"sigma": 0})
        assert {key: completed[key] for key in completed if key != "seed"} == {"replicas": 5, "sigma": 0}
    assert Quality.parse("smoke_seed=7_replicas=5").arguments == "QUALITY=smoke SEED=7 REPLICAS=5"
    assert Quality.parse("smoke_error=0.50_seed=7").name == "smoke_seed=7_error=0.5"  # one folder
    assert Quality.parse("smoke_error=5e-3").effort == {"error": 0.005}
    quality = Quality.parse("smoke_seed=7_error=0.005")
    assert quality.arguments == "QUALITY=smoke SEED=7 ERROR=0.005"
    completed = quality.with_effort("fig05/paper", {"replicas": 500, "sigma": 0})
    assert {key: completed[key] for key in completed if key != "seed"} == {"sigma": 0, "target-error": 0.005}


def test_a_name_belongs_to_one_panel_and_is_that_of_a_file(tmp_path: Path) -> None:
    own = tmp_path / "own.yaml"
    own.write_text("panels: {fig05: {uses: [fig06]}}\n")
    with pytest.raises(ConfigurationError, match=r"panels.fig05: is a panel of workflow/config/paper.yaml"):
        Plan("smoke", [PANELS[0], own])
    assert "/" not in run_name("chain", {"cell-length": "1/N"})


def test_threads_share_the_replicas() -> None:
    efforts: list[Options] = [{}, {"replicas": 63}, {"replicas": 320}, {"replicas": 10**6}]
    efforts.append({"target-error": 0.1})  # at least 64 replicas
    assert [threads_of(Run("paper", "paper", "persistence", effort, "")) for effort in efforts] == [
        1,
        1,
        10,
        16,
        2,
    ]


@pytest.mark.parametrize(
    ("effort", "replicas", "errors"),
    [
        ("", {4}, set()),
        ("  fig05: {error: 0.1, dense: {replicas: 2}}", {None, 2}, {0.1}),
        ("  fig05: {replicas: 8, dense: {error: 0.2}}", {None, 8}, {0.2}),
        ("  fig05: {omit: [dense]}", {4}, set()),
    ],
)
def test_effort_of_quality_panel_and_series(
    tmp_path: Path, effort: str, replicas: set[int | None], errors: set[float]
) -> None:
    folder = Path(shutil.copytree(PANELS[0].parent, tmp_path / "config"))
    smoke = (folder / "quality/smoke.yaml").read_text()
    former = "  fig05: {replicas: 8, dense: {replicas: 2}}"
    assert former in smoke
    (folder / "quality/smoke.yaml").write_text(smoke.replace(former, effort))
    runs = Plan("smoke", [folder / "paper.yaml"])["fig05"].runs
    assert {run.options.get("replicas") for run in runs} == replicas
    assert {run.options["target-error"] for run in runs if "target-error" in run.options} == errors
    assert any(run.name.startswith("dense") for run in runs) == ("omit" not in effort)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("smoke_seed=-1", "SEED=-1 is invalid"),
        ("smoke_error=2%", "ERROR=2% is invalid"),
        ("smoke_error=2", "ERROR=2 is invalid"),
        ("smoke_seed=1_seed=2", "seed=2 is given more than once"),
        ("smoke_erorr=1", "erorr=1 is no effort; did you mean error?"),
        ("smoke_error=0.1_replicas=2", "ERROR and REPLICAS both determine"),
    ],
)  # fmt: skip
def test_a_quality_refuses_invalid_efforts(name: str, message: str) -> None:
    with pytest.raises(ConfigurationError) as error:
        Quality.parse(name)
    assert str(error.value).startswith(message)


def test_a_quality_has_the_name_of_its_file(monkeypatch: pytest.MonkeyPatch) -> None:
    """Detected mistake: `my_own` is the quality `my`."""
    monkeypatch.setattr("workflow.pipeline.quality.QUALITIES", ["my_own"])
    assert Quality.parse("my_own_seed=7").arguments == "QUALITY=my_own SEED=7"
