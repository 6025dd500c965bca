"""Costs: recorded seconds, estimates against executions, division of runs among the jobs of a cluster."""

import itertools
import json
from collections import Counter
from dataclasses import replace
from datetime import timedelta
from pathlib import Path

import pytest
from workflow.cluster import cost
from workflow.cluster.batches import OVERHEAD, divide, seconds_of_batches
from workflow.cluster.cost import (
    effort,
    estimated_seconds,
    recorded_seconds,
    scaled_seconds,
    seconds_of_run,
    wall,
)

from workflow.plan import QUALITIES, Panel, Run, load_plan

TOLERANCE = 1.5  # allowed ratio of an estimated to a measured time, over sizes, replicas and windows
# CPU seconds of whole runs of quality standard, on the machine of the table.
EXECUTED = {
    "fig05": {"dense_sigma=0.75": 0.531, "paper_sigma=0.5": 0.210},
    "fig07_inset": {"all_sigma=0.3": 0.493, "zero-momentum_sigma=0.75": 0.499},
    "fig08": {"deterministic_cells=16": 0.767, "deterministic_cells=128": 4.32},
    "ext09": {"dense_cells=64": 2.92, "thinning_cells=128": 4.52},
    "ext11": {"dense-temperature_cells=16": 2.29, "dense-temperature_cells=64": 8.08},
    "ext12": {"dense-weak_cells=64": 2.32, "dense-strong_cells=64": 2.53},
    "ext13": {"light": 3.32, "light-long": 5.00},
}


@pytest.mark.parametrize("panel", EXECUTED)
def test_estimates_against_executions(panel: str) -> None:
    plan = load_plan("standard")[panel]
    for name, seconds in EXECUTED[panel].items():
        assert 1 / TOLERANCE < (estimated_seconds(panel, plan.run(name)) or 0) / seconds < TOLERANCE, name


@pytest.mark.parametrize("quality", QUALITIES)
def test_runs_of_the_table_have_estimates(quality: str) -> None:
    """Panels that are not in the table, such as those of a user, are ignored."""
    listed = {panel for panel, _ in cost._table()}
    runs = [(name, run) for name, panel in load_plan(quality).items() if name in listed for run in panel.runs]
    assert len(listed) > 20
    assert all(estimated_seconds(name, run) for name, run in runs)


def test_every_sampled_run_of_the_table_has_an_error() -> None:
    """The option ERROR needs the errors of the runs of the default quality."""
    listed = {panel for panel, _ in cost._table()}
    runs = [
        (name, run)
        for name, panel in load_plan("standard_error=0.01").items()
        if name in listed
        for run in panel.runs
    ]
    assert [f"{name}/{run.name}" for name, run in runs if not estimated_seconds(name, run)] == []


def test_a_target_error_needs_replicas_as_its_inverse_square() -> None:
    row = {"cells": 8.0, "cpu_seconds": 2.0, "error": 0.5}
    run = Run("a", "persistence", {"cells": 8, "observation-time": 10, "replicas": 16}, target=0.01)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cost, "_table", lambda: {("mine", ""): [row]})
        # 250 replicas have an error of 0.5/sqrt(2500) = 0.01; its upper bound is (1 + 1.645/sqrt(500)) times as large.
        assert cost.expected_replicas("mine", run) == pytest.approx(250 * (1 + 1.645 / 500**0.5) ** 2)
        assert estimated_seconds("mine", run) == pytest.approx(20 * 250 * (1 + 1.645 / 500**0.5) ** 2)
        assert cost.expected_replicas("mine", replace(run, target=1)) == cost.LEAST
        assert estimated_seconds("other", run) is None


def test_a_pilot_of_two_replicas() -> None:
    run = Run(
        "a",
        "persistence",
        {"cells": 8, "relaxation-time": 1, "observation-time": 50, "replicas": 40, "seed": 1},
    )
    few, many = (
        cost.pilot_seconds(replace(run, options=run.options | {"replicas": count})) for count in (20, 2000)
    )
    assert few
    assert many
    assert 30 < many / few < 300
    assert cost.pilot_seconds(replace(run, options=run.options | {"sigma": 2})) is None


def test_an_unknown_series(monkeypatch: pytest.MonkeyPatch) -> None:
    """The time of a series without a row in the table is scaled by effort from an execution at another quality."""
    run = load_plan("standard")["fig07"].runs[0]
    mine = replace(run, series="mine")
    assert estimated_seconds("fig07", mine) is None
    assert seconds_of_run("fig07", mine) == cost.UNKNOWN
    monkeypatch.setattr(cost, "recorded_seconds", lambda path: 2.0 if path.startswith("data/smoke") else None)
    few = load_plan("smoke")["fig07"].runs[0].options["replicas"]
    assert scaled_seconds("fig07", mine) == pytest.approx(2 * run.options["replicas"] / few)
    monkeypatch.setattr(cost, "recorded_seconds", lambda *_: None)
    assert scaled_seconds("fig07", mine) is None


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"cells": "continuum"}, 1),
        ({"cells": 20, "replicas": 3, "observation-time": 10, "relaxation-time": "5+0.05N"}, 16),
        ({"replicas": 2, "pairs-per-replica": 4, "times": "0.1,0.5"}, 2),
    ],
)
def test_effort(options: dict, expected: float) -> None:
    assert effort(options) == pytest.approx(expected)


def test_recorded_seconds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Seconds of the parts count if their events are those of the result; parts of other options do not count."""
    monkeypatch.setattr(cost, "ROOT", tmp_path)

    def record(path: str, seconds: float, events: int) -> None:
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(json.dumps({"cpu_seconds": seconds, "events": events}))

    path = "data/smoke/fig05/a.012345678901.h5"
    assert recorded_seconds(path) is None
    record("data/smoke/fig05/a.012345678901.cost.json", 0.1, 30)
    record("build/parts/smoke/fig05/a.ffffffffffff/batch0_0-3.part.cost.json", 9.0, 30)
    assert recorded_seconds(path) == 0.1
    record("build/parts/smoke/fig05/a.012345678901/batch0_0-1.part.cost.json", 2.0, 10)
    assert recorded_seconds(path) == 0.1
    record("build/parts/smoke/fig05/a.012345678901/batch1_2-3.part.cost.json", 3.0, 20)
    assert recorded_seconds(path) == 5.0
    (tmp_path / "data/smoke/fig05/a.012345678901.cost.json").write_text("{")
    assert recorded_seconds(path) is None


def test_wall_time() -> None:
    assert wall([3, 3, 2, 2, 2], 2) == timedelta(seconds=7)  # 3 + 2 + 2 beside 3 + 2; the best is 6
    assert wall([5, 1, 1], 100) == timedelta(seconds=5)
    assert wall([], 3) == timedelta(0)


@pytest.mark.parametrize("quality", ["smoke", "paper", "deep"])
@pytest.mark.parametrize("batch", [60.0, 1800.0])
def test_every_replica_is_in_one_part_and_batches_are_full(quality: str, batch: float) -> None:
    plan = load_plan(quality)
    division = divide(plan.values(), batch, seconds_of_run)
    runs = {
        f"{panel.name}/{run.name}": run for panel in plan.values() for run in panel.runs if run.replicated
    }
    assert division.keys() == runs.keys()
    for name, parts in division.items():
        assert [parts[0].first, parts[-1].last] == [0, runs[name].options["replicas"] - 1]
        assert all(part.last + 1 == following.first for part, following in itertools.pairwise(parts))
        sizes = [part.last - part.first + 1 for part in parts]
        assert max(sizes) - min(sizes) <= 1
        assert max(sizes) == 1 or parts[0].seconds <= batch + OVERHEAD
    every = [part for parts in division.values() for part in parts]
    together = Counter(part.batch for part in every)
    shared = Counter[int]()
    for part in every:
        shared[part.batch] += part.seconds  # type: ignore[assignment]
    assert sorted(seconds_of_batches(division)) == sorted(shared.values())
    assert all(shared[number] <= batch for number, parts in together.items() if parts > 1)
    assert divide(load_plan(quality).values(), batch, seconds_of_run) == division


@pytest.mark.parametrize(("options", "parts"), [({}, 10), ({"target-error": 0.1}, 0), ({"replicas": 4}, 4)])
def test_number_of_parts(options: dict, parts: int) -> None:
    """A run with a target error is not split: its number of replicas is not known beforehand."""
    run = Run("all", "persistence", {"replicas": 100, **options})
    assert len(divide([Panel("one", "one", (run,))], 100.0, lambda *_: 1000.0).get("one/all", ())) == parts
