"""Programs at the limits of their options: masses next to the extreme ones, other units, the smallest and
the largest chains."""

import pytest

from tests.python.conftest import Measure
from workflow.lib.load import Result

CLOSED = {"cells": 3, "particles_per_cell": 2, "relaxation_time": 0, "gamma": 2, "replicas": 3}
BATHS = {"cells": 3, "start": "empty", "relaxation_time": 0, "replicas": 3}
ENERGIES = {"particle_energy": 4.0, "scatterer_energy": 4.0, "mu": 1.0}
CURRENTS = {"energy_current": 8.0, "particle_current": 2.0, "temperature_first": 4.0}


def in_units(measure: Measure, name: str, sigma: float, k: int) -> Result:
    """Result with the unit of velocity 2^-k."""
    if name == "persistence":
        options = CLOSED | {"temperature": 4.0**k, "observation_time": 2.0 ** (3 - k)}
    else:
        rates = dict.fromkeys(("nu_left", "nu_right"), 20 * 2.0**k)
        temperatures = {"temperature_left": 4.0**k, "temperature_right": 1e8 * 4.0**k}
        options = BATHS | rates | temperatures | {"observation_time": 2.0**-k}
    return measure(name, (0, 4), **options, sigma=sigma)  # 4: the target quantity has no error


@pytest.mark.parametrize("sigma", [1, 1 - 1e-9, 0.3, 5e-324, -1])
@pytest.mark.parametrize(("name", "units"), [("persistence", ENERGIES), ("conductivity", CURRENTS)])
def test_velocities_are_a_matter_of_units(
    measure: Measure, name: str, units: dict[str, float], sigma: float
) -> None:
    """A power of two as the unit of velocity leaves results bitwise unchanged, also far from 1. Errors are
    sums of squares, which are accumulated as roots and rounded once more."""
    plain = in_units(measure, name, sigma, 0)
    for k in (-30, 30):
        other = in_units(measure, name, sigma, k)
        for quantity, unit in units.items():
            assert other[quantity].mean == plain[quantity].mean * unit**k, quantity
            error = float(plain[quantity].standard_error)
            expected = pytest.approx(error * unit**k, rel=1e-14, nan_ok=True)
            assert float(other[quantity].standard_error) == expected, quantity


def test_lengths_are_a_matter_of_units(measure: Measure) -> None:
    """A chain in which every rounding differs, but trajectories do not part yet. Detected mistake: an absolute
    length or time, which powers of two as units would not show."""
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
