"""Claims on the profiles of an open chain (fig. 2, section 3)."""

from dataclasses import replace

from workflow.lib.load import Result
from workflow.study.results import Results, combination, estimate, ratio
from workflow.study.verdict import Estimate

RUNS = {"deterministic": "γ = N", "rare": "γ = 1"}
DEVIATIONS = (  # quantity, label, number of the first scatterer or bond
    ("rate_right", "(rate to the right - line)/mean, scatterer", 1),
    ("rate_left", "(rate to the left - line)/mean, scatterer", 1),
    ("particle_current", "(particle current - mean)/rate, bond", 0),
)


def _both(data: Results) -> list[tuple[Result, str]]:
    return [(data.one("fig02_upper", run), name) for run, name in RUNS.items()]


def temperatures_mismatch(data: Results) -> list[Estimate]:
    """The end cells' temperatures lie between those of the baths, and the profile is less steep at gamma =
    1."""
    jumps = []
    for result, name in _both(data):
        low, high = result.ends("temperature")
        scale = high - low
        first = estimate(result, "temperature_scatterer", 0, f"(T₁ - T_L)/(T_R - T_L), {name}")
        last = estimate(result, "temperature_scatterer", -1, f"(T_R - T_N)/(T_R - T_L), {name}")
        jumps += [first / scale - low / scale, last / -scale - -high / scale]
    steeper = combination(jumps, [-1, -1, 1, 1], "(T_N - T₁)/(T_R - T_L), γ = N minus γ = 1")
    return [*jumps, steeper]


def temperatures_coincide(data: Results) -> list[Estimate]:
    """T of the scatterer minus T of the particles in every cell, relative to the latter."""
    numbers = []
    for result, name in _both(data):
        for k, local in enumerate(result["temperature_particle"].mean):
            label = f"T of scatterer/T of particles - 1 in cell {k + 1}, {name}"
            numbers.append(estimate(result, "temperature_difference", k, label) / local)
    return numbers


def density_profiles(data: Results) -> list[Estimate]:
    """Slope of the density in the bulk at gamma = 1 over that at gamma = N, and excess of particles in
    both end cells over the line through the bulk."""
    both = [result for result, _ in _both(data)]
    above, below = (estimate(profile, "density_slope") for profile in reversed(both))
    slope = ratio(above, below, "")
    less = replace(slope / -1 - -1, label="1 - slope(γ = 1)/slope(γ = N)")
    excess = []
    for end, name in enumerate(("first", "last")):
        ends = [estimate(profile, "density_excess", end) for profile in both]
        excess.append(combination(ends, [-1, 1], f"excess of the {name} cell, γ = 1 minus γ = N"))
    return [less, *excess]


def linear_rates(data: Results) -> list[Estimate]:
    """Deviations of the rates from a straight line and of the current from its mean, over the mean rate. At
    the end scatterers a bath determines one of the rates."""
    numbers = []
    for result, name in _both(data):
        scale = float(result["rate_right"].mean.mean())
        for quantity, words, first in DEVIATIONS:
            count = len(result[f"{quantity}_deviation"].mean)
            for k in range(1, count - 1) if quantity.startswith("rate") else range(count):
                label = f"{words} {k + first}, {name}"
                numbers.append(estimate(result, f"{quantity}_deviation", k, label) / scale)
    return numbers
