"""Data of the claims: the result files of the panels, and numbers taken from them."""

import copy
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from workflow.claims.verdict import Number, with_systematic
from workflow.lib.fit import PowerLaw, fit_power
from workflow.lib.load import FormatError, Index, Result, load
from workflow.plan import Run, data_path, load_plan


class MissingError(LookupError):
    """A result that a claim depends on does not exist or cannot be loaded."""


class Data:
    """The results at one quality. Each file is loaded once for all claims."""

    def __init__(self, quality: str, root: Path) -> None:
        self.quality, self.root = quality, root
        self.plan = load_plan(quality)
        self.loaded: dict[str, Result] = {}  # loaded results by path
        self.used: dict[str, Result] = {}  # results that a claim has used, by path
        self.damaged: list[str] = []  # paths of existing results that cannot be loaded

    def anew(self) -> "Data":
        """A copy that shares the loaded results, and has an empty list of used ones."""
        fresh = copy.copy(self)
        fresh.used = {}
        return fresh

    def of(self, panel: str, program: str | None = None, **parameters: object) -> list[Result]:
        """The panel's own runs with these parameters (underscores for dashes). Raises MissingError if there is none."""
        wanted = {name.replace("_", "-"): value for name, value in parameters.items()}
        runs = [run for run in self._runs(panel) if program in (None, run.program)]
        results = {
            path: result
            for path, result in (self._load(panel, run) for run in runs)
            if all(result.parameters.get(name) == value for name, value in wanted.items())
        }
        if not results:
            raise MissingError(f"{panel} has no runs with {wanted or 'results'} at quality {self.quality}")
        self.used |= results
        return [*results.values()]

    def one(self, panel: str, run: str) -> Result:
        """The result of a run of the panel, by its name. Raises MissingError."""
        named = [planned for planned in self._runs(panel) if planned.name == run]
        if not named:
            raise MissingError(f"{panel} has no run {run} at quality {self.quality}")
        path, result = self._load(panel, named[0])
        self.used[path] = result
        return result

    def _runs(self, panel: str) -> Sequence[Run]:
        if panel not in self.plan:
            raise MissingError(f"there is no panel {panel}")
        return self.plan[panel].runs

    def _load(self, panel: str, run: Run) -> tuple[str, Result]:
        path = data_path(self.quality, panel, run)
        if path not in self.loaded:
            try:
                self.loaded[path] = load(self.root / path)
            except (FormatError, OSError) as error:
                if (self.root / path).exists():
                    self.damaged.append(path)
                raise MissingError(f"{path} is missing, damaged or unreadable") from error
        return path, self.loaded[path]


@dataclass(frozen=True)
class Evidence:
    """What a claim's function returns: numbers by reading, each with its acceptance band in data/claims.csv. The alternative reading is
    reported and does not count."""

    literal: Sequence[Number]
    intended: Sequence[Number] = ()
    alternative: Sequence[Number] = ()
    caveat: str = ""


Claim = Callable[[Data], Evidence]


def where_made(find: Callable[[], Sequence[Number]]) -> Sequence[Number]:
    """The numbers; none if a result is missing, as not every quality has all runs."""
    try:
        return find()
    except MissingError:
        return []


def freedom(*results: Result) -> float:
    """Degrees of freedom of a number that is calculated from these runs: those of the run with the fewest replicas."""
    return min(int(result.parameters["replicas"]) for result in results) - 1


def by_size(results: Iterable[Result]) -> list[Result]:
    return sorted(results, key=lambda result: result.parameters["cells"])


def number(result: Result, name: str, index: Index = (), label: str = "") -> Number:
    """A quantity of a run, or one element of an array. A computed quantity has a systematic error only."""
    quantity = result[name]
    value = float(quantity.mean[index])
    if quantity.discretisation_error is not None:
        return Number(label, value, 0.0, systematic=float(quantity.discretisation_error[index]))
    return Number(label, value, float(quantity.error[index]), freedom(result))


def ratio(above: Number, below: Number, label: str) -> Number:
    """Ratio of two independent numbers."""
    value, size = above.value / below.value, abs(below.value)
    error = float(np.hypot(above.error, value * below.error)) / size
    systematic = (above.systematic + abs(value) * below.systematic) / size
    return Number(label, value, error, min(above.freedom, below.freedom), systematic)


def combination(numbers: Sequence[Number], weights: Sequence[float], label: str, minus: float = 0) -> Number:
    """Weighted sum of independent numbers, minus an expected value."""
    terms = [*zip(weights, numbers, strict=True)]
    return Number(
        label,
        sum(weight * term.value for weight, term in terms) - minus,
        float(np.sqrt(sum((weight * term.error) ** 2 for weight, term in terms))),
        min(term.freedom for term in numbers),
        sum(abs(weight) * term.systematic for weight, term in terms),
    )


def power(
    results: Sequence[Result], size: Sequence[float], values: Sequence[Number], label: str
) -> tuple[Number, PowerLaw]:
    """Exponent of a power law through independent numbers; if they reject the law, the label states it. The
    systematic error is the change of the exponent without the first number."""
    x, y, error = (
        np.asarray(size, float),
        [point.value for point in values],
        [point.error for point in values],
    )
    law = fit_power(x, y, error)
    later = fit_power(x[1:], y[1:], error[1:]).exponent if len(x) > 2 else law.exponent
    exponent = Number(mean_slope(label, law), law.exponent, law.error, freedom(*results))
    return with_systematic(exponent, [later]), law


def mean_slope(label: str, law: PowerLaw) -> str:
    """The label, which calls the exponent a mean slope if the points reject the power law."""
    if not law.rejected:
        return label
    return f"{label}, a mean slope (χ² = {law.chi_square:.0f} for {law.freedom})"
