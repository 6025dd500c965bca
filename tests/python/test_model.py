"""The picture of the model has flights that are free, join, and exchange momentum as eq. 1 states."""

import itertools

import numpy as np
import pandas as pd
import pytest

from workflow.figures.model import CELLS, SIGMA, TIME, flights


def violations(table: pd.DataFrame, ring: bool, sigma: float = SIGMA) -> set[str]:
    """What the flights violate. The momentum of a scatterer follows from the first collision and is
    compared from the second one on."""
    violated = set()
    moved = table.momentum * (table.end_time - table.start_time)
    if not np.allclose(table.end_position - table.start_position, moved, rtol=0, atol=1e-9):
        violated.add("a flight is not free")
    collisions = []
    for _, line in table.groupby("particle"):
        rows = [*line.itertuples()]
        for before, after in itertools.pairwise(rows):
            end = before.end_position % CELLS if ring else before.end_position
            if max(abs(before.end_time - after.start_time), abs(end - after.start_position)) > 1e-9:
                violated.add("a world line is broken")
            collisions.append((after.start_time, after.start_position, before.momentum, after.momentum))
        if rows[-1].end_time < TIME and (ring or rows[-1].end_position not in (0, CELLS)):
            violated.add("a world line is broken")
    scatterers: dict[float, float] = {}
    for _, position, p, p_after in sorted(collisions):
        found = (p_after + sigma * p) / (1 - sigma)
        if abs(scatterers.get(position, found) - found) > 1e-9:
            violated.add("a collision violates eq. 1")
        scatterers[position] = (1 + sigma) * p + sigma * found
    return (
        violated if set(scatterers) <= {*(np.arange(CELLS) + 0.5)} else violated | {"no scatterer is there"}
    )


@pytest.mark.parametrize("ring", [True, False])
def test_flights_follow_the_model(ring: bool) -> None:
    table = flights(ring, seed=2)
    assert len(table) > 50
    assert violations(table, ring) == set()
    assert violations(table, ring, -SIGMA) == {"a collision violates eq. 1"}
