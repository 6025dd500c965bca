"""CPU seconds of runs: recorded by the programs, or estimated from config/seconds.csv, or measured with two replicas.

The table has the effort (replicas times simulated time), the CPU seconds and the error of the target quantity of one execution per
panel, series and size. workflow/cluster/seconds.py writes it from the results of a quality.
"""

import csv
import heapq
import json
import math
import os
import subprocess
import tempfile
from dataclasses import replace
from datetime import timedelta
from functools import cache
from pathlib import Path

from workflow.cluster.batches import divide, seconds_of_batches
from workflow.lib.command import command
from workflow.lib.configuration import Options
from workflow.lib.files import ROOT
from workflow.lib.plan import QUALITIES, Run, data_path, load_plan
from workflow.lib.polynomial import at_size
from workflow.lib.program import command_line
from workflow.provenance.build_id import BuildError

TABLE = ROOT / "workflow/config/seconds.csv"  # panel, series, cells, effort, cpu_seconds
UNKNOWN = 900.0  # seconds assumed by the jobs of a cluster for a series that is not in the table
PILOT, PILOT_SECONDS = 2, 20  # replicas of a trial execution, and its time limit in seconds
LEAST = 64  # replicas that a target error needs (cpp/program/stopping_rule.hpp)
DRAWING = 4.0  # CPU seconds of rendering a panel
PARTS = "build/parts"  # folder of the parts of runs on a cluster: PARTS/<quality>/<panel>/<run>.<identity>/


def seconds_spent(quality: str, panel: str, run: Run) -> float | None:
    """CPU seconds recorded for the planned result of a run; None without one, or without a build."""
    try:
        return recorded_seconds(data_path(quality, panel, run))
    except BuildError:
        return None


def recorded_seconds(path: str) -> float | None:
    """CPU seconds of the execution that wrote a result, or of all joined parts; None if not recorded."""
    stem = path.removesuffix(".h5")
    try:
        own = _cost(ROOT / f"{stem}.cost.json")
        parts = [_cost(path) for path in (ROOT / PARTS / stem.removeprefix("data/")).glob("*.cost.json")]
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
    """CPU seconds from the table; None if the series is not in it, or has no error there and the run has a target."""
    rate = _at_size(panel, run, "cpu_seconds")
    replicas = expected_replicas(panel, run)
    return None if rate is None or replicas is None else replicas * effort(run.options) * rate


def expected_replicas(panel: str, run: Run) -> float | None:
    """Number of replicas, 1 without them; with a target error, the number at which the upper bound of the error reaches it [eq. 52];
    None if the error is unknown."""
    target = run.target
    if target is None or not run.replicated:
        return float(run.options.get("replicas", 1))
    unit = _at_size(panel, run, "error")  # error after one unit of effort
    if unit is None:
        return None
    replicas = (unit / target) ** 2 / effort(run.options)
    bound = 1 + 1.645 / math.sqrt(
        2 * max(replicas, LEAST)
    )  # upper bound of a standard error over its estimate
    return max(LEAST, replicas * bound**2)


_plan = cache(load_plan)  # read for many runs


def scaled_seconds(panel: str, run: Run) -> float | None:
    """CPU seconds scaled from a recorded execution at another quality; None without one, or with a target error."""
    for quality in QUALITIES if run.target is None else ():
        for other in (candidate for candidate in _plan(quality)[panel].runs if candidate.name == run.name):
            if seconds := seconds_spent(quality, panel, other):
                replicas = float(run.options.get("replicas", 1)) / float(other.options.get("replicas", 1))
                return seconds * replicas * effort(run.options) / effort(other.options)
    return None


def pilot_seconds(run: Run) -> float | None:
    """CPU seconds of a run, from an execution of two replicas; None if these take too long, or with a target error."""
    if run.target is not None:
        return None
    replicas = float(run.options.get("replicas", 1))
    few = {"replicas": min(PILOT, replicas)} if run.replicated else {}
    words = command_line(replace(run, options=run.options | few), ROOT / "build/bin")
    with tempfile.TemporaryDirectory() as folder:
        output = f"{folder}/pilot.h5"
        try:
            subprocess.run(
                [*words, "--output", output], capture_output=True, timeout=PILOT_SECONDS, check=False
            )
            return _cost(Path(folder) / "pilot.cost.json")[0] * replicas / float(few.get("replicas", 1))
        except (subprocess.TimeoutExpired, OSError, ValueError, KeyError):
            return None


@cache
def _table() -> dict[tuple[str, str], list[dict[str, float]]]:
    """Rows of the table by panel and series, with CPU seconds and error per unit of effort. The error is inversely proportional to the
    root of the effort."""
    table: dict[tuple[str, str], list[dict[str, float]]] = {}
    with TABLE.open(newline="") as file:
        for row in csv.DictReader(file):
            size, effort, seconds = (float(row[name]) for name in ("cells", "effort", "cpu_seconds"))
            of_a_unit = {"cells": size, "cpu_seconds": seconds / effort}
            if row["error"]:
                of_a_unit["error"] = float(row["error"]) * math.sqrt(effort)
            table.setdefault((row["panel"], row["series"]), []).append(of_a_unit)
    return table


def _at_size(panel: str, run: Run, name: str) -> float | None:
    """A column of the table, by a power law through the nearest two sizes; None if the series has too few."""
    size = cells(run.options)
    known = {row["cells"]: row[name] for row in _table().get((panel, run.series), []) if row.get(name)}
    if size in known:
        return known[size]
    if len(known) < 2:
        return None
    near, second = sorted(known, key=lambda candidate: abs(math.log(candidate / size)))[:2]
    power = math.log(known[second] / known[near]) / math.log(second / near)
    return float(known[near] * (size / near) ** power)


def cells(options: Options) -> float:
    """Number of cells; 1 in the continuum and for options without cells."""
    number = options.get("cells", 1)
    return 1 if number == "continuum" else float(number)


def effort(options: Options) -> float:
    """Pairs per replica times simulated time of a replica."""
    last = str(options.get("observation-time", options.get("times", 1))).rpartition(",")[2]
    times = (last, options.get("relaxation-time", 0))
    return float(options.get("pairs-per-replica", 1)) * sum(at_size(time, cells(options)) for time in times)


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
    unknown = 0
    print(f"{'panel':<18}{'CPU time, h:m:s':>17}  from")
    for panel in panels:
        recorded = [seconds_spent(options.quality, panel.name, run) for run in panel.runs]
        seconds = [
            recorded_value
            or estimated_seconds(panel.name, run)
            or scaled_seconds(panel.name, run)
            or pilot_seconds(run)
            for recorded_value, run in zip(recorded, panel.runs, strict=True)
        ]
        estimates = [value for value in seconds if value is not None]
        unknown += len(seconds) - len(estimates)
        jobs += [*estimates, DRAWING]
        source = (
            f"{len(seconds) - recorded.count(None)} of {len(seconds)} runs recorded, the others estimated"
        )
        source += f", {len(seconds) - len(estimates)} unknown" if len(estimates) < len(seconds) else ""
        print(f"{panel.name:<18}{wall([*estimates, DRAWING], 1)!s:>17}  {source}")
    cores = os.cpu_count() or 1
    more = f", and {unknown} runs of unknown cost" if unknown else ""
    print(f"CPU time: {wall(jobs, 1)}{more}. Wall time on {cores} cores here: {wall(jobs, cores)}")
    if options.batch:
        batches = seconds_of_batches(divide(panels, 60 * options.batch, seconds_of_run))
        times = ", ".join(f"{wall(batches, cores)} on {cores}" for cores in (100, 1000, 10000))
        print(f"On a cluster: {len(batches)} jobs, {times} cores")


if __name__ == "__main__":
    main()
