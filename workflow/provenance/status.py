"""Prints for every panel whether it is fresh and if not why, its errors, what it cost and what it would cost."""

import argparse
import json
import math
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from workflow.config.plan import QUALITIES, ConfigurationError, Options, Panel, Run, data_path, load_plan
from workflow.provenance.repository import ROOT
from workflow.provenance.stale import Staleness
from workflow.scripts.load import FormatError, load

WIDE = 150  # columns, where nobody reads them on a screen


def cost_file(quality: str, panel: str, run: str) -> dict | None:
    """What the last execution of the run cost, as its sidecar says."""
    path = ROOT / f"build/costs/{quality}/{panel}/{run}.json"
    return json.loads(path.read_text()) if path.is_file() else None


def effort(options: Options) -> float:
    """Replicas, with their members, times the simulated time: what cost is proportional to, but for the start."""

    def simulated(time: str) -> float:
        return float(time.rstrip("N")) * (float(options["cells"]) if time.endswith("N") else 1)

    replicas = float(options.get("replicas", 1)) * float(options.get("members", 1))
    last = str(options.get("times", "")).rsplit(",", maxsplit=1)[-1] or options.get("observation-time", 1)
    return replicas * sum(simulated(str(time)) for time in (last, options.get("relaxation-time", 0)))


def executions(panel: str, run: str) -> Iterator[tuple[Options, float]]:
    """Options and CPU seconds of the last execution at every quality that has one; the plan may have changed since."""
    for quality in QUALITIES:
        cost = cost_file(quality, panel, run)
        with suppress(FormatError):
            parameters = load(ROOT / data_path(quality, panel, run)).parameters
            if cost is not None:
                yield parameters, cost["cpu_seconds"]


def scaled(cost: float, share: float, start: float) -> tuple[float, float]:
    """The least and the most that a run costs if up to `start` seconds of another's cost do not grow with the effort."""
    least, most = sorted((cost * share, start + (cost - start) * share))
    return least, most


def expected_cost(panel: str, run: Run, start: float) -> tuple[float, float]:
    """The least and the most CPU seconds, by the execution whose effort is nearest; NaN if there is none."""
    known = [
        (effort(options | run.options) / effort(options), cost)
        for options, cost in executions(panel, run.name)
    ]
    if not known:
        return math.nan, math.nan
    share, cost = min(known, key=lambda one: abs(math.log(one[0])))
    return scaled(cost, share, start)


def cheapest() -> float:
    """CPU seconds of the cheapest execution: no start of a program costs more."""
    costs = (json.loads(path.read_text())["cpu_seconds"] for path in (ROOT / "build/costs").rglob("*.json"))
    return min(costs, default=0)


def worst_error(quality: str, panel: Panel) -> str:
    """The largest error of the panel's runs; those that had a target apart, as error and target."""
    errors, aimed = [], []
    for run in panel.runs:
        try:
            provenance = load(ROOT / data_path(quality, panel.name, run.name)).provenance
        except FormatError:
            continue
        achieved, target = (float(provenance[name]) for name in ("achieved_error", "target_error"))
        if target > 0:
            aimed.append((achieved / target, f"{achieved:.1e} of {target:.0e}"))
        elif not math.isnan(achieved):
            errors.append((achieved, f"{achieved:.1e}"))
    return "; ".join(max(found)[1] for found in (errors, aimed) if found)


def seconds(values: Iterable[float]) -> str:
    total = math.fsum(values)
    return "unknown" if math.isnan(total) else f"{total:.1f}"


def seconds_between(ranges: Sequence[tuple[float, float]]) -> str:
    least, most = (seconds(one[end] for one in ranges) for end in (0, 1))
    return least if least == most else f"{least} to {most}"


def table(quality: str) -> Table:
    """Raises ConfigurationError."""
    plan = load_plan(quality)
    stale = Staleness(quality, plan).reasons(plan)
    start = cheapest()
    result = Table(
        "panel", "state", "largest error", "CPU s, last", "CPU s, next", title=f"Quality {quality}"
    )
    for name, panel in plan.items():
        jobs = [job for job in stale if job.split("/")[0] == name]
        reason = stale[jobs[0]] if jobs else "fresh"
        past = [cost for run in panel.runs if (cost := cost_file(quality, name, run.name))]
        waiting = [run for run in panel.runs if f"{name}/{run.name}" in stale]
        result.add_row(
            name,
            escape(reason),
            worst_error(quality, panel),
            seconds(cost["cpu_seconds"] for cost in past) if past else "",
            seconds_between([expected_cost(name, run, start) for run in waiting]),
        )
    return result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    quality = parser.parse_args().quality
    try:
        Console(width=None if sys.stdout.isatty() else WIDE).print(table(quality))
    except ConfigurationError as error:
        sys.exit(f"make status: {error}")


if __name__ == "__main__":
    main()
