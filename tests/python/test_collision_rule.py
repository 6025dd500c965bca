"""Collision rules of the programs: exact results, and combinations of options that are refused."""

import numpy as np
import pytest

from tests.python.conftest import Measure, Program
from workflow.lib.load import Quantity

UNEQUAL = {"nu_left": 30, "nu_right": 10, "temperature_left": 100, "temperature_right": 400}
RANDOM = {"rule": "random-direction"}
REVERSAL = {"rule": "reversal", "reversal_probability": 0.1}
ROTATION = {"rule": "rotation", "rotation_probability": 0.5}


def score(quantity: Quantity, expected: float | np.ndarray) -> float:
    """Largest absolute z-score of the elements."""
    return float(np.abs((quantity.mean - expected) / quantity.standard_error).max())


@pytest.mark.parametrize(("cells", "gamma"), [(5, "N"), (12, 3)])
@pytest.mark.parametrize("walker", [(RANDOM | {"sigma": -1}, 0.5), (REVERSAL | {"sigma": 0}, 0.1)])
def test_currents_of_independent_walkers(
    measure: Measure, walker: tuple[dict[str, object], float], cells: int, gamma: float | str
) -> None:
    """Scatterers without mass keep the speed of a particle; those of equal mass keep a momentum until the
    next collision. So momenta walk: a scatterer reflects with the probability r = q/2, or q times that of
    the reversal, and a row of N transmits 1/(1 + N r/(1 - r)). Slow particles, which are still inside,
    carry little energy. Detected mistake: the chain has three more scatterers."""
    rule, reflection = walker
    chain = {"cells": cells, "gamma": gamma, "relaxation_time": 50, "observation_time": 400}
    result = measure("conductivity", **chain, **UNEQUAL, **rule, replicas=200)
    reflected = reflection * (1 if gamma == "N" else float(gamma) / cells)

    def current(scatterers: int) -> float:
        injected = (30 * 100 - 10 * 400) / 2
        return injected / (1 + scatterers * reflected / (1 - reflected))

    assert score(result["energy_current"], current(cells)) < 4
    assert score(result["energy_current"], current(cells + 3)) > 6


@pytest.mark.parametrize(
    ("name", "quantity", "rule"),
    [
        ("displacement", "mean_square_displacement", "reversal"),
        ("energy_pulse", "energy_difference", "reversal"),
        ("momentum_flux", "flux", "reversal"),
        ("heat_current", "mean_square_heat", "rotation"),
        ("conductivity", "energy_current", "rotation"),
    ],
)
def test_without_noise_the_rule_is_elastic(measure: Measure, name: str, quantity: str, rule: str) -> None:
    """Bit for bit; but for the rounding of the energy that a collision leaves to the neighbour. Detected
    mistake: one event of the noise in a hundred collisions."""
    elastic = measure(name, (0, 4))[quantity].mean
    never, seldom = (
        measure(name, (0, 4), rule=rule, **{f"{rule}_probability": p})[quantity].mean for p in (0, 0.01)
    )
    rounding = 1e-13 if quantity == "mean_square_heat" else 0
    np.testing.assert_allclose(never, elastic, rtol=rounding)
    assert not np.allclose(seldom, elastic, rtol=1e-9)


@pytest.mark.parametrize("sigma", [-1, 0, 1])
@pytest.mark.parametrize(
    "rule",
    [{"rule": "elastic"}, {"rule": "printed"}, RANDOM, REVERSAL, ROTATION],
    ids=lambda rule: rule["rule"],
)
def test_what_programs_refuse_of_a_rule(program: Program, rule: dict[str, object], sigma: int) -> None:
    """The same at every sigma, but for the paper's formula, which has no limits. The conductivity is in
    test_conductivity.py."""
    name = rule["rule"]
    unlimited = name != "printed" or sigma == 0
    accepted = {
        "waiting_time": unlimited,
        "heat_current": unlimited,
        "energy_pulse": unlimited and name != "rotation",
        "persistence": unlimited and name not in ("random-direction", "reversal"),
    }
    for other, expected in accepted.items():
        zero = {"zero_total_momentum": True} if other == "persistence" else {}
        done = program(other, sigma=sigma, **rule, **zero)
        assert done.returncode in ((0, 4) if expected else (2,)), (other, done.stderr)
