"""Fits of independent points with estimated errors."""

import numpy as np
import pytest
from scipy.stats import chi2, norm, t

from workflow.study.fit import LEVEL, PowerLaw, fit_power

SIZE = np.array([4, 8, 16, 64, 256])
RELATIVE = np.array([0.01, 0.02, 0.01, 0.03, 0.02])  # unequal errors
SAMPLES = 4000
EXACT = 1e9  # degrees of freedom


def z_score(seen: np.ndarray, probability: float) -> float:
    return float((seen.mean() - probability) / np.sqrt(probability * (1 - probability) / len(seen)))


@pytest.mark.parametrize("replicas", [8, 32, 128])
def test_errors_of_few_replicas(replicas: int) -> None:
    """A true law is rejected at the nominal rate. The error of the exponent covers the true one as often as
    one with at least the degrees of freedom of the points, and at most as a known one. Detected mistake:
    errors are taken as exact."""
    generator, dof = np.random.default_rng(2), replicas - 1
    laws: dict[float, list[PowerLaw]] = {dof: [], EXACT: []}
    for _ in range(SAMPLES):
        value = 3 * SIZE**0.4 * (1 + RELATIVE * generator.normal(size=5))
        error = RELATIVE * np.sqrt(generator.chisquare(dof, 5) / dof) * value
        for assumed, found in laws.items():
            found.append(fit_power(SIZE, value, error, assumed))
    alarms, covered = (
        {
            assumed: np.array(
                [one.rejected if kind else abs(one.exponent - 0.4) < one.error for one in found]
            )
            for assumed, found in laws.items()
        }
        for kind in (True, False)
    )
    least, most = (2 * law.cdf(1) - 1 for law in (t(dof), norm))
    assert abs(z_score(alarms[dof], LEVEL)) < 3
    assert z_score(covered[dof], least) > -3
    assert z_score(covered[dof], most) < 3
    if replicas < 128:
        assert z_score(alarms[EXACT], LEVEL) > 3
    if replicas == 8:
        assert z_score(covered[EXACT], least) < -3


def test_points_that_bend_are_rejected() -> None:
    law = fit_power([1, 2, 4], [1, 2, 8], [0.1, 0.2, 0.8], EXACT)
    assert law.p_value == pytest.approx(chi2.sf(np.log(2) ** 2 / (6 * 0.1**2), 1), rel=1e-6)
    assert law.rejected
    assert not fit_power([1, 2, 4], [1, 2, 8], [0.1, 0.2, 0.8], 7).rejected


def test_points_without_a_value_are_skipped() -> None:
    """The exponent is 0.4 without the second point, and unknown if a point has no error."""
    y = np.where(SIZE == 8, np.nan, 3 * SIZE**0.4)
    error = 0.01 * (1 + np.arange(5)) * y
    law = fit_power(SIZE, y, error, EXACT)
    assert law.exponent == pytest.approx(0.4)
    assert np.isnan(fit_power(SIZE, y, np.where(SIZE == 16, np.nan, error), EXACT).exponent)


@pytest.mark.parametrize(("x", "y"), [([4], [1]), ([4, 4], [1, 2]), ([4, 8], [1, np.nan]), ([4, 8], [1, -2])])
def test_no_power_law_goes_through_fewer_than_two_places(x: list[float], y: list[float]) -> None:
    with pytest.raises(ValueError, match="no power law"):
        fit_power(x, y, 0.1 * np.abs(y), EXACT)
