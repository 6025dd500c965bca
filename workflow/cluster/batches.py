"""Batches of replicas for the jobs of a cluster.

A run that takes longer than a batch is split into equal parts; shorter runs are combined. The division depends only on the plan and
on estimated times, so that all processes agree on it.
"""

import itertools
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from workflow.lib.plan import STOPPING, Panel, Run

OVERHEAD = 5  # seconds per part for the start of Snakemake


@dataclass(frozen=True)
class Part:
    """Consecutive replicas of a run. One job executes the parts of one batch in sequence."""

    batch: int
    first: int
    last: int
    seconds: float

    @property
    def name(self) -> str:
        return f"batch{self.batch}_{self.first}-{self.last}"


def divide(
    panels: Iterable[Panel], batch: float, seconds: Callable[[str, Run], float]
) -> dict[str, list[Part]]:
    """Parts by `panel/run` of the runs that can be split. batch: seconds per job; seconds: function for a run."""
    division: dict[str, list[Part]] = {}
    numbers = itertools.count()
    shared, used = next(numbers), 0.0  # current batch of short runs
    for panel in panels:
        for run in filter(can_be_split, panel.runs):
            replicas, whole = int(run.options["replicas"]), seconds(panel.name, run)
            count = min(math.ceil(whole / batch), replicas)
            cost = OVERHEAD + whole / count
            if count == 1:
                if used and used + cost > batch:
                    shared, used = next(numbers), 0.0
                used += cost
            edges = [replicas * part // count for part in range(count + 1)]
            division[f"{panel.name}/{run.name}"] = [
                Part(shared if count == 1 else next(numbers), first, end - 1, cost)
                for first, end in itertools.pairwise(edges)
            ]
    return division


def can_be_split(run: Run) -> bool:
    """Whether the number of replicas is known in advance: not with a target error."""
    return run.replicated and not any(name in run.options for name in STOPPING)


def seconds_of_batches(division: dict[str, list[Part]]) -> list[float]:
    seconds: dict[int, float] = {}
    for part in itertools.chain.from_iterable(division.values()):
        seconds[part.batch] = seconds.get(part.batch, 0.0) + part.seconds
    return [*seconds.values()]
