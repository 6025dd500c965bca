"""What make cost foretells, against what was measured, and what it says where it knows nothing."""

import math
from dataclasses import replace
from pathlib import Path

import pytest

from workflow.lib.plan import QUALITIES, Panel, Run, load_plan
from workflow.tradeoff import forecast
from workflow.tradeoff.forecast import SPREAD, Forecast, between, total, wall
from workflow.tradeoff.timings import Timings, UnknownCostError, at_size, read_timings

TIMINGS = read_timings()
# The kinetic equation follows no power of its size; all the sizes that it has at any quality are in the table.
SIMULATED = {key: known for key, known in TIMINGS.units.items() if key[1] != "mean-field"}
SIZES = [(key, size) for key, known in SIMULATED.items() if len(known) > 2 for size in known]
# CPU seconds of whole runs of quality standard on the machine of the table, which its short measurements do not contain; those
# of ext11 from another machine, by what dense_cells=64 of ext09 takes on both.
EXECUTED = {
    "fig05": {"dense_sigma=0.75": 1.50, "paper_sigma=0.5": 0.34},
    "fig07_inset": {"all_sigma=0.3": 0.78, "zero-momentum_sigma=0.75": 0.84},
    "fig08": {"deterministic_cells=16": 1.29, "deterministic_cells=128": 7.27, "large": 29.4, "rare_cells=512": 10.5},
    "ext09": {"dense_cells=64": 6.21, "dense_cells=256": 27.0, "dilute_cells=128": 11.1},
    "ext11": {"dense-pressure_cells=16": 5.85, "thinning-temperature_cells=64": 15.5},
    "ext12": {"dense-weak_cells=64": 5.67, "dense-strong_cells=64": 6.16},
}  # fmt: skip


@pytest.mark.parametrize("quality", QUALITIES)
def test_everything_is_foretold(quality: str) -> None:
    for panel in load_plan(quality).values():
        for run in panel.runs:
            assert 0 < TIMINGS.foretell(panel.name, run) < math.inf


@pytest.mark.parametrize("panel", EXECUTED)
def test_foretold_against_executed(panel: str) -> None:
    plan = load_plan("standard")[panel]
    for name, seconds in EXECUTED[panel].items():
        foretold = TIMINGS.foretell(panel, plan.run(name))
        assert 1 / SPREAD < foretold / seconds < SPREAD, name


@pytest.mark.parametrize(("key", "size"), SIZES)
def test_a_size_is_foretold_by_the_others(key: tuple[str, str], size: float) -> None:
    known = TIMINGS.units[key]
    others = {one: unit for one, unit in known.items() if one != size}
    assert 1 / SPREAD < at_size(others, size) / known[size] < SPREAD


def test_what_is_unknown_is_said() -> None:
    run = replace(load_plan("smoke")["fig05"].runs[0], series="mine")
    with pytest.raises(
        UnknownCostError, match=r"fig05, series mine: .* make panel PANEL=fig05 QUALITY=smoke"
    ):
        TIMINGS.foretell("fig05", run)


def test_an_execution_here_that_tells_more_is_used(monkeypatch: pytest.MonkeyPatch) -> None:
    timings = Timings(1, {("fig05", "mine"): {11: 2.0}})
    run = Run("mine", "persistence", {"cells": 11, "replicas": 3, "observation-time": 5}, series="mine")
    here = Forecast(timings, (2, 3), 0)
    known = {"executed": (math.nan, math.nan)}
    monkeypatch.setattr(forecast, "expected_cost", lambda *_: known["executed"])
    foretold, own = here.cost("fig05", run)
    assert (foretold, own) == ((60 / SPREAD, 90 * SPREAD), False)
    known["executed"] = (40, 42)
    assert here.cost("fig05", run) == ((40, 42), True)
    known["executed"] = (10, 1000)
    assert here.cost("fig05", run) == (foretold, False)
    known["executed"] = (math.nan, math.nan)
    with pytest.raises(UnknownCostError):
        here.cost("fig06", run)


def test_wall_time_is_not_less_than_the_longest_run() -> None:
    runs = tuple(Run(name, "persistence", {}) for name in ("short", "long"))
    plan = {"one": Panel("one", "one", runs)}
    costs = {("one", "short"): (1.0, 2.0), ("one", "long"): (10.0, 20.0)}
    assert wall(costs, plan, (1.0, 2.0), 1) == (12, 24)
    assert wall(costs, plan, (1.0, 2.0), 2) == (10, 22)
    assert wall(costs, plan, (1.0, 2.0), 8) == (2.5, 3 + 5 * 7 / 8)  # four threads for each
    assert total([]) == (0, 0)


@pytest.mark.parametrize(
    ("seconds", "text"),
    [((0.5, 0.5), "0.5 s"), ((90, 130), "90 s to 2.2 min"), ((7200, 200000), "2 h to 2.3 d")],
)
def test_durations(seconds: tuple[float, float], text: str) -> None:
    assert between(seconds) == text


@pytest.mark.parametrize(
    "content", [b"garbage\n", b"", b"panel,series,cells,effort,cpu_seconds\nfig05,a,1,0,2\n", b"\xff,\n"]
)
def test_a_damaged_table_is_told_in_one_line(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "timings.csv"
    path.write_bytes(content)
    with pytest.raises(OSError, match=r"damaged; take it from the repository again"):
        read_timings(path)
