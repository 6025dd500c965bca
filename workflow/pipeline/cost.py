"""CPU time of results, from the cost files that the programs write (docs/format.md)."""

import json
import re
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path


def cpu_seconds(result: Path) -> float | None:
    """CPU time of a result; None if its cost file is missing or damaged."""
    with suppress(OSError, ValueError, KeyError):
        return float(json.loads(result.with_suffix(".cost.json").read_text())["cpu_seconds"])
    return None


def expected(results: Iterable[str]) -> str:
    """Sentence with the CPU time of missing results, as far as there are former results of the same runs, for example from other sources or
    with another seed."""
    known = [former_cost(Path(path)) for path in results]
    costs = [cost for cost in known if cost is not None]
    if not costs:
        return f"The CPU time of {len(known)} runs is unknown, as they have no former results"
    return f"About {sum(costs):.0f} CPU s, from former results of {len(costs)} of these {len(known)} runs"


def former_cost(result: Path) -> float | None:
    """CPU time of the newest result of the same run and effort, with any seed and identity."""
    folder, panel = result.parent.parent, result.parent.name
    effort = re.sub(r"_seed=\d+", "", folder.name)
    run = result.stem.rpartition(".")[0]
    found = [
        path
        for other in folder.parent.glob("*")
        if re.sub(r"_seed=\d+", "", other.name) == effort
        for path in (other / panel).glob("*.h5")
        if path.stem.rpartition(".")[0] == run
    ]
    newest = max(found, key=lambda path: path.stat().st_mtime, default=result)
    return cpu_seconds(newest)
