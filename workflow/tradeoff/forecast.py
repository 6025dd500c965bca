"""What all of a quality would cost on this machine, without running it.

Runs that were executed here tell their cost at other replicas and times. For the others the timings that are shipped are
scaled by a run of a second on this machine. What is said is a range: of the comparison of the machines, and of how far
the timings are known to be off.
"""

import argparse
import math
import os
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table

from workflow.lib.caption import listed
from workflow.lib.configuration import ConfigurationError
from workflow.lib.costs import cheapest, expected_cost
from workflow.lib.plan import Panel, Run, load_plan, panel_named, with_used
from workflow.tradeoff.batches import Batches, divide
from workflow.tradeoff.batches import wall as wall_of_jobs
from workflow.tradeoff.timings import Timings, UnknownCostError, read_timings, reference_seconds

WIDE = 100  # columns, where nobody reads them on a screen
SPREAD = 1.5  # factor by which a series is off at most at other sizes, replicas and windows than were timed
DRAWING = 3.6  # CPU seconds of a drawing on the machine of the table, the start of its Python included

CLUSTERS = (1, 100, 1000, 10000)  # cores

Range = tuple[float, float]  # the least and the most


@dataclass(frozen=True)
class Forecast:
    """start: CPU seconds of an execution here that may be its start. speed: of this machine's CPU seconds over the table's."""

    timings: Timings
    speed: Range
    start: float

    def cost(self, panel: str, run: Run) -> tuple[Range, bool]:
        """CPU seconds, and whether from an execution here: whichever is known better."""
        own = expected_cost(panel, run, self.start)
        if spread(own) <= SPREAD**2 * spread(self.speed):
            return own, True
        try:
            return self.elsewhere(self.timings.foretell(panel, run)), False
        except UnknownCostError:
            if math.isnan(own[0]):
                raise
            return own, True

    def elsewhere(self, seconds: float) -> Range:
        """CPU seconds here of what takes so many on the machine of the table."""
        return seconds * self.speed[0] / SPREAD, seconds * self.speed[1] * SPREAD


def spread(one: Range) -> float:
    return one[1] / one[0]


def total(costs: Iterable[Range]) -> Range:
    least, most = zip((0.0, 0.0), *costs, strict=True)
    return math.fsum(least), math.fsum(most)


def wall(costs: dict[tuple[str, str], Range], plan: dict[str, Panel], drawings: Range, cores: int) -> Range:
    """Seconds on so many cores: no shorter than the longest run on the threads that it gets, and no longer than if
    that run starts when all else is done."""
    least, most = (one / cores for one in total([*costs.values(), drawings]))
    alone = [
        (cost[0] / threads, cost[1] / threads)
        for (panel, _), cost in costs.items()
        for threads in [max(1, cores // len(plan[panel].runs))]
    ]
    longest = max(alone, key=lambda one: one[1], default=(0.0, 0.0))
    return max(least, longest[0]), most + longest[1] * (1 - 1 / cores)


def duration(seconds: float) -> str:
    for unit, size in (("d", 86400), ("h", 3600), ("min", 60)):
        if seconds >= 2 * size:
            return f"{_two_digits(seconds / size)} {unit}"
    return f"{_two_digits(seconds)} s"


def _two_digits(number: float) -> str:
    return f"{number:.0f}" if number >= 10 else f"{number:.2g}"


def between(one: Range) -> str:
    least, most = map(duration, one)
    return least if least == most else f"{least} to {most}"


def forecast_of(name: str, programs: Path) -> Forecast:
    timings = read_timings()
    seconds = reference_seconds(programs)
    return Forecast(timings, (min(seconds) / timings.reference, max(seconds) / timings.reference), cheapest())


def show(quality: str, plan: dict[str, Panel], panels: Sequence[Panel], forecast: Forecast) -> Table:
    """Raises UnknownCostError."""
    result = Table("panel", "runs", "of these timed here", "CPU time", title=f"Quality {quality}")
    costs: dict[tuple[str, str], Range] = {}
    for panel in panels:
        found = {run.name: forecast.cost(panel.name, run) for run in panel.runs}
        costs |= {(panel.name, run): cost for run, (cost, _) in found.items()}
        known = sum(own for _, own in found.values())
        text = between(total(cost for cost, _ in found.values())) if found else f"with {listed(panel.uses)}"
        result.add_row(panel.name, str(len(found)), str(known), text)
    drawings = forecast.elsewhere(DRAWING * len(panels))
    result.add_row("drawing", str(len(panels)), "", between(drawings), end_section=True)
    result.add_row("all, CPU time", "", "", between(total([*costs.values(), drawings])))
    for cores in sorted({1, 2, os.cpu_count() or 1}):
        text = f"wall time on {cores} core{'s' if cores > 1 else ''}"
        result.add_row(text, "", "", between(wall(costs, plan, drawings, cores)))
    return result


def show_cluster(batches: Batches) -> Table:
    """On cores like that of the shipped timings."""
    jobs = batches.jobs()
    title = (
        f"On a cluster: {len(jobs)} jobs, CPU time {duration(sum(jobs))}, the longest {duration(max(jobs))}"
    )
    result = Table("cores", "wall time", "efficiency", title=title)
    for cores in CLUSTERS:
        seconds = wall_of_jobs(jobs, cores)
        result.add_row(str(cores), duration(seconds), f"{sum(jobs) / (cores * seconds):.0%}")
    return result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", type=Path, required=True, help="folder of the executables")
    parser.add_argument("--quality", required=True)
    parser.add_argument("--panel", help="only this one and those whose runs it shows")
    parser.add_argument("--batch", type=float, help="minutes that a job of a cluster is to take")
    options = parser.parse_args()
    try:
        plan = load_plan(options.quality)
        asked = panel_named(plan, options.panel).name if options.panel else None
        panels = with_used(plan, asked) if asked else list(plan.values())
        forecast = forecast_of(options.quality, options.programs)
        tables = [show(options.quality, plan, panels, forecast)]
        if options.batch:
            asked_for = {panel.name: panel for panel in panels}
            tables.append(show_cluster(divide(asked_for, 60 * options.batch, forecast.timings)))
    except (ConfigurationError, UnknownCostError) as error:
        print(f"make cost: {error}", file=sys.stderr)
        sys.exit(2)
    Console(width=None if sys.stdout.isatty() else WIDE).print(*tables)
    print(
        "A range holds what machines and timings leave open; other work on this machine comes on top. Runs that were timed here "
        "are foretold from what they took, others from a table of timings that is shipped."
    )


if __name__ == "__main__":
    main()
