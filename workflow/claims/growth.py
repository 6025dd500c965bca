"""Claims on the conductivity against the size (fig. 8, section 6), and on heat in equilibrium."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from workflow.claims.data import (
    Data,
    MissingError,
    by_size,
    combination,
    estimate,
    log_slope,
    power,
)
from workflow.claims.verdict import Estimate
from workflow.lib.caption import format_number
from workflow.lib.load import Result
from workflow.physics import run_parameters
from workflow.physics.rings import chain

T = TypeVar("T")

BULK = 16  # cells; shorter chains are dominated by their ends
LARGE = 16  # the largest sizes are those within this factor of the largest
LONG = 128  # cells; in shorter chains the exponents over the largest sizes still change
LATE = 64  # time in λ/√T from which the exponents of rings are judged: earlier ones still fall
DISTURBED = 0.1  # fraction of the collisions that are replaced by a pass or followed by a reversal
# Series: of fig. 8 by γ, and rings with the paper's rule.
SIZES: dict[str | int, tuple[str, ...]] = {"N": ("every", "every-large"), 1: ("rare", "rare-small")}
ELASTIC = ("light", "light-long", "light-longest", "dense-longest", "dilute-longest", "sparse-longest")


def linear(data: Data) -> list[Estimate]:
    """Exponent of kappa at gamma = 1 over the largest sizes."""
    return [of_largest(data, 1)]


def of_largest(data: Data, gamma: str | int) -> Estimate:
    """Exponent of kappa over the largest sizes of fig. 8. Raises MissingError if they are small."""
    runs = sizes(data, gamma)
    if not runs or runs[-1].parameters["cells"] < LONG:
        raise MissingError(f"no stationary size of {LONG} cells or more at γ = {gamma}")
    largest = [run for run in runs if run.parameters["cells"] * LARGE >= runs[-1].parameters["cells"]]
    return exponent(largest, f"d ln κ/d ln N, γ = {gamma}")


def sizes(data: Data, gamma: str | int) -> list[Result]:
    """Stationary runs of fig. 8 at the paper's spacing, by N."""
    return _stationary(data.results("fig08", *SIZES[gamma]))


def _stationary(runs: Iterable[Result]) -> list[Result]:
    return by_size(run for run in runs if run.usable)


def exponent(runs: Sequence[Result], name: str) -> Estimate:
    """Exponent of the conductivity against the number of cells, over the sizes of the runs. Raises
    MissingError for fewer than two."""
    cells = [run.parameters["cells"] for run in runs]
    if len(runs) < 2:
        raise MissingError("fewer than two stationary sizes")
    return power(cells, [estimate(run, "kappa") for run in runs], f"{name}, N = {cells[0]} to {cells[-1]}")


def smaller_and_larger(by_size: Sequence[T]) -> list[Sequence[T]]:
    """The smaller and the larger sizes, with the middle one in both. A power law has the same exponent in
    both halves."""
    middle = len(by_size) // 2
    return [part for part in (by_size[: middle + 1], by_size[middle:]) if len(part) > 1]


def cube_root(data: Data) -> list[Estimate]:
    """Exponents of kappa over the smaller and over the larger half of fig. 8's sizes at gamma = N, which
    agree for a power law."""
    parts = smaller_and_larger(_with_bulk(sizes(data, "N")))
    if not parts:
        raise MissingError("fewer than two stationary sizes")
    return [exponent(part, "d ln κ/d ln N, γ = N") for part in parts]


def _with_bulk(runs: Sequence[Result]) -> list[Result]:
    return [run for run in runs if run.parameters["cells"] >= BULK]


def superdiffusive(data: Data) -> list[Estimate]:
    """beta of <Q²> ∼ t^beta, from t = LATE on in the longest ring of every gas that was measured so long.
    The errors of both ends are taken as independent, which overestimates that of their ratio."""
    numbers = []
    for ring in _longest(data.results("momentum", *ELASTIC)):
        times = ring["heat_variance"].axes["time"]
        first = int(np.searchsorted(times, LATE))
        early, late = (estimate(ring, "heat_variance", k) for k in (first, -1))
        label = f"β, {_gas(ring)}, t = {times[first]:g} to {times[-1]:g}"
        numbers.append(replace(log_slope(early, late, times[-1] / times[first]), label=label))
    return numbers


def without_momentum(data: Data) -> list[Estimate]:
    """Local exponent of kappa where a particle passes a scatterer with the probability DISTURBED, which
    conserves momentum, minus that where this fraction of the collisions reverses the scatterer, which does
    not: of chains between the two largest sizes that both have, and beta - 1 of rings over the last octave
    that both have."""
    passing, reversed_ = (
        {chain.parameters["cells"]: chain for chain in _stationary(chains)}
        for chains in _disturbed(data, "chain-passing", "chain-reversal")
    )
    common = sorted(passing.keys() & reversed_.keys())[-2:]
    of_chains = [
        exponent([chains[size] for size in common], "d ln κ/d ln N") for chains in (passing, reversed_)
    ]
    rings = [max(runs, key=_last_time) for runs in _disturbed(data, "passing", "reversal")]
    octaves = set.intersection(*(set(_middles(ring)) for ring in rings))
    if not octaves:
        raise MissingError("the rings with passing and with reversal have no octave in common")
    time = max(octaves)
    of_rings = [estimate(ring, "local_exponent", _middles(ring).index(time)) for ring in rings]
    label = "passing minus reversal,"
    return [
        combination(of_chains, [1, -1], f"{label} {of_chains[0].label}"),
        combination(of_rings, [1, -1], f"{label} β, t = {time:.0f}"),
    ]


def _disturbed(data: Data, passing: str, reversal: str) -> tuple[list[Result], list[Result]]:
    """Runs of both series in which DISTURBED is the probability of the disturbance. Raises MissingError
    without one."""
    runs = (
        [run for run in data.results("momentum", passing) if run_parameters.passing(run) == DISTURBED],
        data.results("momentum", reversal, reversal_probability=DISTURBED),
    )
    if not runs[0]:
        raise MissingError(f"no run of {passing} in which a fraction of {DISTURBED:g} passes")
    return runs


def _middles(ring: Result) -> list[float]:
    """Middles of the octaves of a ring."""
    return [*map(float, ring["local_exponent"].axes["middle"])]


def _longest(rings: Sequence[Result]) -> list[Result]:
    """The ring of longest time of every gas."""
    longest = {_gas(ring): ring for ring in sorted(rings, key=_last_time)}
    found = [ring for ring in longest.values() if _last_time(ring) > LATE]
    if not found:
        raise MissingError(f"no ring was observed beyond t = {LATE}")
    return found


def _gas(ring: Result) -> str:
    gas = chain(ring)
    return f"ζ = {format_number(gas.zeta)}, M = {format_number(gas.mass)}"


def _last_time(ring: Result) -> float:
    """Geometric middle of the last octave of time."""
    return _middles(ring)[-1]
