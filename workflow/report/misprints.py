"""Numbers that show a misprint of the paper and that no claim has."""

from collections.abc import Callable

from workflow.claims.data import Data, number, power
from workflow.claims.growth import largest_sizes, sizes
from workflow.claims.verdict import Number


def persistence_at_zero(data: Data) -> Number:
    return number(
        data.of("fig05", particles_per_cell=320, sigma=0)[0],
        "mu",
        label="μ at σ = 0, where the integral as printed gives 1/4",
    )


def persistence_at_half(data: Data) -> Number:
    return number(data.of("fig05", particles_per_cell=320, sigma=0.5)[0], "mu", label="μ at σ = 0.5")


def injected_energy(data: Data) -> Number:
    """The right half at the left end is what the bath injects."""
    result = data.of("ext10", "momentum_flux", gamma="N")[0]
    label = "energy over νT that crosses the left opening inwards"
    return number(result, "square", (0, 1), label).over(2 * result.parameters["temperature-left"])


def printed_conductivity(data: Data) -> Number:
    runs = largest_sizes(sizes(data, 1))
    values = [number(one, "kappa_printed") for one in runs]
    return power(runs, [one.parameters["cells"] for one in runs], values, "exponent of κ as printed, γ = 1")[
        0
    ]


def peak_collapse(data: Data) -> Number:
    result = next(one for one in data.of("fig09a") if one.parameters["scatterer-temperature"] == "particles")
    return number(result, "peak_collapse", label="ξ of the collapse about the peak, γ = N")


def particle_current(data: Data) -> Number:
    result = sizes(data, "N")[-1]
    return number(result, "particle_current", label=f"J_n at N = {result.parameters['cells']}, γ = N")


NUMBERS: dict[str, Callable[[Data], Number]] = {
    one.__name__: one
    for one in (
        persistence_at_zero,
        persistence_at_half,
        injected_energy,
        printed_conductivity,
        peak_collapse,
        particle_current,
    )
}
