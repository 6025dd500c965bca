"""Claims on the conductivity against the size (fig. 8, section 6), and on heat in equilibrium."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from workflow.lib.caption import format_number
from workflow.lib.load import Result
from workflow.study.results import MissingError, Results, by_size, combination, estimate, log_slope, power
from workflow.study.rings import chain, gas
from workflow.study.verdict import Estimate

LARGE = 4  # the largest sizes are those within this factor of the largest: two octaves
LONG = 128  # cells; in shorter chains the exponents over the largest sizes still change
LATE = 64  # time in λ/√T from which the exponents of rings are judged: earlier ones still fall
DISTURBED = 0.1  # fraction of the collisions that are followed by a rotation or by a reversal
# Series: of fig. 8 by γ, and rings with the paper's rule.
SIZES: dict[str | int, tuple[str, ...]] = {
    "N": ("deterministic", "deterministic-large"),
    1: ("rare", "rare-small"),
}
ELASTIC = ("light", "light-long", "light-longest", "dense-longest", "dilute-longest", "sparse-longest")


def linear(data: Results) -> list[Estimate]:
    """Exponent of kappa at gamma = 1 over the largest sizes."""
    return [of_largest(data, 1)]


def of_largest(data: Results, gamma: str | int) -> Estimate:
    """Exponent of kappa over the largest sizes of fig. 8. Raises MissingError if they are small."""
    runs = sizes(data, gamma)
    if not runs or runs[-1].parameters["cells"] < LONG:
        raise MissingError(f"no stationary size of {LONG} cells or more at γ = {gamma}")
    largest = [run for run in runs if run.parameters["cells"] * LARGE >= runs[-1].parameters["cells"]]
    return exponent(largest, f"d ln κ/d ln N, γ = {gamma}")


def sizes(data: Results, gamma: str | int) -> list[Result]:
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


def cube_root(data: Results) -> list[Estimate]:
    """Exponent of kappa at gamma = N over the largest sizes."""
    return [of_largest(data, "N")]


def superdiffusive(data: Results) -> list[Estimate]:
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


def without_momentum(data: Results) -> list[Estimate]:
    """Local exponent of kappa where a fraction DISTURBED of the collisions is followed by a rotation, which
    conserves momentum, minus that where as many reverse the scatterer, which does not: of chains between the
    two largest sizes that both have, and beta - 1 of rings over the last octave that both have."""
    rotated, reversed_ = (
        {chain.parameters["cells"]: chain for chain in _stationary(chains)}
        for chains in _disturbed(data, "chain-rotation", "chain-reversal")
    )
    common = sorted(rotated.keys() & reversed_.keys())[-2:]
    of_chains = [
        exponent([chains[size] for size in common], "d ln κ/d ln N") for chains in (rotated, reversed_)
    ]
    rings = [max(runs, key=_last_time) for runs in _disturbed(data, "rotation", "reversal")]
    octaves = set.intersection(*(set(_middles(ring)) for ring in rings))
    if not octaves:
        raise MissingError("the rings with rotation and with reversal have no octave in common")
    time = max(octaves)
    of_rings = [estimate(ring, "local_exponent", _middles(ring).index(time)) for ring in rings]
    label = "rotation minus reversal,"
    return [
        combination(of_chains, [1, -1], f"{label} {of_chains[0].label}"),
        combination(of_rings, [1, -1], f"{label} β, t = {time:.0f}"),
    ]


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


def _longest(rings: Sequence[Result]) -> list[Result]:
    """The ring of longest time of every gas."""
    longest = {gas(ring): ring for ring in sorted(rings, key=_last_time)}
    found = [ring for ring in longest.values() if _last_time(ring) > LATE]
    if not found:
        raise MissingError(f"no ring was observed beyond t = {LATE}")
    return found


def _gas(ring: Result) -> str:
    scaled = chain(ring)
    zeta, mass = (format_number(float(f"{value:.13g}")) for value in (scaled.zeta, scaled.mass))
    return f"ζ = {zeta}, M = {mass}"


def _last_time(ring: Result) -> float:
    """Geometric middle of the last octave of time."""
    return _middles(ring)[-1]
