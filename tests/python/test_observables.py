"""The observables of the closed chain against exact results, in another unit of length, and in the smallest
and the largest chains."""

import numpy as np
import pytest

from tests.python.conftest import Measure, OverSeeds
from workflow.lib.load import Quantity


def score(quantity: Quantity, expected: float) -> float:
    return float((quantity.mean - expected) / quantity.standard_error)


def test_waiting_time_exponent(measure: Measure) -> None:
    chain = {"cells": 11, "particles_per_cell": 20, "relaxation_time": 10, "observation_time": 50}
    result = measure("waiting_time", sigma=0.5, replicas=64, **chain)
    assert abs(score(result["exponent"], -2)) < 4
    assert abs(score(result["exponent"], -3)) > 20


FEW = {"cells": 6, "particles_per_cell": 5, "observation_time": 20, "decades": 1, "relaxation_time": 1}


def test_displacement_with_known_momentum(over_seeds: OverSeeds) -> None:
    """Over seeds the corrected estimate and the plain one, of too few replicas for a correction, agree,
    also if scatterers move at the start. The corrected one has the smaller error."""
    moving = {"sigma": 0.8, "scatterer_temperature": 500}
    (reduced, error), (plain, plain_error) = (
        over_seeds("displacement", seeds, "mean_square_displacement", **FEW, **moving, replicas=replicas)[
            "mean_square_displacement"
        ][:, :, -1]
        for seeds, replicas in ((50, 40), (400, 8))
    )

    def difference(factor: float) -> float:
        of_mean = np.hypot(*(each.std(ddof=1) / np.sqrt(len(each)) for each in (factor * reduced, plain)))
        return float(abs(factor * reduced.mean() - plain.mean()) / of_mean)

    assert difference(1) < 4
    # Detected mistake: the known mean square is that of the particles' momentum alone, 5 / (5 + 9) of the
    # total.
    assert difference(5 / 14) > 10
    assert 8 * np.mean(plain_error**2) > 8 * 40 * np.mean(error**2)


def test_displacement_is_confined_between_walls(measure: Measure) -> None:
    """At sigma = 1 every particle is confined between two scatterers; at -1 it flies freely."""
    confined = measure("displacement", sigma=1, observation_time=100, decades=2)["mean_square_displacement"]
    assert confined.mean.max() <= 1
    free = measure("displacement", sigma=-1, observation_time=100, decades=2)
    np.testing.assert_allclose(free["alpha"].mean, 2, atol=1e-9)


def test_pulse_injects_energy_that_is_conserved(measure: Measure) -> None:
    ring = {"cells": 31, "particles_per_cell": 50, "relaxation_time": 0, "times": "0.001,0.01,0.02"}
    result = measure("energy_pulse", replicas=32, pairs_per_replica=4, **ring)
    # The mean energy of 51 degrees of freedom rises from 5000 to 50000 each, and the sum is conserved.
    assert abs(score(result["injected_energy"], 51 * 45000)) < 4
    assert abs(score(result["injected_energy"], 50 * 45000)) > 4
    assert result["sum_error"].mean < 1e-13
    difference = result["energy_difference"]
    sums = difference.mean.sum(axis=1)
    np.testing.assert_allclose(sums, float(result["injected_energy"].mean), rtol=1e-12)


def test_lengths_are_a_matter_of_units(measure: Measure) -> None:
    """A chain in which every rounding differs, but trajectories do not part yet. Detected mistake: an
    absolute length or time, which powers of two as units would not show."""
    chain = {"cells": 11, "particles_per_cell": 20, "relaxation_time": 0, "observation_time": 20, "seed": 5}
    one, three = (
        measure("persistence", **chain, cell_length=unit, temperature=500 * unit**2)["particle_energy"].mean
        / unit**2
        for unit in (1, 3)
    )
    assert one != three
    assert three == pytest.approx(one, rel=1e-12)


@pytest.mark.parametrize(("cells", "time", "limit"), [(1, 1e5, 4e-16), (10**6, 0.05, 3e-14)])
def test_smallest_and_largest_chains_conserve_energy_and_momentum(
    measure: Measure, cells: int, time: float, limit: float
) -> None:
    chain = {"cells": cells, "particles_per_cell": 1, "relaxation_time": 0, "observation_time": time}
    result = measure("persistence", **chain, replicas=2)
    assert max(float(result[name].mean) for name in ("energy_change", "momentum_change")) < limit
