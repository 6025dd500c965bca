"""Every replica of every run is measured once, in jobs of the length that was asked for."""

import itertools
import math
from collections import Counter
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from workflow.lib.plan import Panel, Run, load_plan
from workflow.tradeoff.batches import BESIDE, Batches, divide, ranges, wall
from workflow.tradeoff.timings import Timings, read_timings


@given(st.integers(1, 10**6), st.data())
def test_ranges_hold_every_replica_once(replicas: int, data: st.DataObject) -> None:
    number = data.draw(st.integers(1, min(replicas, 50)))
    edges = [tuple(map(int, one.split("-"))) for one in ranges(replicas, number)]
    assert len(edges) == number
    assert (edges[0][0], edges[-1][1]) == (0, replicas - 1)
    assert all(last + 1 == first for (_, last), (first, _) in itertools.pairwise(edges))
    sizes = [last - first + 1 for first, last in edges]
    assert max(sizes) - min(sizes) <= 1


@pytest.mark.parametrize("quality", ["smoke", "standard", "paper", "deep"])
@pytest.mark.parametrize("batch", [60.0, 1800.0])
def test_jobs_are_as_long_as_asked_for(quality: str, batch: float) -> None:
    """But for a single replica, which cannot be divided."""
    plan = load_plan(quality)
    batches = divide(plan, batch, read_timings())
    runs = {f"{panel.name}/{run.name}": run for panel in plan.values() for run in panel.runs}
    assert batches.parts.keys() | batches.groups.keys() == runs.keys()
    assert not batches.parts.keys() & batches.groups.keys()
    for job, parts in batches.parts.items():
        single = len(parts) == runs[job].options["replicas"]
        assert single or batches.seconds[job] <= batch + BESIDE
    lengths = Counter[str]()
    for job, group in batches.groups.items():
        lengths[group] += batches.seconds[job]
    alone = {group for group, number in Counter(batches.groups.values()).items() if number == 1}
    assert all(length <= batch for group, length in lengths.items() if group not in alone)
    neighbours = sorted(lengths, key=lambda group: int(group.removeprefix("batch")))
    both = [lengths[one] + lengths[next_one] for one, next_one in itertools.pairwise(neighbours)]
    assert all(length > batch for length in both)  # or they would share a job


def test_what_is_asked_twice_gets_the_same_answer() -> None:
    plan = load_plan("paper")
    assert divide(plan, 600.0, read_timings()) == divide(load_plan("paper"), 600.0, read_timings())


def test_a_run_with_a_target_is_not_split() -> None:
    """Nobody knows beforehand how many replicas it will have."""
    run = Run("all", "persistence", {"replicas": 100, "times": "1"}, series="all")
    timings = Timings(1.0, {("fig05", "all"): {1.0: 10.0}})
    for one, parts in ((run, 10), (replace(run, options={**run.options, "target-error": 0.1}), 0)):
        batches = divide({"fig05": Panel("fig05", "fig05", (one,))}, 100.0, timings)
        assert len(batches.parts.get("fig05/all", ())) == parts


def test_wall_time_of_jobs() -> None:
    assert wall([3, 3, 2, 2, 2], 2) == pytest.approx(7)  # 3 + 2 + 2 beside 3 + 2; the best is 6
    assert wall([5, 1, 1], 100) == 5
    assert wall([], 3) == 0
    batches = Batches(
        {"a/b": ("0-1", "2-3")}, {"c/d": "batch0", "c/e": "batch0"}, {"a/b": 4, "c/d": 1, "c/e": 2}
    )
    assert sorted(batches.jobs()) == [3, 4, 4]
    assert math.fsum(batches.jobs()) == 11
