"""Claims on the conductivity against the size (fig. 8, section 6), and on heat in equilibrium."""

import math
from collections.abc import Mapping, Sequence

from workflow.lib.load import Result
from workflow.study.results import Results, by_size, combination, estimate, octaves
from workflow.study.rings import SIZES, chain, last_exponent, texts
from workflow.study.verdict import Estimate

FIRST = 32  # cells from which power laws of kappa are judged: shorter chains consist mainly of their ends
LONGEST = ("", "-long", "-longest")  # ends of the names of the series of a gas
GASES = ("light", "dense", "sparse", "thin")  # rings without noise
RULES = ("rotation", "reversal")
DISTURBED = ("light", "thin")  # those also with noise in 10 % of the collisions


def linear(data: Results) -> list[Estimate]:
    """Exponents of kappa at gamma = 1, by octave."""
    return octaves(_conductivities(data, "rare", "rare-small"), FIRST, "d ln κ/d ln N, γ = 1")


def cube_root(data: Results) -> list[Estimate]:
    """Exponents of kappa at gamma = N, by octave."""
    found = _conductivities(data, "deterministic", "deterministic-large")
    return octaves(found, FIRST, "d ln κ/d ln N, γ = N")


def _conductivities(data: Results, *series: str) -> dict[int, Estimate]:
    """Conductivities of the stationary runs of fig. 8 by N, ascending."""
    runs = by_size(data.results("fig08", *series))
    return {run.parameters["cells"]: estimate(run, "kappa") for run in runs if run.usable}


def superdiffusive(data: Results) -> list[Estimate]:
    """beta of <Q²> ∼ t^beta in the last octave before sound crosses the chain, in the gases of the chains of
    fig. 8 from N = 16 on."""
    return _exponents(data, {f"gas-{cells}": (f"gas-{cells}",) for cells in SIZES})


def superdiffusive_at_fixed_density(data: Results) -> list[Estimate]:
    """beta of <Q²> ∼ t^beta in the last octave of the longest ring of every gas of a fixed density."""
    return _exponents(data, {gas: tuple(gas + end for end in LONGEST) for gas in GASES})


def _exponents(data: Results, gases: Mapping[str, tuple[str, ...]]) -> list[Estimate]:
    """beta in the last octave of the longest ring of every gas, given with its series. A gas that was not
    observed is unknown: fewer decide less."""
    rings = data.results("momentum", *(series for names in gases.values() for series in names))
    found = {gas: _longest(rings, *names) for gas, names in gases.items()}
    return [
        estimate(ring, "local_exponent", -1, f"β, {_named(ring)}") if ring else _unknown(f"β, {gas}")
        for gas, ring in found.items()
    ]


def without_momentum(data: Results) -> list[Estimate]:
    """beta where a fraction of the collisions is followed by a rotation, which conserves momentum, minus that
    where as many reverse the scatterer, which does not, in the last octave of two gases."""
    rings = data.results("momentum", *(f"{gas}-{rule}" for gas in DISTURBED for rule in RULES))
    label, numbers = "rotation minus reversal, β", []
    for gas in DISTURBED:
        both = [_longest(rings, f"{gas}-{rule}") for rule in RULES]
        known = [ring for ring in both if ring]
        if len({_last_time(ring) for ring in known}) == 1 and len(known) == len(both):
            exponents = [estimate(ring, "local_exponent", -1) for ring in known]
            numbers.append(combination(exponents, [1, -1], f"{label}, {_named(known[0])}"))
        else:
            numbers.append(_unknown(f"{label}, {gas}"))
    return numbers


def _longest(rings: Sequence[Result], *series: str) -> Result | None:
    """The ring of these series with the latest octave."""
    return max((ring for ring in rings if ring.series in series), key=_last_time, default=None)


def _unknown(label: str) -> Estimate:
    return Estimate(label, math.nan, math.nan)


def _named(ring: Result) -> str:
    gas = chain(ring)
    zeta, mass = texts(gas.zeta, gas.mass)
    return f"ζ = {zeta}, M = {mass}, t = {_last_time(ring):.0f}"


def _last_time(ring: Result) -> float:
    """Geometric middle of the last octave of time."""
    return last_exponent(ring)[0]
