"""The standard error equals the standard deviation of results from independent seeds. The currents of open
chains and the peak of a pulse are tested with their other properties in test_open_chain.py and
test_pulse_peak.py."""

import numpy as np
import pytest

from tests.python.conftest import OverSeeds, spread_accepted
from tests.python.described import options_of_programs

SEEDS, LEVEL = 50, 1e-3
REPLICAS = 24

OPEN = {"cells": 5, "relaxation_time": 0.5, "observation_time": 4}
EQUILIBRIUM = {"cells": 30, "observation_time": 64, "times": "1,2,4,8"}
CASES: list[tuple[str, str, dict]] = [
    ("persistence", "mu", {"sigma": -0.8}),
    ("waiting_time", "exponent", {"sigma": 0.5, "observation_time": 50}),
    ("displacement", "alpha", {"sigma": 0.5, "decades": 2, "observation_time": 20}),
    ("heat_current", "mean_square_heat", EQUILIBRIUM),
    ("steady_profile", "density_excess", OPEN | {"gamma": 1.3}),
    ("momentum_flux", "jump", OPEN | {"gamma": 0.3}),
    ("particle_count", "log_slope", {"cells": 6, "times": "1,2.3,4.1"}),
    ("particle_count", "front_exponent", {"cells": 11, "cell_length": "1/N", "times": "20,60,180"}),
]


ELSEWHERE = {"conductivity", "energy_pulse"}  # test_open_chain.py, test_pulse_peak.py


def test_every_program_has_a_case() -> None:
    sampled = {name for name, options in options_of_programs().items() if "seed" in options}
    assert {name for name, _, _ in CASES} == sampled - ELSEWHERE


@pytest.mark.parametrize(("name", "quantity", "options"), CASES)
def test_standard_error_over_seeds(over_seeds: OverSeeds, name: str, quantity: str, options: dict) -> None:
    """Of an array the last element is tested. Detected mistakes: the standard deviation of one replica
    instead of the mean; errors that are wrong by a factor of two."""
    estimates = over_seeds(name, SEEDS, quantity, replicas=REPLICAS, **options)[quantity]
    values, errors = estimates.reshape(2, SEEDS, -1)[:, :, -1]
    assert spread_accepted(values, errors, REPLICAS, LEVEL)
    for factor in (np.sqrt(REPLICAS), 2, 0.5):
        assert not spread_accepted(values, factor * errors, REPLICAS, LEVEL)
