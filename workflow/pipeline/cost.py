"""CPU time of missing results, estimated from former ones."""

import os
import re
from collections.abc import Iterable
from pathlib import Path

from workflow.lib.identity import siblings
from workflow.lib.load import cpu_seconds


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
    effort = without_seed(folder.name)
    folders = (other / panel for other in folder.parent.glob("*") if without_seed(other.name) == effort)
    found = [former for other in folders for former in siblings(other / result.name)]
    return cpu_seconds(max(found, key=os.path.getmtime, default=result))


def without_seed(quality: str) -> str:
    """Name of a quality and effort with any seed."""
    return re.sub(r"_seed=\d+", "", quality)
