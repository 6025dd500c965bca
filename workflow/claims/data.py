"""Data of the claims: the results of a quality, and numbers taken from them."""

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import numpy as np

from workflow.claims.verdict import Estimate, with_systematic
from workflow.lib.fit import PowerLaw, fit_power, local_exponents
from workflow.lib.load import Index, Result, load
from workflow.pipeline.plan import Run, data_path, load_plan


class MissingError(LookupError):
    """The quality has no result that a claim depends on, or its results do not determine a number."""


class Data:
    """The results at one quality. Each file is loaded once for all claims."""

    def __init__(self, quality: str, root: Path) -> None:
        self.quality, self.root = quality, root
        self.plan = load_plan(quality)
        self.loaded: dict[str, Result] = {}  # loaded results by path

    def results(self, panel: str, *series: str, **parameters: object) -> list[Result]:
        """The results of series of a panel with these parameters (underscores for dashes). Other series,
        as those of the user, do not count. Raises MissingError if there are none, FormatError, OSError."""
        wanted = {name.replace("_", "-"): value for name, value in parameters.items()}
        results = []
        for run in (run for run in self._runs(panel) if run.series in series):
            if all(run.options.get(key, value) == value for key, value in wanted.items()):
                results.append(self._load(panel, run))
        found = [
            result
            for result in results
            if all(result.parameters.get(key) == value for key, value in wanted.items())
        ]
        if not found:
            raise MissingError(f"no {' or '.join(series)} of {panel} with {wanted} at quality {self.quality}")
        return found

    def one(self, panel: str, run: str) -> Result:
        """The result of a run of the panel, by its name. Raises MissingError, FormatError, OSError."""
        for planned in self._runs(panel):
            if planned.name == run:
                return self._load(panel, planned)
        raise MissingError(f"{panel} has no run {run} at quality {self.quality}")

    def _runs(self, panel: str) -> tuple[Run, ...]:
        return self.plan[panel].runs if panel in self.plan else ()

    def _load(self, panel: str, run: Run) -> Result:
        path = data_path(self.quality, panel, run)
        if not (self.root / path).exists():
            raise MissingError(f"{path} is missing")
        if path not in self.loaded:
            self.loaded[path] = load(self.root / path)
        return self.loaded[path]


Claim = Callable[[Data], list[Estimate]]


def by_size(results: Iterable[Result]) -> list[Result]:
    return sorted(results, key=lambda result: result.parameters["cells"])


def estimate(result: Result, name: str, index: Index = (), label: str = "") -> Estimate:
    """A quantity of a run, or one element of an array. A computed quantity has a systematic error only."""
    quantity = result[name]
    value = float(quantity.mean[index])
    if quantity.discretisation_error is not None:
        return Estimate(label, value, 0.0, systematic=float(quantity.discretisation_error[index]))
    return Estimate(label, value, float(quantity.error[index]), float(quantity.dof[index]))


def ratio(above: Estimate, below: Estimate, label: str) -> Estimate:
    """Ratio of two independent numbers."""
    value, size = above.value / below.value, abs(below.value)
    error = float(np.hypot(above.error, value * below.error)) / size
    systematic = (above.systematic + abs(value) * below.systematic) / size
    return Estimate(label, value, error, min(above.dof, below.dof), systematic)


def combination(
    numbers: Sequence[Estimate], weights: Sequence[float], label: str, minus: float = 0
) -> Estimate:
    """Weighted sum of independent numbers, minus an expected value."""
    terms = [*zip(weights, numbers, strict=True)]
    return Estimate(
        label,
        sum(weight * term.value for weight, term in terms) - minus,
        float(np.sqrt(sum((weight * term.error) ** 2 for weight, term in terms))),
        min(term.dof for term in numbers),
        sum(abs(weight) * term.systematic for weight, term in terms),
    )


def log_slope(first: Estimate, last: Estimate, factor: float) -> Estimate:
    """Slope on logarithmic axes between two times, the later of which is `factor` times the first."""
    values, errors = (first.value, last.value), (first.error, last.error)
    _, slope, error = local_exponents((1, factor), values, errors)
    return Estimate("", float(slope[0]), float(error[0]), first.dof)


def power(size: Sequence[float], values: Sequence[Estimate], label: str) -> Estimate:
    """Exponent of a power law through independent numbers; if they reject the law, the label states it.
    The systematic error is the change of the exponent without the first number."""
    points = np.array([(point.value, point.error, point.dof) for point in values])
    law = fit_power(size, *points.T)
    later = fit_power(size[1:], *points[1:].T).exponent if len(size) > 2 else law.exponent
    exponent = Estimate(mean_slope(label, law), law.exponent, law.error, float(points[:, 2].min()))
    return with_systematic(exponent, [later])


def mean_slope(label: str, law: PowerLaw) -> str:
    """The label, which calls the exponent a mean slope if the points reject the power law."""
    return f"{label}, a mean slope" if law.rejected else label
