"""Results by panel, as claims look them up, and numbers taken from them."""

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from workflow.lib.fit import local_exponents
from workflow.lib.identity import panel_of
from workflow.lib.load import Index, Result
from workflow.lib.text import scientific
from workflow.study.fit import PowerLaw, fit_power
from workflow.study.verdict import Estimate


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


def exponent_between(first: Estimate, last: Estimate, factor: float, label: str) -> Estimate:
    """Exponent of a power law through two independent numbers, at places whose ratio is `factor`. The errors of
    two times of one run are correlated; the error is then too large."""
    _, slope, error = local_exponents((1, factor), (first.value, last.value), (first.error, last.error))
    return Estimate(label, float(slope[0]), float(error[0]), min(first.dof, last.dof))


def octave(values: Mapping[int, Estimate], a: int, b: int, label: str) -> Estimate:
    """Exponent of a power law between two sizes; unknown, NaN, without a value at the smaller one, or if they are
    farther apart than an octave. So fewer sizes decide less."""
    if a in values and b <= 2 * a:
        return exponent_between(values[a], values[b], b / a, label)
    return Estimate(label, math.nan, math.nan)


def power_law(values: Mapping[int, Estimate], first: int, label: str) -> list[Estimate]:
    """The numbers of a statement that a power law holds from size `first` on. If the sizes follow one power, its
    exponent; if they reject it, or if an octave is unknown, the exponent of every octave: so a law that bends by
    more than the band is contradicted, one that bends by less is not, however precise the numbers are, and a bend
    is no error of an exponent. Raises MissingError if there are not two octaves."""
    sizes = [first, *(size for size in sorted(values) if size > first)]
    if sizes[-1] < 4 * first:
        raise MissingError(f"no stationary sizes over two octaves, from {first} on")
    octaves = [octave(values, a, b, f"{label}, N = {a} to {b}") for a, b in pairwise(sizes)]
    if any(math.isnan(one.value) for one in octaves):
        return octaves
    law, exponent = _fit({size: values[size] for size in sizes}, label)
    if not law.rejected:
        return [replace(exponent, label=f"{exponent.label}, one power: p = {law.p_value:.2g}")]
    return [replace(one, label=f"{one.label}, no power: p = {scientific(law.p_value, 1)}") for one in octaves]


def power(values: Mapping[int, Estimate], label: str) -> Estimate:
    """Exponent of a power law fitted to independent numbers by size. Raises MissingError for fewer than two."""
    if len(values) < 2:
        raise MissingError("fewer than two stationary sizes")
    return _fit(values, label)[1]


def _fit(values: Mapping[int, Estimate], label: str) -> tuple[PowerLaw, Estimate]:
    points = np.array([(point.value, point.error, point.dof) for point in values.values()])
    law = fit_power([*values], *points.T)
    label = f"{label}, N = {min(values)} to {max(values)}"
    return law, Estimate(label, law.exponent, law.error, float(points[:, 2].min()))
