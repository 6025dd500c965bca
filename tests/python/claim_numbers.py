"""What the tests of the claims' numbers share: results in which no two values are alike, and the numbers they should give."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from tests.python.known_results import Known, uneven
from workflow.claims.verdict import Number

PANELS = ("fig01", "fig02_upper", "fig03", "fig03_inset", "fig04a", "fig04b", "fig05", "fig06", "fig07", "fig07_inset",
          "fig08", "fig09a", "fig09b", "ext01", "ext03", "ext05", "ext07", "ext09", "ext10")  # fmt: skip
DATA = Known(dict.fromkeys(PANELS, uneven))


def check(
    numbers: Sequence[Number],
    value: ArrayLike,
    error: ArrayLike,
    systematic: ArrayLike = 0,
    freedom: float | None = None,
) -> None:
    """One number per value, in their order."""
    assert len(numbers) == np.size(value)
    found = np.array([(one.value, one.error, one.systematic) for one in numbers]).T
    for column, expected in zip(found, (value, error, systematic), strict=True):
        np.testing.assert_allclose(column, np.broadcast_to(expected, column.shape), rtol=1e-9, atol=1e-12)
    assert freedom is None or {one.freedom for one in numbers} == {freedom}


def freedom(panel: str, series: str, data: Known = DATA) -> int:
    """One less than the replicas of a series."""
    (replicas,) = {run.options["replicas"] for run in data.plan[panel].runs if run.series == series}
    return int(replicas) - 1


def of(panel: str, run: str, name: str, data: Known = DATA) -> tuple[np.ndarray, np.ndarray]:
    """Mean and error that were put in."""
    found = data.one(panel, run)[name]
    return found.mean, found.error


def each(panel: str, name: str, *runs: str) -> tuple[np.ndarray, np.ndarray]:
    mean, error = np.array([of(panel, run, name) for run in runs]).T
    return mean, error


def relative_change(one: ArrayLike, other: ArrayLike, *errors: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """other/one - 1 with the error by the two derivatives."""
    one, other = np.asarray(one), np.asarray(other)
    return other / one - 1, np.sqrt((errors[1] / one) ** 2 + (other * errors[0] / one**2) ** 2)


def line(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> tuple[float, float]:
    """Slope and its error."""
    solution, covariance = np.polyfit(
        np.asarray(x), np.asarray(y), 1, w=1 / np.asarray(error), cov="unscaled"
    )
    return float(solution[0]), math.sqrt(covariance[0, 0])


def power(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> tuple[float, float, float]:
    """Exponent, its error, change without the first point."""
    x, relative, y = np.log(x), np.asarray(error) / y, np.log(y)
    exponent, spread = line(x, y, relative)
    return exponent, spread, abs(line(x[1:], y[1:], relative[1:])[0] - exponent) if len(x) > 2 else 0
