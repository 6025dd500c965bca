"""The order of the heat peak in equilibrium: interpolated stable densities, times that count, missing results."""

import numpy as np
import pytest

from tests.python.claim_truths_closed import heat_peak as stable_peak
from tests.python.claim_truths_closed import of_peaks
from tests.python.known_results import Known, truth
from workflow.claims.data import MissingError
from workflow.claims.pulse import heat_peak
from workflow.lib.mode_coupling import Chain, levy
from workflow.lib.peaks import CENTRE, Record, heat_area, heat_width, stable_densities, stable_law
from workflow.plan import Run


@pytest.mark.parametrize("order", [1, 1.234, 5 / 3, 2, 2.51, 3])
def test_interpolated_densities(order: float) -> None:
    x = np.linspace(0, 39, 333)
    np.testing.assert_allclose(stable_densities().ev(x, order), levy(x, order), rtol=0, atol=3e-5)


def test_the_first_time_bounds_the_systematic_error() -> None:
    """The order is 1.6 at t = 256 and 1.7 later. The mean is between them, and the systematic error extends up to 1.7."""

    def profile(run: Run, t: np.ndarray, cell: np.ndarray) -> np.ndarray:
        first, later = (stable_peak(order)(run, t, cell) for order in (1.6, 1.7))
        return np.where(t < 300, first, later)

    order, sentence = heat_peak(Known({"ext03": truth(of_peaks | {"heat_correlation": profile}, 1e-4)}))
    assert 1.6 < order.value < 1.7
    assert order.value + order.systematic == pytest.approx(1.7, abs=1e-6)
    assert "at t = 256, 512 and 1024. The peak is then 7 to 16 cells wide" in sentence


def test_times_whose_profile_determines_no_order_do_not_count() -> None:
    """At t = 1024 the profile has no peak, so that the fitted order is at a bound."""

    def profile(run: Run, t: np.ndarray, cell: np.ndarray) -> np.ndarray:
        return np.where(t > 1000, np.cos(cell / 20), stable_peak(1.7)(run, t, cell))

    order, sentence = heat_peak(Known({"ext03": truth(of_peaks | {"heat_correlation": profile}, 1e-4)}))
    assert order.value == pytest.approx(1.7, abs=1e-6)
    assert "at t = 256 and 512." in sentence
    flat = truth(of_peaks | {"heat_correlation": lambda *_: 1.0}, 1e-4)
    with pytest.raises(MissingError, match="determine no order"):
        heat_peak(Known({"ext03": flat}))


def test_a_cusp_at_the_centre_does_not_count_without_the_central_cells() -> None:
    gas = Chain(0.2, 1 / 9, slow_logarithm=7.0)
    record = Record([], 0, 512.0, gas, gas)
    width = heat_width(record)
    profile = heat_area(record) * gas.cell_length / width * levy(np.arange(1000) / width, 1.6)
    profile[:CENTRE] *= 1.1
    assert stable_law(record, profile, omitted=CENTRE)[-1] == pytest.approx(1.6, abs=1e-3)
    assert stable_law(record, profile)[-1] < 1.59
