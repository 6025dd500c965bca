"""Claims on the momentum distribution of the particles (figs. 3 and 4, section 4), and on equilibrium."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
from scipy.special import erf

from workflow.lib.load import Quantity, Result
from workflow.physics.fluxes import (
    MEAN_FIELD,
    SIMULATION,
    amplitudes,
    at,
    at_centre,
    at_zero,
    deviations,
    in_bins,
)
from workflow.study.results import Results, by_size, combination, estimate, octaves, ratio
from workflow.study.verdict import Estimate, with_systematic

# Nearly four thermal momenta of the hotter bath; beyond, a bin holds less than 1e-4 of the particles.
REACH = 40
RATE, EQUAL = 200, 100  # rate and temperature of equal baths
OUTGOING = ((0, 0, "p < 0 at x = 0"), (-1, 1, "p > 0 at x = 1"))  # index of the end, index of the half, name
ENDS = ((1, "x = 1/N"), (-1, "x = 1"))  # bonds behind the first and the last scatterer
PRINTED = {16: 1e-4}  # bounds that the paper states for F_N - F, by N
OTHERWISE = 1e-3


def equilibrium(data: Results) -> list[Estimate]:
    """Between equal baths: moments of the outgoing flux and of the end scatterers, relative to the
    Gaussian, and Kolmogorov distances."""
    numbers, baths = [], dict.fromkeys(("temperature_left", "temperature_right"), EQUAL)
    for gamma in (1, "N"):
        flux, profile = (
            data.results("fig04b", f"equilibrium-{kind}", gamma=gamma, nu_left=RATE, **baths)[0]
            for kind in ("flux", "profile")
        )
        for end, half, name in OUTGOING:
            square = estimate(flux, "square", (end, half), f"⟨p²⟩/T - 1, {name}, γ = {gamma}")
            kurtosis = estimate(flux, "kurtosis", (end, half), f"⟨p⁴⟩/(3⟨p²⟩²) - 1, {name}, γ = {gamma}")
            label = f"⟨P²⟩/MT - 1 at x = {half}, γ = {gamma}"
            scatterer = estimate(profile, "temperature_scatterer", end, label)
            numbers += [square / EQUAL - 1, kurtosis / 3 - 1, scatterer / EQUAL - 1]
        crossing, ends = flux["flux"], profile["scatterer_density"]
        momentum = crossing.axes["momentum"]
        density, error = (
            np.where(momentum < 0, values[0], values[-1]) / (2 * RATE)
            for values in (crossing.mean, crossing.error)
        )
        both = ends.mean.mean(axis=0), np.hypot(*ends.error) / 2
        of_particles = largest_distance(momentum, density, error, EQUAL, normalised=False)
        of_scatterers = largest_distance(
            ends.axes["scaled_momentum"], both[0], both[1], EQUAL, normalised=True
        )
        numbers += [
            Estimate(f"Kolmogorov's distance of F, γ = {gamma}", *of_particles, crossing.dof.min()),
            Estimate(f"Kolmogorov's distance of g, γ = {gamma}", *of_scatterers, ends.dof.min()),
        ]
    return numbers


def largest_distance(
    momentum: np.ndarray, density: np.ndarray, error: np.ndarray, temperature: float, *, normalised: bool
) -> tuple[float, float]:
    """Largest difference of the cumulative sums of a histogram and of the Gaussian of a temperature, with
    the error of the sum S there, for independent bins. Slow scatterers correlate them: the error is up to
    1.5 times too small (gamma = 1, p = 35). Of normalised ones those below, (1 - S) of the error, and
    those above, S of it, cancel each other. Empty bins have no error."""
    width = momentum[1] - momentum[0]
    total = float(np.sum(density) * width) if normalised else 1
    density, error = density / total, error / total
    below, above = (erf((momentum + side * width / 2) / np.sqrt(2 * temperature)) for side in (-1, 1))
    distance = np.abs(np.cumsum(density * width - 0.5 * (above - below)))
    largest = int(distance.argmax())
    below_share = float(np.sum(density[: largest + 1]) * width) if normalised else 0
    weights = np.where(np.arange(len(error)) <= largest, 1 - below_share, below_share)
    return float(distance[largest]), float(np.sqrt(np.nansum((weights * error) ** 2)) * width)


def jump_and_halves(data: Results) -> list[Estimate]:
    """Jump of F at p = 0 over max F, and departure of the outgoing halves from a Gaussian, by the Boltzmann
    equation at both ends."""
    result = data.one("fig03", "paper")
    largest = float(result["flux_density"].mean.max())
    jumps = [estimate(result, "jump", end, f"jump/max F, x = {half}") / largest for end, half, _ in OUTGOING]
    return [*jumps, *_departures(result)]


def not_gaussian(data: Results) -> list[Estimate]:
    """Departure of the outgoing halves from a Gaussian in the deterministic chain."""
    return _departures(data.one("fig04b", "deterministic"))


def _departures(result: Result) -> list[Estimate]:
    """|<p^4>/<p^2>^2 - 3| of both outgoing halves, which is 0 for a Gaussian."""
    return [
        _magnitude(estimate(result, "kurtosis", (end, half), f"|⟨p⁴⟩/⟨p²⟩² - 3|, {name}") - 3)
        for end, half, name in OUTGOING
    ]


def _magnitude(number: Estimate) -> Estimate:
    """Absolute value of a number. The error is that of the number, also if its value is 0."""
    return replace(number, value=abs(number.value))


def _finite(data: Results) -> tuple[pd.DataFrame, float]:
    """Deviations of finite chains from the Boltzmann equation, and the degrees of freedom of their errors."""
    simulated = data.results("fig03_inset", "simulation")
    continuum, mean_field = data.one("fig03_inset", "continuum"), data.results("fig03_inset", "mean-field")
    table = deviations([*simulated, continuum, *mean_field])
    return table, min(run["flux"].dof.min() for run in simulated)


def deviations_over_bounds(data: Results) -> list[Estimate]:
    """Largest |F_N - F| of the outgoing particles, that as p -> 0, over the printed bound, at every N. The
    paper does not state its bins: the difference from the bins of the simulations is a systematic error."""
    table, degrees = _finite(data)
    lowered, numbers = _lowered_by_bins(table), []
    for row in amplitudes(table).itertuples():
        bound = PRINTED.get(row.cells, OTHERWISE)
        label = f"largest |F_N - F|/{100 * bound:g} %, N = {row.cells}"
        number = Estimate(label, row.amplitude, row.error, degrees) / bound
        numbers.append(with_systematic(number, [lowered * number.value]))
    return numbers


def _lowered_by_bins(table: pd.DataFrame) -> float:
    """Factor by which the bins of the simulations lower the largest deviation, in the shortest chain in mean
    field."""
    shortest = table[table.kind == MEAN_FIELD].cells.min()
    fine = table[(table.kind == MEAN_FIELD) & (table.cells == shortest)].deviation.to_numpy()
    bins = in_bins(fine, table[table.kind == SIMULATION].momentum.nunique())
    return float(np.abs(bins).max() / at_centre(table)[shortest])


def deviations_central(data: Results) -> list[Estimate]:
    """Deviations at N = 2, where they are largest: those beyond the thermal momentum against those of the
    two central bins, and the odd part of the central ones."""
    table, degrees = _finite(data)
    temperature = np.mean(data.one("fig03_inset", "simulation_cells=2").ends("temperature"))
    part = _of_size(table, 2)
    momentum, value, error = (part[name].to_numpy() for name in ("momentum", "deviation", "error"))
    left, right = _central(part, degrees)
    centre = _mean_magnitude(left, right)
    outer = np.flatnonzero((np.abs(momentum) > np.sqrt(temperature)) & (np.abs(momentum) < REACH))
    less = []
    for k in outer:
        label = f"1 - |deviation at p = {momentum[k]:g}|/|that at p = 0|"
        both = [centre, Estimate("", abs(value[k]), error[k], degrees)]
        less.append(combination(both, [1 / centre.value, -1 / centre.value], label))
    odd = combination([left, right], [0.5, -0.5], "odd part of F_N - F at p = 0, ∫F dp = 1")
    return [*less, _magnitude(odd)]


def _of_size(table: pd.DataFrame, cells: int) -> pd.DataFrame:
    return table[(table.kind == SIMULATION) & (table.cells == cells)].sort_values("momentum")


def _central(part: pd.DataFrame, degrees: float) -> list[Estimate]:
    """Deviations in both bins at p = 0."""
    middle = len(part) // 2
    return [
        Estimate("", row.deviation, row.error, degrees)
        for row in part.iloc[middle - 1 : middle + 1].itertuples()
    ]


def _mean_magnitude(left: Estimate, right: Estimate) -> Estimate:
    return combination([_magnitude(left), _magnitude(right)], [0.5, 0.5], "")


def tends_to_kinetic(data: Results) -> list[Estimate]:
    """Exponents of F_N - F at p = 0, where it is largest, against N, by octave."""
    table, degrees = _finite(data)
    cells = [run.parameters["cells"] for run in by_size(data.results("fig03_inset", "simulation"))]
    central = {size: _mean_magnitude(*_central(_of_size(table, size), degrees)) for size in cells}
    return octaves(central, 2, "d ln|F_N - F|/d ln N at p = 0")


def on_top_of_kinetic(data: Results) -> list[Estimate]:
    """F_N minus the solution F of the Boltzmann equation over the largest F, at both ends of the chain with
    gamma = 1."""
    simulated, kinetic = data.one("fig04a", "rare"), data.one("fig04a", "kinetic")["flux"]
    flux, scale = simulated["flux"], float(kinetic.mean.max())
    return [
        estimate(simulated, "flux", (bond, k), f"(F_N - F)/max F, {name}, p = {p:g}") / scale - value / scale
        for bond, name in ENDS
        for k, (p, value) in enumerate(zip(flux.axes["momentum"], _behind(kinetic, bond, flux), strict=True))
        if abs(p) < REACH
    ]


def _behind(solution: Quantity, bond: int, flux: Quantity) -> np.ndarray:
    """Values of a solution of the Boltzmann equation at the position of a bond of the chain."""
    bonds = flux.axes["bond"]
    return at(solution, bonds[bond] / bonds[-1])


def jump_smaller(data: Results) -> list[Estimate]:
    deterministic, rare = data.one("fig04b", "deterministic"), data.one("fig04a", "rare")
    numbers = []
    for bond, name in ENDS:
        above, below = (estimate(run, "jump", bond) for run in (deterministic, rare))
        numbers.append(ratio(above, below, f"jump(γ = N)/jump(γ = 1), {name}"))
    return numbers


def jump_from_rates_only(data: Results) -> list[Estimate]:
    """Jump at equal rates, unequal temperatures and gamma = N, over max F. It is extrapolated by lines
    through two bins on either side; the error of this extrapolation in mean field bounds the systematic
    error."""
    equal, kinetic = (data.one("fig04b", run) for run in ("equal", "mean-field-equal"))
    scale = float(equal["flux"].mean.max())
    missed = max(_extrapolation_errors(kinetic, equal["flux"])) / scale
    jumps = [estimate(equal, "jump", bond, f"jump/max F at ν_L = ν_R, {name}") / scale for bond, name in ENDS]
    return [with_systematic(jump, [jump.value + missed]) for jump in jumps]


def _extrapolation_errors(kinetic: Result, flux: Quantity) -> Sequence[float]:
    """Error at both ends if the jump is extrapolated from the bins of the Boltzmann equation."""
    errors = []
    for bond, _ in ENDS:
        bins, exact = (_behind(kinetic[name], bond, flux) for name in ("flux", "jump"))
        middle = len(bins) // 2
        line = at_zero(bins[middle : middle + 2]) - at_zero(bins[middle - 1 : middle - 3 : -1])
        errors.append(float(abs(line - exact)))
    return errors
