"""Claims on the closed chain: persistence, waiting times, spreading, conservation, ageing (figs. 5 to 7, section 5)."""

import math
import sys
from dataclasses import replace

import numpy as np

from workflow.claims.data import Claim, Data, Evidence, number, ratio, where_made
from workflow.claims.verdict import Number, with_systematic
from workflow.lib.caption import scientific
from workflow.lib.closed import ROUNDING, persistence_law
from workflow.lib.load import Result


def _named(results: list[Result], quantity: str, name: str) -> list[Number]:
    """One number per run. Labels have the name, the mass ratio and, if they differ between runs, particles per cell and relaxation time."""
    symbols = {"particles-per-cell": "n", "relaxation-time": "t_r"}
    differing = [key for key in symbols if len({result.parameters[key] for result in results}) > 1]
    numbers = []
    for result in results:
        values = (f", {symbols[key]} = {result.parameters[key]:g}" for key in differing)
        label = f"{name}, σ = {result.parameters['sigma']:g}{''.join(values)}"
        numbers.append(number(result, quantity, label=label))
    return numbers


def persistence(data: Data) -> Evidence:
    """mu minus arccos(sigma)/pi. Literal: at sigma = -1, 0 and 1; intended: at every sigma in a dense chain; alternative: at every sigma in
    the paper's chain."""
    paper = data.of("fig05", particles_per_cell=20)
    limits = [result for result in paper if result.parameters["sigma"] in (-1, 0, 1)]
    dense = data.of("fig05", particles_per_cell=320)
    literal, intended, alternative = (
        [_from_law(result) for result in runs] for runs in (limits, dense, paper)
    )
    return Evidence(literal, intended, alternative)


def _from_law(result: Result) -> Number:
    sigma = result.parameters["sigma"]
    return number(result, "mu", label=f"μ - arccos(σ)/π, σ = {sigma:g}").over(
        1, float(persistence_law(sigma))
    )


def waiting_half(data: Data) -> Evidence:
    runs = [run for run in data.of("ext07", "waiting_time") if run.parameters["relaxation-time"] >= 10]
    aged = [float(run["exponent"].mean) for run in runs]
    return Evidence(
        [with_systematic(_waiting(data, 0.5), aged)],
        caveat="The systematic bound is what the relaxation time changes (ext07); cuts of the tail change less.",
    )


def waiting_zero(data: Data) -> Evidence:
    return Evidence(
        [_waiting(data, 0)],
        caveat="A property of the Gaussian start: at σ = 0 the momenta are only exchanged.",
    )


def _waiting(data: Data, sigma: float) -> Number:
    """Exponent of the waiting times. Its spread over cuts of the tail within a factor of three is a systematic error."""
    (result,) = data.of("fig06", sigma=sigma)
    exponent = number(result, "exponent", label="exponent of Ψ(τ)")
    return with_systematic(exponent, [exponent.value + float(result["exponent_spread"].mean)])


def spreading_half(data: Data) -> Evidence:
    """alpha at sigma = 1/2. Its change with the relaxation time is a systematic error."""
    aged = _relaxed(data, 0.5)
    zero = _named(data.of("ext01", sigma=0.5, zero_total_momentum=True), "alpha", "α at zero total momentum")
    return Evidence(
        [with_systematic(number(data.of("fig07")[0], "alpha", label="α, σ = 0.5, a mean slope"), aged)],
        alternative=zero,
        caveat=f"What is measured is judged here, what it is taken for in C20. {_without_drift(zero)}",
    )


def spreading_zero(data: Data) -> Evidence:
    aged = _relaxed(data, 0)
    (result,) = data.of("fig07_inset", sigma=0, zero_total_momentum=False)
    dense = where_made(lambda: _named(_drifting(data, 0, 80), "alpha", "α, n = 80"))
    return Evidence(
        [with_systematic(number(result, "alpha", label="α, σ = 0"), aged)],
        alternative=dense,
        caveat="What is measured is judged here, what it is taken for in C20."
        + " The alternative reading is a chain of 80 particles per cell over the same time." * bool(dense),
    )


def _relaxed(data: Data, sigma: float) -> list[float]:
    return [float(run["alpha"].mean) for run in _drifting(data, sigma, 20)]


def _drifting(data: Data, sigma: float, n: int) -> list[Result]:
    """Runs with the paper's random total momentum and n particles per cell."""
    chain = {"sigma": sigma, "particles_per_cell": n}
    return data.of("ext01", None, zero_total_momentum=False, rule="elastic", **chain)


def _without_drift(zero: list[Number]) -> str:
    return f"At zero total momentum α lies between {min(alpha.value for alpha in zero):.3f} and {max(alpha.value for alpha in zero):.3f}."


def superdiffusive(data: Data) -> Evidence:
    """alpha for every sigma but 0. Literal: with the paper's random total momentum; intended: with zero total momentum."""
    runs = [run for run in data.of("fig07_inset") if run.parameters["sigma"]]
    free, zero = (
        _named([run for run in runs if run.parameters["zero-total-momentum"] == given], "alpha", name)
        for given, name in ((False, "α"), (True, "α at zero total momentum"))
    )
    return Evidence(free, zero, caveat=_without_drift(zero))


def diffusion_recovered(data: Data) -> Evidence:
    exponents = _named(data.of("ext01", rule="random-direction"), "alpha", "α")
    return Evidence(
        exponents,
        exponents,
        caveat="Waits of τ⁻² make t/ln t, whose exponent approaches 1 from below (ext01).",
    )


def only_energy(data: Data) -> Evidence:
    """Change of the total momentum over a run, relative to the sum of all |momenta|, as a power of ten. Changes below
    the rounding error are replaced by it."""
    runs = [run for run in data.of("fig07_inset") if run.parameters["sigma"]]
    changes = []
    for drift in _named(runs, "momentum_drift", "log₁₀ of the relative change of Σp + ΣP"):
        change = max(drift.value, sys.float_info.epsilon)
        changes.append(
            Number(drift.label, math.log10(change), drift.error / (change * math.log(10)), drift.freedom)
        )
    largest = max(float(run["momentum_drift"].mean) for run in runs)
    return Evidence(
        changes,
        caveat=f"The largest change is {scientific(largest)}, rounding; every collision conserves p + P.",
    )


def ageing(data: Data) -> Evidence:
    """Slope of the scatterers' energy against ln t in the last decade over that in the first decade from t = 1 on. Literal: this ratio
    minus 1, which is 0 for logarithmic growth. Intended: the ratio in a chain of few particles, which saturates first."""
    runs = data.of("ext07", "ageing")
    result = max(
        runs, key=lambda run: [run.parameters[key] for key in ("particles-per-cell", "observation-time")]
    )
    change = _last_slope(result)
    return Evidence(
        [replace(change.over(1, 1), label=f"{change.label}, minus 1")],
        where_made(lambda: [_last_slope(data.one("ext07", "few"))]),
        caveat="By eq. 14 of docs/model.md the slope falls from the outset, as 1/(n + Λ)² with Λ ≈ ln t, and the energy saturates "
        "where Λ exceeds n: for n = 20 at t of the order e^20.",
    )


def _last_slope(result: Result) -> Number:
    decade = result["decade_slope"].axes["decade"]
    first = int(np.flatnonzero(decade > 1 - ROUNDING)[0])
    label = f"slope from t = {decade[-1]:g} over that from t = {decade[first]:g}, n = {result.parameters['particles-per-cell']}"
    return ratio(number(result, "decade_slope", -1), number(result, "decade_slope", first), label)


CLAIMS: dict[str, Claim] = {
    "C15": persistence,
    "C16": waiting_half,
    "C17": waiting_zero,
    "C18": spreading_half,
    "C19": spreading_zero,
    "C20": superdiffusive,
    "C21": diffusion_recovered,
    "C22": only_energy,
    "C29": ageing,
}
