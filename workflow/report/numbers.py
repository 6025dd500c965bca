"""Numbers, gases and sizes quoted in questions.yaml and misprints.yaml by the name of their function; none decides a claim."""

from collections.abc import Sequence
from dataclasses import replace

from workflow.claims.data import Data, by_size, number
from workflow.claims.fluxes import decay
from workflow.claims.growth import (
    BULK,
    exponent,
    halves,
    largest_sizes,
    last_octave,
    longest_rings,
    sizes,
    stationary_at_fixed_spacing,
    thinning_exponents,
    without_particle_current,
)
from workflow.claims.verdict import Number
from workflow.lib import caption
from workflow.lib.fit import with_error
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result
from workflow.lib.response import response
from workflow.lib.rings import chain


def kappa_of_small_chains(data: Data) -> Number:
    return _kappa_of_half(data, 0)


def kappa_of_large_chains(data: Data) -> Number:
    return _kappa_of_half(data, -1)


def _kappa_of_half(data: Data, half: int) -> Number:
    return exponent(_half(data, half), "d ln κ/d ln N, γ = N, spacing 1/N")[0]


def _half(data: Data, half: int) -> Sequence[Result]:
    """Runs of fig. 8 with the smaller (0) or larger (-1) sizes."""
    return halves([run for run in sizes(data, "N") if run.parameters["cells"] >= BULK])[half]


def middle_size(data: Data) -> str:
    """Size that both halves of fig. 8's sizes have in common, as text."""
    return f"N = {_half(data, -1)[0].parameters['cells']}"


def _from_to(runs: Sequence[Result]) -> str:
    cells = [run.parameters["cells"] for run in runs]
    return f"N = {min(cells)} to {max(cells)}"


def kappa_of_longest_chains(data: Data) -> Number:
    """Exponent between the two largest sizes at the paper's spacing, at the drive with the smaller error."""
    return min(thinning_exponents(data), key=lambda slope: slope.error)


def sizes_of_longest_chains(data: Data) -> str:
    return kappa_of_longest_chains(data).label.rpartition(", ")[2]


def heat_exponent(data: Data) -> Number:
    """Exponent of <Q²> over the last octave of the ring that was observed for the longest time."""
    rings = data.of("ext13", rule="elastic")
    return _exponent(max(rings, key=lambda ring: float(ring["heat_variance"].axes["time"][-1])))


def lowest_heat_exponent(data: Data) -> Number:
    """Smallest exponent of <Q²> of all gases, each over the last octave of its longest ring."""
    return min(map(_exponent, longest_rings(data)), key=lambda slope: slope.value)


def heat_exponent_without_momentum(data: Data) -> Number:
    (ring,) = data.of("ext13", rule="random-direction")
    return number(ring, "local_exponent", -1)


def _exponent(ring: Result) -> Number:
    slope = last_octave(ring).over(1, -1)
    return replace(slope, label=f"d ln⟨Q²⟩/d ln t, {_gas_and_time(ring)}")


def _gas_and_time(ring: Result) -> str:
    gas, middle = chain(ring), ring["local_exponent"].axes["middle"][-1]
    return f"ζ = {caption.number(gas.zeta)}, M = {caption.number(gas.mass)}, t = {middle:.0f}"


def kappa_0_exponent(data: Data) -> Number:
    return without_particle_current(data)


def sizes_of_kappa_0(data: Data) -> str:
    return _from_to(stationary_at_fixed_spacing(data))


def kappa_0_in_the_last_octave(data: Data) -> Number:
    return without_particle_current(data, last=2)


def kappa_0_expected(data: Data) -> str:
    """Exponent of κ_0 in the last octave, predicted from the heat that passes in a ring before sound leaves the chain (ext. 11)."""
    chains = stationary_at_fixed_spacing(data)
    rings = data.of("ext13", rule="elastic", sigma=chains[0].parameters["sigma"])
    table, _ = response(chains, rings)
    last = table.iloc[-2:]
    return with_error(
        *(
            float(values[-1])
            for values in local_exponents(last.cells, last.predicted, last.predicted_error)[1:]
        )
    )


def momentum_change(data: Data) -> Number:
    """Largest relative change of the total momentum over all mass ratios."""
    runs = [run for run in data.of("fig07_inset") if run.parameters["sigma"]]
    return max((number(run, "momentum_drift") for run in runs), key=lambda change: change.value)


def alpha(data: Data) -> Number:
    return number(data.of("fig07")[0], "alpha", label="α, σ = 1/2")


def alpha_without_drift(data: Data) -> Number:
    """alpha at zero total momentum of the chain that relaxed longest."""
    runs = data.of("ext01", sigma=0.5, zero_total_momentum=True, particles_per_cell=20)
    relaxed = max(runs, key=lambda run: run.parameters["relaxation-time"])
    return number(relaxed, "alpha", label="α at zero total momentum, σ = 1/2")


def persistence_at_zero(data: Data) -> Number:
    return _persistence(data, 0, "μ at σ = 0, where the integral as printed gives 1/4")


def persistence_at_half(data: Data) -> Number:
    return _persistence(data, 0.5, "μ at σ = 0.5")


def _persistence(data: Data, sigma: float, label: str) -> Number:
    return number(data.of("fig05", particles_per_cell=320, sigma=sigma)[0], "mu", label=label)


def injected_energy(data: Data) -> Number:
    """Energy that the left bath injects per νT: the moment of the half p > 0 at the left end."""
    result = data.of("ext10", "momentum_flux", gamma="N")[0]
    label = "energy over νT that crosses the left opening inwards"
    return number(result, "square", (0, 1), label).over(2 * result.parameters["temperature-left"])


def printed_conductivity(data: Data) -> Number:
    runs = largest_sizes(sizes(data, 1))
    return exponent(runs, "exponent of κ as printed, γ = 1", lambda run: number(run, "kappa_printed"))[0]


def peak_collapse(data: Data) -> Number:
    result = next(
        result for result in data.of("fig09a") if result.parameters["scatterer-temperature"] == "particles"
    )
    return number(result, "peak_collapse", label="ξ of the collapse about the peak, γ = N")


def particle_current(data: Data) -> Number:
    result = sizes(data, "N")[-1]
    return number(result, "particle_current", label=f"J_n at N = {result.parameters['cells']}, γ = N")


def kinetic_exponent_of_longer_chains(data: Data) -> Number:
    """Exponent of the deviation from the kinetic limit without the smallest N."""
    return decay(data, skipped=1)[0]


def sizes_of_longer_chains(data: Data) -> str:
    return _from_to(by_size(data.of("fig03_inset", "momentum_flux"))[1:])
