"""The order of the heat peak in equilibrium: interpolated stable densities, its error, times that count, missing results."""

from collections.abc import Callable

import numpy as np
import pytest

from tests.python.claim_truths_closed import heat_peak as stable_peak
from tests.python.known_results import EQUAL, Known, drawn, truth
from tests.python.test_claim_numbers import outside
from workflow.claims.data import MissingError
from workflow.claims.pulse import heat_peak
from workflow.physics.mode_coupling import Chain, levy
from workflow.physics.peaks import CENTRE, Record, heat_area, heat_width, stable_densities, stable_law
from workflow.pipeline.plan import Run


def known(profile: Callable[..., object], error: float) -> Known:
    return Known({"peaks": truth({"heat_correlation": profile}, error)})


@pytest.mark.parametrize("order", [1, 1.234, 5 / 3, 2, 2.51, 3])
def test_interpolated_densities(order: float) -> None:
    x = np.linspace(0, 39, 333)
    np.testing.assert_allclose(stable_densities().ev(x, order), levy(x, order), rtol=0, atol=3e-5)


def test_the_order_scatters_as_its_error_predicts() -> None:
    random, exact = np.random.default_rng(6), known(stable_peak(1.7), 0.03)
    heat_peak(exact)  # loads the results
    draws = [heat_peak(drawn(exact, random)) for _ in range(50)]
    z = np.array([[(order.value - 1.7) / order.error for order in draw] for draw in draws])
    freedom = np.full(z.shape[1], EQUAL - 1.0)
    assert not outside(z, freedom, np.ones(1)).any()
    assert outside(2 * z, freedom, np.ones(1)).all()


def test_times_whose_profile_determines_no_order_do_not_count() -> None:
    """At t = 1024 the profile has no peak, so that the fitted order is at a bound."""

    def profile(run: Run, t: np.ndarray, cell: np.ndarray) -> np.ndarray:
        return np.where(t > 1000, np.cos(cell / 20), stable_peak(1.7)(run, t, cell))

    orders = heat_peak(known(profile, 1e-4))
    assert [order.label for order in orders] == ["t = 256", "t = 512"]
    assert [order.value for order in orders] == pytest.approx([1.7] * 2, abs=1e-6)
    with pytest.raises(MissingError, match="determine no order"):
        heat_peak(known(lambda *_: 1.0, 1e-4))


def test_a_cusp_at_the_centre_does_not_count_without_the_central_cells() -> None:
    gas = Chain(0.2, 1 / 9, slow_logarithm=7.0)
    record = Record([], 0, 512.0, gas, gas)
    width = heat_width(record)
    profile = heat_area(record) * gas.cell_length / width * levy(np.arange(1000) / width, 1.6)
    profile[:CENTRE] *= 1.1
    assert stable_law(record, profile, omitted=CENTRE)[-1] == pytest.approx(1.6, abs=1e-3)
    assert stable_law(record, profile)[-1] < 1.59
