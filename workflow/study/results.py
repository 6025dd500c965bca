"""Results by panel, as claims look them up, and numbers taken from them."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence

import numpy as np

from workflow.lib.fit import PowerLaw, fit_power, local_exponents
from workflow.lib.identity import panel_of
from workflow.lib.load import Index, Result
from workflow.study.verdict import Estimate, with_systematic


class MissingError(LookupError):
    """The quality has no result that a claim depends on, or its results do not determine a number."""


class Results:
    """Results by panel."""

    def __init__(self, results: Iterable[Result]) -> None:
        self.by_panel: dict[str, list[Result]] = defaultdict(list)
        for result in results:
            self.by_panel[panel_of(result.path)].append(result)

    def of_panel(self, panel: str) -> list[Result]:
        """All results of a panel. Raises MissingError if there are none."""
        if panel not in self.by_panel:
            raise MissingError(f"no results of {panel}")
        return self.by_panel[panel]

    def results(self, panel: str, *series: str, **parameters: object) -> list[Result]:
        """The results of series of a panel with these parameters. Other series, as those of the user, do not
        count. Raises MissingError if there are none."""
        found = [
            result
            for result in self.of_panel(panel)
            if result.series in series
            and all(result.parameters.get(key) == value for key, value in parameters.items())
        ]
        if not found:
            raise MissingError(f"no {' or '.join(series)} of {panel} with {parameters}")
        return found

    def one(self, panel: str, run: str) -> Result:
        """The result of a run of the panel, by its name. Raises MissingError."""
        for result in self.of_panel(panel):
            if result.run == run:
                return result
        raise MissingError(f"{panel} has no run {run}")


Claim = Callable[[Results], list[Estimate]]


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
