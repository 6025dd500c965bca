"""Division of the replicas of all runs among the jobs of a cluster.

A run that takes longer than a batch is split into parts of equal size; shorter runs share a batch. The division depends on the plan
and on estimated seconds alone, so that every process on every machine gets the same one.
"""

import itertools
import math
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from workflow.lib.plan import STOPPING, Panel, Run

OVERHEAD = 2  # seconds of a part besides its work: start of Snakemake


@dataclass(frozen=True)
class Part:
    """Consecutive replicas of a run. Parts of one batch follow each other in one job."""

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
    """Parts by `panel/run`, of the runs that can be split. batch: seconds of a job; seconds: of a run."""
    division: dict[str, list[Part]] = {}
    numbers = itertools.count()
    shared, used = next(numbers), 0.0  # the batch of short runs that is being filled
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
    """The number of replicas of a run with a target error is not known beforehand."""
    return run.replicated and not any(name in run.options for name in STOPPING)


def seconds_of_batches(parts: Iterable[Part]) -> list[float]:
    seconds: Counter[int] = Counter()
    for part in parts:
        seconds[part.batch] += part.seconds  # type: ignore[assignment]
    return list(seconds.values())
