"""Claims on the conductivity against the size (fig. 8, section 6), and on heat in equilibrium."""

import math
from collections.abc import Iterable
from itertools import pairwise

from workflow.lib.load import Result
from workflow.study.results import (
    MissingError,
    Results,
    by_size,
    combination,
    estimate,
    octave,
    power_law,
)
from workflow.study.rings import chain, texts
from workflow.study.verdict import Estimate

FIRST = 32  # cells from which power laws of kappa are judged: shorter chains consist mainly of their ends
DISTURBED = 0.1  # fraction of the collisions that are followed by a rotation or by a reversal
# Series: of fig. 8 by γ.
SIZES: dict[str | int, tuple[str, ...]] = {
    "N": ("deterministic", "deterministic-large"),
    1: ("rare", "rare-small"),
}
GASES = ("light-longest", "dense-longest", "dilute-longest", "sparse-longest")  # rings without noise


def linear(data: Results) -> list[Estimate]:
    """Exponent of kappa at gamma = 1, or those of its octaves."""
    return power_law(conductivities(data, 1), FIRST, "d ln κ/d ln N, γ = 1")


def cube_root(data: Results) -> list[Estimate]:
    """Exponent of kappa at gamma = N, or those of its octaves."""
    return power_law(conductivities(data, "N"), FIRST, "d ln κ/d ln N, γ = N")


def conductivities(data: Results, gamma: str | int) -> dict[int, Estimate]:
    """Conductivities of fig. 8 at the paper's spacing, by N."""
    return _by_cells(data.results("fig08", *SIZES[gamma]))


def _by_cells(runs: Iterable[Result]) -> dict[int, Estimate]:
    """Conductivities of stationary runs by N, ascending."""
    return {run.parameters["cells"]: estimate(run, "kappa") for run in by_size(runs) if run.usable}


def superdiffusive(data: Results) -> list[Estimate]:
    """beta of <Q²> ∼ t^beta in the last octave of the longest ring of every gas. A gas that was not observed is
    unknown: fewer decide less."""
    found = {ring.series: ring for ring in data.results("momentum", *GASES)}
    return [
        estimate(found[gas], "local_exponent", -1, f"β, {_named(found[gas])}")
        if gas in found
        else Estimate(f"β, {gas}", math.nan, math.nan)
        for gas in GASES
    ]


def _named(ring: Result) -> str:
    gas = chain(ring)
    zeta, mass = texts(gas.zeta, gas.mass)
    return f"ζ = {zeta}, M = {mass}, t = {_last_time(ring):.0f}"


def without_momentum(data: Results) -> list[Estimate]:
    """Exponent where a fraction DISTURBED of the collisions is followed by a rotation, which conserves momentum,
    minus that where as many reverse the scatterer, which does not: of <Q²> in rings over the last octave that both
    have, and of kappa in the chains of fig. 8 between all neighbouring sizes from FIRST on that both have."""
    rings = [max(runs, key=_last_time) for runs in _disturbed(data, "rotation", "reversal")]
    octaves = set.intersection(*(set(_middles(ring)) for ring in rings))
    if not octaves:
        raise MissingError("the rings with rotation and with reversal have no octave in common")
    time = max(octaves)
    of_rings = [estimate(ring, "local_exponent", _middles(ring).index(time)) for ring in rings]
    label = "rotation minus reversal,"
    chains = [_by_cells(runs) for runs in _disturbed(data, "chain-rotation", "chain-reversal")]
    common = sorted(size for size in chains[0].keys() & chains[1].keys() if size >= FIRST)
    of_chains = [
        combination(
            [octave(values, a, b, "") for values in chains], [1, -1], f"{label} d ln κ/d ln N, N = {a} to {b}"
        )
        for a, b in pairwise(common)
    ]
    return [combination(of_rings, [1, -1], f"{label} β, t = {time:.0f}"), *of_chains]


def _disturbed(data: Results, rotation: str, reversal: str) -> tuple[list[Result], list[Result]]:
    """Runs of both series in which a fraction DISTURBED of the collisions is disturbed. Raises MissingError
    without one."""
    return (
        data.results("momentum", rotation, rotation_probability=DISTURBED),
        data.results("momentum", reversal, reversal_probability=DISTURBED),
    )


def _middles(ring: Result) -> list[float]:
    """Middles of the octaves of a ring."""
    return [*map(float, ring["local_exponent"].axes["middle"])]


def _last_time(ring: Result) -> float:
    """Geometric middle of the last octave of time."""
    return _middles(ring)[-1]
