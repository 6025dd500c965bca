"""Prints for every panel whether it is fresh and if not why, its errors, what it cost and what it would cost."""

import argparse
import json
import math
import sys
from collections.abc import Iterable

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from workflow.config.plan import QUALITIES, ConfigurationError, Panel, Run, data_path, load_plan
from workflow.provenance.repository import ROOT
from workflow.provenance.stale import Staleness
from workflow.scripts.load import FormatError, load

WIDE = 150  # columns, where nobody reads them on a screen


def cost_file(quality: str, panel: str, run: str) -> dict | None:
    """What the last execution of the run cost, as its sidecar says."""
    path = ROOT / f"build/costs/{quality}/{panel}/{run}.json"
    return json.loads(path.read_text()) if path.is_file() else None


def effort(run: Run) -> float:
    """Replicas, with their members, times the simulated time: what cost is proportional to."""
    replicas = float(run.options.get("replicas", 1)) * float(run.options.get("members", 1))
    last = str(run.options.get("times", "")).rsplit(",", maxsplit=1)[-1] or run.options.get(
        "observation-time", 1
    )
    times = (last, run.options.get("relaxation-time", 0))
    return replicas * sum(float(str(time).rstrip("N") or 1) for time in times)


def expected_cost(plans: dict[str, dict[str, Panel]], quality: str, panel: str, run: Run) -> float:
    """CPU seconds: of the last execution, at this quality or another, scaled by the effort; NaN if there is none."""
    for other in (quality, *QUALITIES):
        runs = plans[other][panel].runs if panel in plans[other] else ()
        twin = next((one for one in runs if one.name == run.name), None)
        cost = cost_file(other, panel, run.name)
        if twin is not None and cost is not None:
            return cost["cpu_seconds"] * effort(run) / effort(twin)
    return math.nan


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


def table(quality: str) -> Table:
    """Raises ConfigurationError."""
    plans = {name: load_plan(name) for name in QUALITIES}
    plan = plans[quality]
    stale = Staleness(quality, plan).reasons(plan)
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
            seconds(expected_cost(plans, quality, name, run) for run in waiting),
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
