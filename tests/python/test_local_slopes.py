"""Numbers that panels derive from results, for known laws: local slopes, extrapolations and the
quasi-stationary estimate."""

import numpy as np
import pandas as pd
import pytest

from tests.python.conftest import ROOT
from workflow.figures import fig01_inset, fig09
from workflow.lib.load import Quantity, Result
from workflow.physics.closed import quasi_stationary


def test_slopes_of_a_logarithm_are_its_factor() -> None:
    time = np.geomspace(1, 100, 11)
    table = pd.DataFrame({"time": time, "number": 3 + 8 * np.log(time), "number_error": 0.5})
    slopes = fig01_inset.slopes(table)
    assert [*slopes.dropna().index] == [1, 4, 7]  # the last step ends at the last time
    np.testing.assert_allclose(slopes.slope.dropna(), 8)
    step = 0.3 * np.log(100)
    np.testing.assert_allclose(slopes.slope_error.dropna(), 0.5 * np.sqrt(2) / step)
    np.testing.assert_allclose(slopes.slope_time.dropna(), np.sqrt(time[[1, 4, 7]] * time[[4, 7, 10]]))


@pytest.mark.parametrize("particles", [2, 20])
def test_quasi_stationary_estimate_conserves_energy(particles: int) -> None:
    """Detected mistakes: a factor of 2 or Λ is missing; the iteration has not converged."""
    time = np.array([1.0, 1e3, 1e40])
    temperature, slow = quasi_stationary(particles, 500, 1, time)
    np.testing.assert_allclose(particles * temperature / slow + temperature, particles * 500)
    np.testing.assert_allclose(temperature[-1], particles * 500, rtol=particles / 80)  # the energy saturates
    expected = np.log(time[1] * np.sqrt(2 * temperature[1])) - np.euler_gamma / 2 + 1  # eq. 13 at late times
    np.testing.assert_allclose(slow[1], expected, rtol=1e-6)


def test_the_speed_of_sound_before_the_pulse() -> None:
    """ζ = n/2Λ, and T conserves the energy [eqs. 13, 14, 56], in cells of length 2."""
    options = {
        "particles_per_cell": 50,
        "energy": 5000,
        "cell_length": 2.0,
        "sigma": 0.5,
        "relaxation_time": 1,
    }
    temperature, slow = (values.item() for values in quasi_stationary(50, 1e4, 2, 1))
    assert 50 * temperature / slow + temperature == pytest.approx(50 * 1e4)
    zeta = 50 / (2 * slow)
    speed = np.sqrt(8 * zeta**2 * temperature / ((2 * zeta + 3) * (2 * zeta + 1))) / 2
    assert fig09.sound_speed(Result(ROOT, options, {}, {})) == pytest.approx(speed)


@pytest.mark.parametrize(
    ("speeds", "ends"),
    [
        ([np.nan, 400.0, 350.0, 300.0, np.nan], ("400(10)", "300(10)")),
        ([np.nan, np.nan], (None, None)),
    ],
)
def test_the_caption_states_the_first_and_the_last_speed(speeds: list[float], ends: object) -> None:
    mean = np.array(speeds)
    errors = np.where(np.isnan(mean), np.nan, 10.0)
    axes = {"middle": np.arange(len(mean)) + 1.0}
    speed = Quantity(mean, errors, None, np.full(len(mean), 8), axes, "1/time", {}, 0)
    assert fig09.speeds(Result(ROOT, {}, {}, {"peak_speed": speed})) == ends
