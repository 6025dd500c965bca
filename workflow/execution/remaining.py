"""How long jobs will still take, from what they are foretold to cost and from what the finished ones took."""

import math
from collections.abc import Iterable, Mapping

from workflow.lib.costs import cheapest
from workflow.lib.plan import Panel
from workflow.tradeoff.forecast import DRAWING, Forecast
from workflow.tradeoff.timings import UnknownCostError, read_timings

BESIDE = 0.4  # seconds that a job takes beside its work: start of Python, hashes, scheduler


def foretold(plan: Mapping[str, Panel], jobs: Iterable[str]) -> dict[str, float]:
    """Core seconds of every job, `panel/run` or `panel`, on a machine like that of the shipped timings; of a run of which
    nothing is known, as if it took none."""
    forecast = Forecast(read_timings(), (1.0, 1.0), cheapest())
    costs = {}
    for job in jobs:
        panel, _, run = job.partition("/")
        costs[job] = BESIDE + DRAWING
        if run:
            try:
                (least, most), _ = forecast.cost(panel, plan[panel].run(run))
            except UnknownCostError:
                least = most = 0.0
            costs[job] = BESIDE + math.sqrt(least * most)
    return costs


class Remaining:
    """costs: foretold core seconds by job; what was foretold is corrected by what finished jobs took."""

    def __init__(self, costs: Mapping[str, float], cores: int) -> None:
        self._left = dict(costs)
        self._cores = cores
        self._foretold = self._taken = 0.0

    def finish(self, job: str, core_seconds: float) -> None:
        self._foretold += self._left.pop(job, 0.0)
        self._taken += core_seconds

    def seconds(self, running: Mapping[str, tuple[float, int]]) -> float:
        """Wall time until all is done. running: seconds since the start, and threads, by job."""
        speed = self._taken / self._foretold if self._foretold else 1.0
        left = {job: cost * speed for job, cost in self._left.items()}
        for job, (elapsed, threads) in running.items():
            left[job] = max(left.get(job, 0.0) - elapsed * threads, 0.0)
        longest = max((left[job] / threads for job, (_, threads) in running.items()), default=0.0)
        return max(sum(left.values()) / self._cores, longest)


def clock(seconds: float) -> str:
    """0:20, or 1:02:03 with hours."""
    minutes, rest = divmod(math.ceil(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
