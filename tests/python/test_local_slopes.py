"""The quasi-stationary temperature of a closed chain, and the speed of sound that follows from it."""

import numpy as np
import pytest

from tests.python.conftest import ROOT
from workflow.figures import fig09
from workflow.lib.load import Result
from workflow.physics.closed import quasi_stationary


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
