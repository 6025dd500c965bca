"""Claims on the closed chain: persistence, waiting times, spreading, conservation (figs. 5 to 7, section
5)."""

import math
import sys
from dataclasses import replace

import numpy as np

from workflow.lib.load import Result
from workflow.physics.closed import persistence_law
from workflow.study.results import Results, estimate
from workflow.study.verdict import Estimate, with_systematic


def _named(results: list[Result], quantity: str, name: str) -> list[Estimate]:
    """One number per run. Labels have the name, the mass ratio and, if they differ between runs, particles
    per cell and relaxation time."""
    symbols = {"particles_per_cell": "n", "relaxation_time": "t_r"}
    differing = [key for key in symbols if len({result.parameters[key] for result in results}) > 1]
    numbers = []
    for result in results:
        values = (f", {symbols[key]} = {result.parameters[key]:g}" for key in differing)
        label = f"{name}, σ = {result.parameters['sigma']:g}{''.join(values)}"
        numbers.append(estimate(result, quantity, label=label))
    return numbers


def persistence_limits(data: Results) -> list[Estimate]:
    """mu minus arccos(sigma)/pi at sigma = -1, 0 and 1."""
    runs = data.results("fig05", "paper")
    # Exactly these options: scatterers of mass 0, of the particles' mass, and of infinite mass.
    return _from_law([run for run in runs if run.parameters["sigma"] in (-1, 0, 1)])


def persistence_in_dense_chain(data: Results) -> list[Estimate]:
    """mu minus arccos(sigma)/pi at every sigma in a chain of many particles per cell."""
    return _from_law(data.results("fig05", "dense"))


def _from_law(results: list[Result]) -> list[Estimate]:
    """At sigma = 1 and -1 every particle turns, or none: there is no error."""
    numbers = _named(results, "mu", "μ - arccos(σ)/π")
    sigmas = [float(result.parameters["sigma"]) for result in results]
    return [
        (replace(mu, error=0.0) if abs(sigma) == 1 else mu) - float(persistence_law(np.asarray(sigma)))
        for mu, sigma in zip(numbers, sigmas, strict=True)
    ]


def persistent(data: Results) -> list[Estimate]:
    """mu at the sigma of the paper's other figures."""
    return _named(data.results("fig05", "paper", sigma=0.5), "mu", "μ")


def correlated(data: Results) -> list[Estimate]:
    """Distance of mu from 1/2, the value of uncorrelated directions, at every sigma but 0."""
    runs = [run for run in data.results("fig05", "paper") if 0 < abs(run.parameters["sigma"]) < 1]
    numbers = _named(runs, "mu", "|μ - 1/2|")
    return [replace(mu, value=abs(mu.value - 0.5)) for mu in numbers]


def waiting_half(data: Results) -> list[Estimate]:
    """Exponent of the waiting times at sigma = 1/2. Its change with the age of the chain is a systematic
    error, too."""
    young = data.one("fig06", "young")["exponent"].mean
    return [with_systematic(_waiting(data, 0.5), [float(young)])]


def waiting_zero(data: Results) -> list[Estimate]:
    return [_waiting(data, 0)]


def _waiting(data: Results, sigma: float) -> Estimate:
    """Exponent of the waiting times. Its spread over cuts of the tail within a factor of three is a
    systematic error."""
    result, *_ = data.results("fig06", "all", sigma=sigma)
    exponent = estimate(result, "exponent", label="exponent of Ψ(τ)")
    return with_systematic(exponent, [exponent.value + float(result["exponent_spread"].mean)])


def spreading_half(data: Results) -> list[Estimate]:
    """Exponents of <x²> at sigma = 1/2 over the parts of the last decade between neighbouring times."""
    result, *_ = data.results("fig07", "all", sigma=0.5)
    times, last = result["local_slope"].axes["time"], result.parameters["observation_time"]
    late = np.flatnonzero(times > last / 10 ** result.parameters["fit_decades"])
    return [estimate(result, "local_slope", k, f"d ln ⟨x²⟩/d ln t, t = {times[k]:.0f}") for k in late]


def spreading_zero(data: Results) -> list[Estimate]:
    """alpha at sigma = 0, also from a chain that was relaxed for ten times as long."""
    runs = data.results("fig07_inset", "all", "aged", sigma=0)
    return _named([run for run in runs if run.parameters["relaxation_time"] >= 100], "alpha", "α")


def spreading_with_drift(data: Results) -> list[Estimate]:
    """alpha for every sigma but 0, with random total momentum."""
    return _spreading(data, "all", "α")


def spreading_without_drift(data: Results) -> list[Estimate]:
    """alpha for every sigma but 0, with zero total momentum."""
    return _spreading(data, "zero-momentum", "α at zero total momentum")


def _spreading(data: Results, series: str, name: str) -> list[Estimate]:
    runs = data.results("fig07_inset", series)
    return _named([run for run in runs if run.parameters["sigma"]], "alpha", name)


def random_directions(data: Results) -> list[Estimate]:
    return _named(data.results("fig07_inset", "random"), "alpha", "α")


def momentum_changes(data: Results) -> list[Estimate]:
    """Change of the total momentum over a run, relative to the sum of all |momenta|, as a power of ten.
    Changes below the rounding error are replaced by it."""
    name = "log₁₀(|change of Π|/(Σ|p| + Σ|P|))"
    drifts = []
    for series, where in (("all", ""), ("zero-momentum", ", Π = 0")):
        runs = [run for run in data.results("fig07_inset", series) if run.parameters["sigma"]]
        drifts += _named(runs, "momentum_change", name + where)
    changes = []
    for drift in drifts:
        change = max(drift.value, sys.float_info.epsilon)
        error = drift.error / (change * math.log(10))
        changes.append(Estimate(drift.label, math.log10(change), error, drift.dof))
    return changes
