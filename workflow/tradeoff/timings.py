"""What a unit of effort costs, by panel, series and size: the table that is shipped, and how it is measured anew.

What has been executed here is taken from there; the rest is executed for a moment.
"""

import argparse
import csv
import math
import statistics
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from workflow.lib.configuration import FOLDER, ConfigurationError, Options
from workflow.lib.costs import cells, effort, executions
from workflow.lib.plan import Run, load_plan
from workflow.tradeoff.measure import execute, planned, shortened

TABLE = FOLDER / "timings.csv"
COLUMNS = ("panel", "series", "cells", "effort", "cpu_seconds")
REFERENCE = "reference"  # in place of a panel: the run by which machines are compared
REPETITIONS = 3
QUALITY = "paper"  # which has every series
REPLICAS = 2  # the least that has errors
SECONDS = 0.2  # that an execution takes, so that the start of a process does not count
SHARE = 1 / 20  # of a window, where the chain costs the same from its start on


class UnknownCostError(LookupError):
    """The table says nothing of a series."""


@dataclass(frozen=True)
class Timings:
    reference: float  # CPU seconds of the reference
    units: dict[tuple[str, str], dict[float, float]]  # panel and series, size: CPU seconds per unit of effort

    def foretell(self, panel: str, run: Run) -> float:
        """CPU seconds on the machine of the table. Raises UnknownCostError."""
        known, size = self.units.get((panel, run.series), {}), cells(run.options)
        if not known or (len(known) == 1 and size not in known):
            raise UnknownCostError(
                f"{panel}, series {run.series}: nothing is known of its cost at {size:g} cells; try "
                f"make panel PANEL={panel} QUALITY=smoke, from which it follows"
            )
        return effort(run.options) * at_size(known, size)


def at_size(known: dict[float, float], size: float) -> float:
    """By the power law through the nearest two sizes, if the size itself is not known."""
    if size in known:
        return known[size]
    near, next_to_it = sorted(known, key=lambda one: abs(math.log(one / size)))[:2]
    power = math.log(known[next_to_it] / known[near]) / math.log(next_to_it / near)
    return float(known[near] * (size / near) ** power)


def read_timings(path: Path = TABLE) -> Timings:
    """Raises ConfigurationError, OSError."""
    try:
        return _timings(path)
    except (ValueError, KeyError, TypeError, ArithmeticError, csv.Error) as error:
        raise ConfigurationError(f"{path} is damaged: {error}") from error


def _timings(path: Path) -> Timings:
    units: dict[tuple[str, str], dict[float, float]] = defaultdict(dict)
    with path.open(newline="") as file:
        for row in csv.DictReader(file):
            unit = float(row["cpu_seconds"]) / float(row["effort"])
            units[row["panel"], row["series"]][float(row["cells"])] = unit
    reference = units.pop((REFERENCE, ""))
    return Timings(reference[1], dict(units))


def reference_seconds(programs: Path) -> list[float]:
    """CPU seconds of a run that takes a third of a second, again and again."""
    run = planned("fig08", "deterministic_cells=16")
    return [execute(programs, run, replicas=12)[1] for _ in range(REPETITIONS)]


def measured(programs: Path, panel: str, run: Run) -> tuple[float, float]:
    """Effort and CPU seconds of the longest execution that there was here, or else of a short one."""
    known = [(effort(options), seconds) for options, seconds in executions(panel, run)]
    if known:
        return max(known)
    if not run.replicated:
        return effort(run.options), execute(programs, run)[1]
    changes: Options = {"replicas": REPLICAS}
    if run.options.get("start", "empty") != "empty":
        windows = ("relaxation-time", "observation-time")
        changes |= {key: shortened(run.options[key], SHARE) for key in windows}
    seconds = execute(programs, run, **changes)[1]
    if seconds < SECONDS:
        changes["replicas"] *= math.ceil(SECONDS / seconds)
        seconds = execute(programs, run, **changes)[1]
    return effort(run.options | changes), seconds


def rows(programs: Path) -> Iterable[tuple[object, ...]]:
    """Those of a size are added up: other values than the size occur at every quality alike."""
    yield REFERENCE, "", 1, 1, statistics.median(reference_seconds(programs))
    for name, panel in load_plan(QUALITY).items():
        sums: dict[tuple[str, float], list[tuple[float, float]]] = defaultdict(list)
        for run in panel.runs:
            sums[run.series, cells(run.options)].append(measured(programs, name, run))
        for (series, size), costs in sums.items():
            yield name, series, size, *map(math.fsum, zip(*costs, strict=True))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", type=Path, required=True, help="folder of the executables")
    measurements = [COLUMNS, *rows(parser.parse_args().programs)]
    with TABLE.open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        for row in measurements:
            table.writerow(f"{one:.6g}" if isinstance(one, float) else one for one in row)
    print(f"{len(measurements) - 1} timings are in {TABLE}")


if __name__ == "__main__":
    main()
