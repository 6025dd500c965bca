"""Programs in a unit of length that is no power of two (test_units.py has these), and the smallest and the
largest chains."""

import pytest

from tests.python.conftest import Measure


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
