"""Numbers that panels derive from results, for known laws: local slopes, extrapolations and the
quasi-stationary estimate."""

import numpy as np
import pandas as pd
import pytest

from tests.python.conftest import ROOT
from workflow.figures import fig01_inset, fig06, fig09
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
    ("speeds", "phrase"),
    [
        ([np.nan, 400.0, 350.0, 300.0, np.nan], "goes from 400(10) to 300(10)"),
        ([np.nan, np.nan], "is not resolved"),
    ],
)
def test_the_caption_states_the_first_and_the_last_speed(speeds: list[float], phrase: str) -> None:
    mean = np.array(speeds)
    errors = np.where(np.isnan(mean), np.nan, 10.0)
    axes = {"middle": np.arange(len(mean)) + 1.0}
    speed = Quantity(mean, errors, None, np.full(len(mean), 8), axes, "1/time", {}, 0)
    assert fig09.motion(Result(ROOT, {}, {}, {"peak_speed": speed})) == phrase


def test_the_excess_of_waiting_times_is_that_of_the_tail() -> None:
    """Detected mistakes: bins before the tail or with large errors count; the excess of an infinite number
    of particles is wrong; weights are not those of the expected counts, 8 and 6."""
    options = {"tail_from": 20.0, "cell_length": 1.0, "temperature": 400.0, "particles_per_cell": 20}
    table = pd.DataFrame({"tau": [0.5, 2.0, 3.0, 4.0], "gaussian_start": [8.0, 4.0, 2.0, 1.0]})
    table = table.assign(density=table.gaussian_start * [3, 1.08, 1.22, 5], density_error=0.04, unsure=False)
    table.loc[3, "unsure"] = True
    sentence = fig06.above_exact(table, Result(ROOT, options, {}, {}))
    assert sentence.startswith(" At σ = 0 the tail is 14.0(1.0) % above")
    assert sentence.endswith("7.9 %).")
