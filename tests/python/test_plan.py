"""The configuration: its expansion to runs, and its error messages."""

import shutil
from pathlib import Path

import pytest
import yaml

from tests.python.conftest import ROOT
from workflow.lib import plan
from workflow.lib.option_units import option_units
from workflow.lib.options import arguments
from workflow.lib.plan import FOLDER, QUALITIES, ConfigurationError, load_plan


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    copy = tmp_path / "config"
    shutil.copytree(FOLDER, copy)
    return copy


class Unshared(yaml.SafeDumper):
    """Writes out what several keys share."""

    def ignore_aliases(self, data: object) -> bool:
        return True


def edit(path: Path, *keys: str, value: object) -> None:
    content = yaml.safe_load(path.read_text())
    place = content
    for key in keys[:-1]:
        place = place[key]
    place[keys[-1]] = value
    path.write_text(yaml.dump(content, Dumper=Unshared))


@pytest.mark.parametrize("quality", QUALITIES)
def test_every_quality_describes_every_panel(quality: str) -> None:
    for panel in load_plan(quality).values():
        assert (ROOT / f"workflow/figures/{panel.script}.py").is_file()
        assert panel.runs or panel.uses
        for run in panel.runs:
            assert (ROOT / f"cpp/observables/{run.program}.cpp").is_file()
        for run in panel.runs:
            assert run.replicated == ("seed" in run.options) == ("replicas" in run.options)
            assert run.options.get("replicas", 2) >= 2


def test_a_series_without_replicas_is_left_out(folder: Path) -> None:
    edit(folder / "quality/smoke.yaml", "panels", "fig05", "dense", value={"replicas": 0})
    names = [run.name for run in load_plan("smoke", folder)["fig05"].runs]
    assert names
    assert all(name.startswith("paper") for name in names)


def test_names_and_seeds_are_unique() -> None:
    panels = load_plan("paper").values()
    names = [(panel.name, run.name) for panel in panels for run in panel.runs]
    seeds = [run.options["seed"] for panel in panels for run in panel.runs if run.replicated]
    assert len(set(names)) == len(names)
    assert len(set(seeds)) == len(seeds)


def test_runs_lie_in_the_folder_of_their_panel(folder: Path) -> None:
    """Mutant: the spacing 1/N as it is written."""
    edit(folder / "paper.yaml", "panels", "fig08", "series", "rare-small", "cell-length", value=["1/N", 0.1])
    names = {run.name for run in load_plan("smoke", folder)["fig08"].runs}
    assert any("cell-length=1perN" in name for name in names)
    assert not any("/" in name for name in names)


def test_a_panel_may_only_use_panels_with_runs(folder: Path) -> None:
    for unknown in ("fig99", "ext02"):
        edit(folder / "paper.yaml", "panels", "fig10a", "uses", value=[unknown])
        with pytest.raises(ConfigurationError, match=f"panels.fig10a.uses.*{unknown} has no runs"):
            load_plan("smoke", folder)


def test_quality_changes_effort_only() -> None:
    effort = {"replicas", "max-replicas", "target-error", "target-absolute", "pairs-per-replica", "cells"}
    plans = [load_plan(quality) for quality in QUALITIES]
    for name, panel in plans[0].items():
        for run in panel.runs:
            physics = [
                {key: value for key, value in plan[name].run(run.name).options.items() if key not in effort}
                for plan in plans
                if any(other.name == run.name for other in plan[name].runs)
            ]
            assert all(options == physics[0] for options in physics)


def test_fig05_covers_the_range_and_its_limits() -> None:
    sigmas = {run.options["sigma"] for run in load_plan("smoke")["fig05"].runs}
    assert {-1, 0, 1} <= sigmas
    assert len([sigma for sigma in sigmas if -0.99 <= sigma <= 0.99]) >= 19


def test_arguments() -> None:
    options = {"sigma": -0.5, "zero-total-momentum": True, "random-direction": False, "gamma": "N; touch x"}
    assert arguments(options) == ["--sigma", "-0.5", "--zero-total-momentum", "--gamma", "N; touch x"]


@pytest.mark.parametrize(
    ("keys", "value", "words"),
    [
        (
            ("panels", "fig05", "series", "paper", "sigma"),
            2,
            ["panels.fig05.series.paper.sigma = 2", "number at least -1 and at most 1"],
        ),
        (("panels", "fig05", "series", "paper", "sigma"), [0.5, -3], ["sigma.1 = -3", "at least -1"]),
        (("panels", "fig05", "series", "paper", "sigma"), [0.5, 0.5], ["sigma", "repeats a value"]),
        (("panels", "fig05", "series", "paper", "sigma"), [], ["sigma", "empty"]),
        (("panels", "fig05", "series", "paper", "sigma"), "half", ['sigma = "half"', "number at least -1"]),
        (("panels", "fig05", "series", "paper", "sigma"), float("nan"), ["sigma = .nan", "a decimal number"]),
        (("panels", "fig05", "common", "cells"), 0, ["panels.fig05.common.cells = 0", "integer at least 1"]),
        (("panels", "fig05", "common", "cells"), 2.5, ["common.cells = 2.5", "integer at least 1"]),
        (("panels", "fig05", "common", "cells"), True, ["common.cells = true", "integer at least 1"]),
        (
            ("panels", "fig05", "common", "cels"),
            11,
            ["panels.fig05.common.cels = 11", "persistence has no such option", "the nearest is cells"],
        ),
        (("panels", "fig05", "common", "times"), "1,2", ["common.times", "persistence has no such option"]),
        (("panels", "fig05", "common", "replicas"), 11, ["panels.fig05.common", "replicas"]),
        (("panels", "fig05", "common", "seed"), 1, ["panels.fig05.common", "seed"]),
        (("panels", "fig05", "common", "threads"), 1, ["panels.fig05.common", "threads"]),
        (("panels", "fig05", "common", "gamma"), "n", ['gamma = "n"', "number above 0, or N"]),
        (
            ("panels", "fig01", "common", "times"),
            "200,100",
            ['times = "200,100"', "ascending, separated by commas"],
        ),
        (("panels", "fig01", "common", "start"), "tepid", ['start = "tepid"', "empty or warm"]),
        (
            ("panels", "fig08", "series", "rare", "observation-time"),
            "-1N",
            [
                "series.rare.observation-time",
                "number above 0, or a sum of such, each alone or followed by N or N^2",
            ],
        ),
        (
            ("panels", "fig07_inset", "series", "zero-momentum", "zero-total-momentum"),
            "yes",
            ["series.zero-momentum.zero-total-momentum", "true or false"],
        ),
        (("panels", "fig05", "program"), 7, ["panels.fig05.program = 7", "string"]),
        (
            ("panels", "fig05", "program"),
            "persistance",
            ["fig05", "no program persistance", "nearest is persistence"],
        ),
        (("panels", "fig05", "series"), {}, ["panels.fig05.series"]),
        (
            ("panels", "fig05", "series", "dense", "sigma"),
            [i / 20000 for i in range(20000)],
            ["panels.fig05.series.dense", "has 20000 runs (allowed: at most 1000)"],
        ),
    ],
)
def test_bad_paper_configuration(
    folder: Path, keys: tuple[str, ...], value: object, words: list[str]
) -> None:
    edit(folder / "paper.yaml", *keys, value=value)
    with pytest.raises(ConfigurationError) as raised:
        load_plan("smoke", folder)
    for word in ["paper.yaml: ", " (line ", ", column ", *words]:
        assert word in str(raised.value)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("keys", "value", "words"),
    [
        (("default", "replicas"), -1, ["default.replicas = -1", "integer at least 1"]),
        (("panels", "fig05", "paper"), {"cells": 0}, ["panels.fig05.paper.cells = 0", "integer at least 1"]),
        (
            ("panels", "fig05", "paper"),
            {"pairs-per-replica": 2},
            ["panels.fig05.paper.pairs-per-replica", "persistence has no such option"],
        ),
        (("default", "sigma"), 0.5, ["default", "sigma"]),
        (("panels", "fig99"), {}, ["panels.fig99 (line", "no such key here", "the nearest is fig09"]),
        (("panels", "fig05", "denser"), {"replicas": 3}, ["panels.fig05.denser", "the nearest is dense"]),
    ],
)
def test_bad_quality(folder: Path, keys: tuple[str, ...], value: object, words: list[str]) -> None:
    edit(folder / "quality/smoke.yaml", *keys, value=value)
    with pytest.raises(ConfigurationError) as raised:
        load_plan("smoke", folder)
    for word in ["smoke.yaml: ", " (line ", ", column ", *words]:
        assert word in str(raised.value)


def test_unknown_quality_and_broken_yaml(folder: Path) -> None:
    with pytest.raises(ConfigurationError, match=r"QUALITY=best.*smoke"):
        load_plan("best")
    (folder / "paper.yaml").write_text("panels: [")
    with pytest.raises(ConfigurationError, match=r"paper\.yaml is not valid YAML"):
        load_plan("smoke", folder)


def test_units_of_options_are_part_of_a_panels_configuration(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its table states them, and nothing else that it is drawn from does."""
    panels = load_plan("smoke")
    before = {name: panel.hash() for name, panel in panels.items()}
    units = option_units() | {"cell-length": "energy"}
    monkeypatch.setattr(plan, "option_units", lambda: units)
    changed = {name for name, panel in panels.items() if panel.hash() != before[name]}
    assert changed == {
        name for name, panel in panels.items() if any("cell-length" in run.options for run in panel.runs)
    }
    assert "fig01" in changed
    assert "fig03" not in changed
