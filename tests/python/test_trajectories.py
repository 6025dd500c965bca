"""The flights of `trajectories` against eq. 2 at every collision, and against another simulation."""

import heapq
import itertools
from collections.abc import Callable

import numpy as np
import pandas as pd
import pytest

from tests.python.conftest import Measure

CELLS, SPACING, SIGMA, END = 5, 0.5, 0.3, 15
LENGTH = CELLS * SPACING
C = np.sqrt(1 - SIGMA**2)
CHAINS = {
    "closed": {"particles_per_cell": 3, "relaxation_time": 7, "scatterer_temperature": 1},
    "open": {"nu_left": 3, "nu_right": 4, "relaxation_time": 7},
}
SCATTERERS_AT_REST = {
    "closed": {"particles_per_cell": 3, "relaxation_time": 0, "scatterer_temperature": 0},
    "open": {"nu_left": 1, "nu_right": 2, "relaxation_time": 0, "start": "empty"},
}
Flights = Callable[..., pd.DataFrame]


@pytest.fixture
def flights(measure: Measure) -> Flights:
    def run(chain: str, **options: object) -> pd.DataFrame:
        fixed = {"cells": CELLS, "sigma": SIGMA, "cell_length": SPACING, "observation_time": END}
        quantities = measure("trajectories", chain=chain, **fixed, **options).quantities
        return pd.DataFrame({name: quantity.mean for name, quantity in quantities.items()})

    return run


def differ(a: float, b: float) -> bool:
    return not abs(a - b) < 1e-9


def violations(table: pd.DataFrame, ring: bool) -> set[str]:
    """Violations of free flight, of continuity, of eq. 2 and of the conservation of energy."""
    violated = set()
    moved = table.momentum * (table.end_time - table.start_time)
    if not np.allclose(table.end_position - table.start_position, moved, rtol=0, atol=1e-9):
        violated.add("a flight is not free")
    collisions = []
    for _, line in table.groupby("particle"):
        rows = [*line.itertuples()]
        for before, after in itertools.pairwise(rows):
            end = before.end_position % LENGTH if ring else before.end_position
            if differ(before.end_time, after.start_time) or differ(end, after.start_position):
                violated.add("a world line is broken")
            collisions.append((after.start_time, before.momentum, after))
        if rows[-1].end_time < END and (ring or rows[-1].end_position not in (0, LENGTH)):
            violated.add("a world line is broken")
    scatterers: dict[float, float] = {}
    for _, u, after in sorted(collisions, key=lambda collision: collision[0]):
        u_after, w_after = after.momentum, after.scatterer_momentum
        w = scatterers.get(after.start_position, (u_after + SIGMA * u) / C)
        if differ(u_after, C * w - SIGMA * u) or differ(w_after, C * u + SIGMA * w):
            violated.add("a collision violates eq. 2")
        if differ(u_after**2 + w_after**2, u**2 + w**2):
            violated.add("energy is not conserved")
        scatterers[after.start_position] = w_after
    return violated


@pytest.mark.parametrize("gamma", ["N", 1])
@pytest.mark.parametrize("chain", CHAINS)
def test_flights_join_and_collisions_follow_eq_2(flights: Flights, chain: str, gamma: object) -> None:
    table = flights(chain, gamma=gamma, **CHAINS[chain])
    ring = chain == "closed"
    collided = table.index[
        table.scatterer_momentum.notna() & table.duplicated("particle", keep="last") & (table.particle > 0)
    ]
    assert len(collided) > 10
    assert violations(table, ring) == set()
    for column, factor, words in (
        ("momentum", -1, "a flight is not free"),
        ("end_time", 1.01, "a world line is broken"),
        ("particle", -1, "a world line is broken"),
        ("scatterer_momentum", -1, "a collision violates eq. 2"),
        ("scatterer_momentum", 1.01, "energy is not conserved"),
    ):
        mutant = table.copy()
        mutant.loc[collided[5], column] *= factor
        assert words in violations(mutant, ring)


def collisions(first_flights: pd.DataFrame, ring: bool) -> list[tuple[float, float, float]]:
    """Times, positions and momenta after all collisions of the particles with these first flights, at gamma = N,
    with scatterers at rest at first."""
    scatterers, collided = [0.0] * CELLS, []
    arrivals: list[tuple[float, int, float]] = []

    def fly(time: float, distance: float, cell: int, u: float) -> None:
        if u != 0 and (ring or 0 <= cell < CELLS):
            heapq.heappush(arrivals, (time + distance / abs(u), cell % CELLS, u))

    for flight in first_flights.itertuples():
        passed = flight.start_position / SPACING - 0.5  # number of scatterers to the left, as a real number
        cell = int(np.floor(passed) + 1 if flight.momentum > 0 else np.ceil(passed) - 1)
        fly(flight.start_time, abs(cell - passed) * SPACING, cell, flight.momentum)
    while arrivals and arrivals[0][0] < END:
        time, cell, u = heapq.heappop(arrivals)
        u, scatterers[cell] = C * scatterers[cell] - SIGMA * u, C * u + SIGMA * scatterers[cell]
        collided.append((time, (cell + 0.5) * SPACING, u))
        fly(time, SPACING, cell + int(np.sign(u)), u)
    return collided


@pytest.mark.parametrize("chain", SCATTERERS_AT_REST)
def test_all_collisions_are_those_of_another_simulation(flights: Flights, chain: str) -> None:
    table = flights(chain, **SCATTERERS_AT_REST[chain])
    first, ring = table[table.scatterer_momentum.isna()], chain == "closed"
    simulated = table[table.scatterer_momentum.notna()][
        ["start_time", "start_position", "momentum"]
    ].to_numpy()
    expected = np.array(collisions(first, ring))
    assert len(expected) > 50
    assert simulated.shape == expected.shape
    assert np.abs(simulated - expected).max() < 1e-6  # rounding errors grow with the number of collisions
    assert len(collisions(first.iloc[1:], ring)) != len(simulated)  # detected mistake: a particle is missing


def test_a_later_window_cuts_the_same_flights(flights: Flights) -> None:
    early, late = (
        flights("closed", relaxation_time=time, particles_per_cell=3, scatterer_temperature=1)
        for time in (0, 5)
    )
    expected = early[(early.start_time > 5) & early.scatterer_momentum.notna()]
    shifted = late[(late.start_time < END - 5) & late.scatterer_momentum.notna()]
    assert np.allclose(expected.start_time - 5, shifted.start_time.to_numpy(), rtol=0, atol=1e-6)
    assert np.allclose(expected.momentum, shifted.momentum.to_numpy(), rtol=0, atol=1e-6)
