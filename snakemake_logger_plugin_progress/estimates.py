"""What a run resulted in, and how long the others will take."""

from pathlib import Path
from re import Match

from workflow.cluster.cost import DRAWING, seconds_of_run
from workflow.lib.plan import load_plan, with_used


class Remaining:
    """Time left, from estimated CPU seconds, corrected by what finished jobs took.

    Snakemake's events state how many runs there are, not which. Those whose results are missing come first, then the longest ones.
    """

    def __init__(self, runs: int, drawings: int, cores: int, panel: Match[str] | None) -> None:
        self._runs, self._drawings, self._cores, self._panel = runs, drawings, cores, panel
        self._costs: dict[str, float] = {}  # CPU seconds by panel/run
        self._waiting: list[str] = []
        self._estimated = self._taken = 0.0

    def start(self, name: str, quality: str) -> None:
        if not self._costs:
            plan = load_plan(quality)
            panels = with_used(plan, self._panel[1]) if self._panel else plan.values()
            self._costs = {
                f"{one.name}/{run.name}": seconds_of_run(one.name, run) for one in panels for run in one.runs
            }
            missing = [one for one in self._costs if not Path(f"data/{quality}/{one}.h5").exists()]
            self._waiting = sorted(self._costs, key=lambda one: (one not in missing, -self._costs[one]))[
                : self._runs
            ]
        if "/" not in name:
            self._drawings -= 1
        elif self._waiting:
            self._waiting.remove(name if name in self._waiting else self._waiting[-1])

    def finish(self, name: str, seconds: float) -> None:
        self._estimated += self._costs.get(name, DRAWING)
        self._taken += seconds

    def seconds(self, spent: dict[str, float]) -> float:
        """Wall time until all is done. spent: CPU seconds of the running jobs until now."""
        speed = self._taken / self._estimated if self._estimated else 1.0
        waiting = self._drawings * DRAWING + sum(self._costs[name] for name in self._waiting)
        running = [
            max(speed * self._costs.get(name, DRAWING) - seconds, 0.0) for name, seconds in spent.items()
        ]
        return (speed * waiting + sum(running)) / self._cores


def outcome(path: Path) -> tuple[str, list[str]]:
    """mu = 0.3289(30), or of a quantity with many values its largest error; and why the result is marked, if it is."""
    from workflow.lib.fit import with_error  # noqa: PLC0415  half a second
    from workflow.lib.load import NOT_REACHED, FormatError, load  # noqa: PLC0415

    try:
        result = load(path)
    except FormatError as damage:
        return str(damage), []
    name = result.provenance["target_quantity"]
    quantity, stationary = result.quantities.get(name), result.quantities.get("stationary")
    doubts = ["target error not reached"] if result.converged == NOT_REACHED else []
    doubts += ["not stationary"] if stationary is not None and (stationary.mean == 0).any() else []
    if quantity is None or quantity.mean.size > 1:
        return f"error of {name} {float(result.provenance['achieved_error']):.2g}", doubts
    error = quantity.error if quantity.discretisation_error is None else quantity.discretisation_error
    return f"{name} = {with_error(float(quantity.mean), float(error))}", doubts
