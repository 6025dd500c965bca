"""The expansion of the configuration to runs: names, seeds, options, and effort by quality."""

import shutil
from pathlib import Path

import pytest

from tests.python.conftest import ROOT
from workflow import plan
from workflow.configuration import FOLDER, ConfigurationError
from workflow.plan import BATCH, QUALITIES, Quality, Run, data_path, load_plan
from workflow.polynomial import evaluated


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
        for run in panel.runs:
            assert (ROOT / f"cpp/observables/{run.program}.cpp").is_file()
            assert (run.program != "boltzmann") == run.replicated == ("seed" in run.options)
            assert run.options.get("replicas", 2) >= 2 or "_run=" in run.name


def test_names_and_seeds_are_unique() -> None:
    panels = load_plan("paper").values()
    names = [(panel.name, run.name) for panel in panels for run in panel.runs]
    seeds = [run.options["seed"] for panel in panels for run in panel.runs if run.replicated]
    assert len(set(names)) == len(names)
    assert len(set(seeds)) == len(seeds)


def test_seeds_stay_as_they_are() -> None:
    """Results of a release are reproduced by the next one."""
    run = load_plan("paper")["fig05"].run("paper_sigma=0.5")
    assert run.options | {"replicas": 0} == {
        **{"cells": 11, "cell-length": 1, "temperature": 500, "relaxation-time": 100},
        **{"observation-time": 100, "particles-per-cell": 20, "sigma": 0.5},
        **{"replicas": 0, "seed": 3069184982},
    }
    changed = load_plan("paper_seed=7_replicas=5")["fig05"].run("paper_sigma=0.5")
    assert changed.options == run.options | {"replicas": 5, "seed": 3127557821}


def test_the_effort_of_the_user_replaces_that_of_the_quality() -> None:
    for given in ({"replicas": 32}, {"error": 0.1}):
        completed = Quality.of("smoke_replicas=5").complete("fig05", "paper", given | {"sigma": 0}, None)
        assert {key: completed[key] for key in completed if key != "seed"} == {"replicas": 5, "sigma": 0}
    assert Quality.of("smoke_seed=7_replicas=5").arguments == "QUALITY=smoke SEED=7 REPLICAS=5"
    quality = Quality.of("smoke_seed=7_error=0.005")
    assert quality.arguments == "QUALITY=smoke SEED=7 ERROR=0.005"
    completed = quality.complete("fig05", "paper", {"replicas": 500, "sigma": 0}, 200)
    given = {key: completed[key] for key in ("replicas", "target-error", "target-scale")}
    assert given == {"replicas": BATCH, "target-error": 0.005, "target-scale": 200}


EFFORT_OF_FIG05 = "  fig05: {replicas: 8, dense: {replicas: 2}}"


@pytest.mark.parametrize(
    ("effort", "replicas", "errors"),
    [
        ("", {4}, set()),
        ("  fig05: {replicas: 8}", {8}, set()),
        ("  fig05: {replicas: 8, dense: {replicas: 2}}", {8, 2}, set()),
        ("  fig05: {error: 0.1}", {BATCH}, {0.1}),
        ("  fig05: {error: 0.1, dense: {replicas: 2}}", {BATCH, 2}, {0.1}),
        ("  fig05: {replicas: 8, dense: {error: 0.2}}", {BATCH, 8}, {0.2}),
        ("  fig05: {omit: [dense]}", {4}, set()),
    ],
)
def test_effort_of_quality_panel_and_series(
    folder: Path, effort: str, replicas: set[int], errors: set[float]
) -> None:
    edit(folder / "quality/smoke.yaml", EFFORT_OF_FIG05, effort)
    runs = load_plan("smoke", folder)["fig05"].runs
    assert {run.options["replicas"] for run in runs} == replicas
    assert {run.options["target-error"] for run in runs if "target-error" in run.options} == errors
    assert any(run.name.startswith("dense") for run in runs) == ("omit" not in effort)


def test_a_run_has_no_slash_in_its_name(folder: Path) -> None:
    edit(folder / "paper.yaml", "        cell-length: 1/N\n", "        cell-length: [1/N, 0.1]\n")
    names = {run.name for run in load_plan("smoke", folder)["fig01"].runs}
    assert {"unit-chain_cell-length=1perN", "unit-chain_cell-length=0.1"} < names


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("smoke_seed=-1", "SEED=-1 is invalid; give a whole number from 0 to 10^18 - 1"),
        ("smoke_replicas=0", "REPLICAS=0 is invalid"),
        ("smoke_error=1.5", "ERROR=1.5 is invalid"),
        ("smoke_error=2%", "ERROR=2% is invalid; give a number greater than 0 and less than 1, as 0.02 for 2 %"),
        ("smoke_erorr=1", "erorr=1 is no effort; did you mean error?"),
        ("smoke_error=0.1_replicas=2", "ERROR and REPLICAS both determine"),
    ],
)  # fmt: skip
def test_invalid_efforts(name: str, message: str) -> None:
    with pytest.raises(ConfigurationError) as error:
        Quality.of(name)
    assert str(error.value).startswith(message)


def test_what_determines_a_result_is_in_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    run = Run("a", "persistence", {"sigma": 0.5, "cells": 8, "seed": 1})
    same = Run("b", "persistence", {"cells": 8.0, "seed": 1, "sigma": 0.5, "separate": False})
    different = [
        Run("a", "persistence", {"sigma": 0.5, "cells": 8, "seed": 2}),
        Run("a", "persistence", {"sigma": 0.5, "cells": 8}),
        Run("a", "ageing", run.options),
    ]
    assert run.words == same.words == "--cells 8 --seed 1 --sigma 0.5"
    assert run.identity == same.identity
    monkeypatch.setattr(plan, "source_hash", lambda program: "another")
    names = {variant.identity for variant in (run, *different, Run("a", "persistence", run.options))}
    assert len(names) == 2 + len(different)
    assert data_path("standard_seed=7", "fig05", run) == f"data/standard/fig05/a.{run.identity}.h5"


@pytest.mark.parametrize(
    ("text", "value"),
    [(7, 7), ("5e1", "5e1"), ("0.05N", 0.5), ("400+0.02N^2", 402), ("1e-3N^2+2N+1", 21.1), ("N", "N"),
     ("1/N", "1/N"), ("2N^3", "2N^3"), ("-1N", "-1N"), ("0.1N", 1), ("0.015N", 0.15), (True, True)],
)  # fmt: skip
def test_a_polynomial_is_evaluated_at_the_number_of_cells(text: object, value: object) -> None:
    assert evaluated(text, 10) == value
    assert type(evaluated(text, 10)) is type(value)
