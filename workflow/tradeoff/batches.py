"""How the runs of a quality are divided among the jobs of a cluster.

A run that takes longer than a batch is split into parts, which are joined; shorter ones share a job. The timings that are
shipped decide, so that every process on every machine gets the same answer, whatever has been executed meanwhile.
"""

import heapq
import itertools
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from workflow.lib.plan import STOPPING, Panel, Run
from workflow.tradeoff.timings import Timings, UnknownCostError

UNKNOWN = 900.0  # seconds that are allowed for a run of which nothing is known
BESIDE = 2.0  # seconds that a job takes beside its work: start of Snakemake's and our Python, hashes


@dataclass(frozen=True)
class Batches:
    """Jobs are named `panel/run`. parts: first and last replica of each part, as 0-23. groups: of the runs that are not
    split, the name that those of one job share. seconds: foretold CPU seconds of a run, of a part if it is split."""

    parts: dict[str, tuple[str, ...]]
    groups: dict[str, str]
    seconds: dict[str, float]

    def jobs(self) -> list[float]:
        """Seconds of every job of the cluster."""
        shared: dict[str, float] = {}
        for job, group in self.groups.items():
            shared[group] = shared.get(group, 0.0) + self.seconds[job]
        split = (self.seconds[job] for job, parts in self.parts.items() for _ in parts)
        return [*shared.values(), *split]


def wall(jobs: Iterable[float], cores: int) -> float:
    """Seconds until all are done on so many cores, the longest first; without time in the queue."""
    ends = [0.0] * cores
    for seconds in sorted(jobs, reverse=True):
        heapq.heapreplace(ends, ends[0] + seconds)
    return max(ends)


def divide(plan: Mapping[str, Panel], batch: float, timings: Timings) -> Batches:
    """batch: seconds that a job is to take."""
    parts: dict[str, tuple[str, ...]] = {}
    groups: dict[str, str] = {}
    seconds: dict[str, float] = {}
    used, group = 0.0, 0
    for panel in plan.values():
        for run in panel.runs:
            job, cost = f"{panel.name}/{run.name}", _cost(panel.name, run, batch, timings)
            number = max(1, min(math.ceil(cost / batch), _replicas(run)))
            seconds[job] = BESIDE + cost / number
            if number > 1:
                parts[job] = ranges(_replicas(run), number)
                continue
            if used + seconds[job] > batch:
                used, group = 0.0, group + 1
            used += seconds[job]
            groups[job] = f"batch{group}"
    return Batches(parts, groups, seconds)


def ranges(replicas: int, number: int) -> tuple[str, ...]:
    """Parts whose sizes differ by one at most."""
    edges = [replicas * part // number for part in range(number + 1)]
    return tuple(f"{first}-{end - 1}" for first, end in itertools.pairwise(edges))


def _cost(panel: str, run: Run, batch: float, timings: Timings) -> float:
    """Of a run of which nothing is known, so much that few share its job."""
    try:
        return timings.foretell(panel, run)
    except UnknownCostError:
        return min(batch / 2, UNKNOWN)


def _replicas(run: Run) -> int:
    """Into how many parts the run can be split; the number of replicas of a run with a target is not known before."""
    splittable = run.replicated and not any(name in run.options for name in STOPPING)
    return int(run.options["replicas"]) if splittable else 1
