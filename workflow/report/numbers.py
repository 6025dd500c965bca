"""Numbers, gases and sizes quoted in questions.yaml and misprints.yaml by the name of their function; none decides a claim."""

from collections.abc import Sequence
from typing import Any

from workflow.claims.data import Data, MissingError, number
from workflow.claims.growth import (
    BULK,
    between_baths,
    exponent,
    halves,
    largest_sizes,
    last_exponent,
    sizes,
    without_particle_current,
)
from workflow.claims.verdict import Number
from workflow.figures import ext13
from workflow.lib import caption
from workflow.lib.load import Result
from workflow.lib.style import spacing
from workflow.report.words import value


def kappa_of_small_chains(data: Data) -> Number:
    return _kappa_of_half(data, 0)


def kappa_of_large_chains(data: Data) -> Number:
    return _kappa_of_half(data, -1)


def _kappa_of_half(data: Data, half: int) -> Number:
    return exponent(_half(data, half), "d ln κ/d ln N, γ = N, spacing 1/N")[0]


def _half(data: Data, half: int) -> Sequence[Result]:
    """Runs of fig. 8 with the smaller (0) or larger (-1) sizes."""
    return halves([one for one in sizes(data, "N") if one.parameters["cells"] >= BULK])[half]


def middle_size(data: Data) -> str:
    """Where the smaller sizes of fig. 8 end and the larger ones begin."""
    return f"N = {_half(data, -1)[0].parameters['cells']}"


def kappa_at_fixed_density(data: Data) -> str:
    """Exponents of κ between baths, from the two largest sizes of every fixed spacing."""
    series = [between_baths(data, name) for name in ("dilute", "dense")]
    found = [f"{value(last_exponent(runs))} (λ = {spacing(runs[-1])[1]})" for runs in series if len(runs) > 1]
    if not found:
        raise MissingError("Fewer than two sizes of ext09 are stationary at this quality")
    return caption.listed(found)


def heat_exponent(data: Data) -> Number:
    """Exponent of <Q²> over the last octave of the ring that was observed for the longest time."""
    ring = _longest(data)
    gas, middle = ext13.chain(ring), ring["local_exponent"].axes["middle"][-1]
    label = (
        f"d ln⟨Q²⟩/d ln t at ζ = {caption.number(gas.zeta)}, M = {caption.number(gas.mass)}, t = {middle:.0f}"
    )
    return number(ring, "local_exponent", -1, label)


def heat_exponent_without_momentum(data: Data) -> Number:
    return number(_control(data), "local_exponent", -1)


def heat_exponent_with_momentum(data: Data) -> Number:
    """Exponent in the gas of the runs with random directions."""
    gas = _control(data).parameters
    return number(_longest(data, sigma=gas["sigma"], fugacity=gas["fugacity"]), "local_exponent", -1)


def _control(data: Data) -> Result:
    (result,) = data.of("ext13", rule="random-direction")
    return result


def kappa_0_exponent(data: Data) -> Number:
    return without_particle_current(data)


def _longest(data: Data, **gas: Any) -> Result:
    rings = data.of("ext13", rule="elastic", **gas)
    return max(rings, key=lambda one: float(one["heat_variance"].axes["time"][-1]))


def momentum_change(data: Data) -> Number:
    """The largest over all mass ratios."""
    runs = [one for one in data.of("fig07_inset") if one.parameters["sigma"]]
    return max((number(one, "momentum_drift") for one in runs), key=lambda one: one.value)


def alpha(data: Data) -> Number:
    return number(data.of("fig07")[0], "alpha", label="α, σ = 1/2")


def alpha_without_drift(data: Data) -> Number:
    """Of the chain that relaxed longest."""
    runs = data.of("ext01", sigma=0.5, zero_total_momentum=True, particles_per_cell=20)
    relaxed = max(runs, key=lambda one: one.parameters["relaxation-time"])
    return number(relaxed, "alpha", label="α at zero total momentum, σ = 1/2")


def persistence_at_zero(data: Data) -> Number:
    return _persistence(data, 0, "μ at σ = 0, where the integral as printed gives 1/4")


def persistence_at_half(data: Data) -> Number:
    return _persistence(data, 0.5, "μ at σ = 0.5")


def _persistence(data: Data, sigma: float, label: str) -> Number:
    return number(data.of("fig05", particles_per_cell=320, sigma=sigma)[0], "mu", label=label)


def injected_energy(data: Data) -> Number:
    """The right half at the left end is what the bath injects."""
    result = data.of("ext10", "momentum_flux", gamma="N")[0]
    label = "energy over νT that crosses the left opening inwards"
    return number(result, "square", (0, 1), label).over(2 * result.parameters["temperature-left"])


def printed_conductivity(data: Data) -> Number:
    runs = largest_sizes(sizes(data, 1))
    return exponent(runs, "exponent of κ as printed, γ = 1", lambda one: number(one, "kappa_printed"))[0]


def peak_collapse(data: Data) -> Number:
    result = next(one for one in data.of("fig09a") if one.parameters["scatterer-temperature"] == "particles")
    return number(result, "peak_collapse", label="ξ of the collapse about the peak, γ = N")


def particle_current(data: Data) -> Number:
    result = sizes(data, "N")[-1]
    return number(result, "particle_current", label=f"J_n at N = {result.parameters['cells']}, γ = N")
