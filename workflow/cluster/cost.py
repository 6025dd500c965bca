"""CPU seconds of runs: recorded by the programs, or estimated from config/seconds.csv.

The table has the effort (replicas times simulated time) and the CPU seconds of one execution per panel, series and size.
"""

import csv
import heapq
import json
import math
import os
from datetime import timedelta
from functools import cache
from pathlib import Path

from workflow.cluster.batches import divide, seconds_of_batches
from workflow.lib.command import command
from workflow.lib.configuration import Options, at_size
from workflow.lib.files import ROOT
from workflow.lib.plan import QUALITIES, Run, data_path, load_plan

TABLE = ROOT / "workflow/config/seconds.csv"  # panel, series, cells, effort, cpu_seconds
UNKNOWN = 900.0  # seconds assumed for a series that is not in the table
DRAWING = 4.0  # CPU seconds of rendering a panel
PARTS = "build/parts"  # of runs on a cluster: PARTS/<quality>/<panel>/<run>.<identity>/


def recorded_seconds(path: str) -> float | None:
    """CPU seconds of the execution that wrote a result, or of all joined parts; None if not recorded."""
    stem = path.removesuffix(".h5")
    try:
        own = _cost(ROOT / f"{stem}.cost.json")
        parts = [_cost(one) for one in (ROOT / PARTS / stem.removeprefix("data/")).glob("*.cost.json")]
    except (OSError, ValueError, KeyError, TypeError):
        return None
    # The cost of joining is negligible.
    joined = sum(seconds for seconds, _ in parts) if sum(events for _, events in parts) == own[1] else 0.0
    return max(own[0], joined)


def _cost(path: Path) -> tuple[float, int]:
    cost = json.loads(path.read_text())
    return float(cost["cpu_seconds"]), int(cost["events"])


def seconds_of_run(panel: str, run: Run) -> int:
    """Estimated CPU seconds, at least 1. Recorded times are ignored, as all machines of a cluster have to agree."""
    return max(1, round(estimated_seconds(panel, run) or UNKNOWN))


def estimated_seconds(panel: str, run: Run) -> float | None:
    """CPU seconds from the table, by a power law through the nearest two sizes; None if the series is not in it."""
    known, size = _table().get((panel, run.series), {}), cells(run.options)
    if size in known:
        return effort(run.options) * known[size]
    if len(known) < 2:
        return None
    near, next_to_it = sorted(known, key=lambda one: abs(math.log(one / size)))[:2]
    power = math.log(known[next_to_it] / known[near]) / math.log(next_to_it / near)
    return effort(run.options) * float(known[near] * (size / near) ** power)


def scaled_seconds(panel: str, run: Run) -> float | None:
    """CPU seconds scaled from a recorded execution at another quality; None without one."""
    for quality in QUALITIES:
        for other in (one for one in load_plan(quality)[panel].runs if one.name == run.name):
            if seconds := recorded_seconds(data_path(quality, panel, other)):
                return seconds * effort(run.options) / effort(other.options)
    return None


@cache
def _table() -> dict[tuple[str, str], dict[float, float]]:
    """CPU seconds per unit of effort, by panel and series, and size."""
    table: dict[tuple[str, str], dict[float, float]] = {}
    with TABLE.open(newline="") as file:
        for row in csv.DictReader(file):
            series = table.setdefault((row["panel"], row["series"]), {})
            series[float(row["cells"])] = float(row["cpu_seconds"]) / float(row["effort"])
    return table


def cells(options: Options) -> float:
    """Number of cells; 1 in the continuum and for options without cells."""
    number = options.get("cells", 1)
    return 1 if number == "continuum" else float(number)


def effort(options: Options) -> float:
    """Replicas times pairs per replica times simulated time."""
    last = str(options.get("observation-time", options.get("times", 1))).rpartition(",")[2]
    replicas = float(options.get("replicas", 1)) * float(options.get("pairs-per-replica", 1))
    return replicas * sum(at_size(time, cells(options)) for time in (last, options.get("relaxation-time", 0)))


def wall(jobs: list[float], cores: int) -> timedelta:
    """Wall time of the jobs on a number of cores, longest first."""
    ends = [0.0] * cores
    for seconds in sorted(jobs, reverse=True):
        heapq.heapreplace(ends, ends[0] + seconds)
    return timedelta(seconds=round(max(ends)))


def main() -> None:
    batch = {"type": float, "help": "minutes per job on a cluster"}
    options, _, panels = command(__doc__, batch=batch)
    jobs: list[float] = []
    for panel in panels:
        recorded = [recorded_seconds(data_path(options.quality, panel.name, run)) for run in panel.runs]
        seconds = [
            known or estimated_seconds(panel.name, run) or scaled_seconds(panel.name, run) or UNKNOWN
            for known, run in zip(recorded, panel.runs, strict=True)
        ]
        jobs += [*seconds, DRAWING]
        source = f"{len(seconds) - recorded.count(None)} of {len(seconds)} runs recorded"
        print(f"{panel.name:<18}{wall([*seconds, DRAWING], 1)!s:>17}  {source}")
    cores = os.cpu_count() or 1
    print(f"CPU time: {wall(jobs, 1)}. Wall time on {cores} cores here: {wall(jobs, cores)}")
    if options.batch:
        batches = seconds_of_batches(divide(panels, 60 * options.batch, seconds_of_run))
        times = ", ".join(f"{wall(batches, cores)} on {cores}" for cores in (100, 1000, 10000))
        print(f"On a cluster: {len(batches)} jobs, {times} cores")


if __name__ == "__main__":
    main()
