"""What runs cost, and what they would cost at other settings."""

import json
import math
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from workflow.lib.configuration import Options, at_size
from workflow.lib.load import FormatError, load_parameters
from workflow.lib.plan import QUALITIES, Run, data_path

ROOT = Path(__file__).parents[2]


def cost_file(quality: str, panel: str, run: str) -> dict[str, Any] | None:
    """What the last execution of the run cost, as its sidecar says; none if there is none that says it."""
    return read_cost(ROOT / f"build/costs/{quality}/{panel}/{run}.json")


def read_cost(path: Path) -> dict[str, Any] | None:
    try:
        cost: Any = json.loads(path.read_text()) if path.is_file() else None
        seconds = cost["cpu_seconds"] if cost else None
        return cost if isinstance(seconds, float) and 0 < seconds < math.inf else None
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return None


def cells(options: Options) -> float:
    """1 where there are none, as in the continuum."""
    number = options.get("cells", 1)
    return 1 if number == "continuum" else float(number)


def effort(options: Options) -> float:
    """Replicas, with their pairs, times the simulated time: what cost is proportional to, but for the start."""
    replicas = float(options.get("replicas", 1)) * float(options.get("pairs-per-replica", 1))
    last = str(options.get("times", "")).rsplit(",", maxsplit=1)[-1] or options.get("observation-time", 1)
    return replicas * sum(at_size(time, cells(options)) for time in (last, options.get("relaxation-time", 0)))


def executions(panel: str, run: Run) -> Iterator[tuple[Options, float]]:
    """Options and CPU seconds of the last execution at every quality that has one of this size; the plan may have
    changed since, and a series of one size may have another at another quality."""
    for quality in QUALITIES:
        cost = cost_file(quality, panel, run.name)
        with suppress(FormatError):
            parameters = load_parameters(ROOT / data_path(quality, panel, run.name))
            if cost is not None and cells(parameters) == cells(parameters | run.options):
                yield parameters, cost["cpu_seconds"]


def peak_memory(panel: str, run: Run) -> float:
    """Bytes: the most that an execution of the series took, at the size of the run, as particles and cells grow alike; NaN
    if there is none."""
    most = math.nan
    for quality in QUALITIES:
        for path in (ROOT / f"build/costs/{quality}/{panel}").glob("*.json"):
            if path.stem.partition("_")[0] != run.series:
                continue
            cost = read_cost(path)
            with suppress(FormatError, KeyError, TypeError):
                executed = load_parameters(ROOT / data_path(quality, panel, path.stem))
                growth = max(1.0, cells(run.options) / cells(executed))
                most = max(growth * cost["peak_memory_bytes"], most) if cost else most
    return most


def scaled(cost: float, share: float, start: float) -> tuple[float, float]:
    """The least and the most that a run costs if up to `start` seconds of another's cost do not grow with the effort."""
    least, most = sorted((cost * share, start + (cost - start) * share))
    return least, most


def expected_cost(panel: str, run: Run, start: float) -> tuple[float, float]:
    """The least and the most CPU seconds, by the execution whose effort is nearest; NaN if there is none."""
    known = [
        (effort(options | run.options) / effort(options), cost) for options, cost in executions(panel, run)
    ]
    if not known:
        return math.nan, math.nan
    share, cost = min(known, key=lambda one: abs(math.log(one[0])))
    return scaled(cost, share, start)


def cheapest() -> float:
    """CPU seconds of the cheapest execution: no start of a program costs more."""
    costs = map(read_cost, (ROOT / "build/costs").rglob("*.json"))
    return min((cost["cpu_seconds"] for cost in costs if cost), default=0)
