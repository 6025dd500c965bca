"""Claims on the momentum distribution of the particles (figs. 3 and 4, section 4), and on equilibrium."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pandas as pd

from workflow.claims.data import (
    Claim,
    Data,
    Evidence,
    by_size,
    combination,
    freedom,
    number,
    power,
    ratio,
    where_made,
)
from workflow.claims.verdict import Number, with_systematic
from workflow.lib.caption import goodness, scientific
from workflow.lib.fit import PowerLaw, fit_multiple, rejected, with_error
from workflow.lib.fluxes import (
    amplitudes,
    at,
    at_ends,
    deviations,
    end_scatterers,
    extrapolation_error,
    largest_distance,
    outgoing_flux,
)
from workflow.lib.load import Result

# Nearly four thermal momenta of the hotter bath; beyond, a bin holds less than 1e-4 of the particles.
REACH = 40
# Weights of the means over the three innermost bins of a half in the value at p = 0, extrapolated by a line or a parabola.
LINE, PARABOLA = np.array([12, -4, 0]) / 8, np.array([15, -10, 3]) / 8
EXTRAPOLATED = "extrapolated"  # part of the labels of extrapolated numbers
NORMALISATION = "F as printed, with the mean of both rates, integrates to 1; relative to max F in the alternative reading."
OUTGOING = ((0, 0, "p < 0 at x = 0"), (-1, 1, "p > 0 at x = 1"))  # index of the end, index of the half, name


def equilibrium(data: Data) -> Evidence:
    """Moments of the outgoing flux and of the end scatterers, relative to the Gaussian, and Kolmogorov distances from it."""
    numbers = []
    for gamma in (1, "N"):
        programs = ("momentum_flux", "steady_profile")
        flux, profile = (data.of("ext10", program, gamma=gamma)[0] for program in programs)
        temperature = flux.parameters["temperature-left"]
        for end, half, name in OUTGOING:
            square = number(flux, "square", (end, half), f"⟨p²⟩/T - 1, {name}, γ = {gamma}")
            kurtosis = number(flux, "kurtosis", (end, half), f"⟨p⁴⟩/(3⟨p²⟩²) - 1, {name}, γ = {gamma}")
            label = f"⟨P²⟩/MT - 1 at x = {half}, γ = {gamma}"
            scatterer = number(profile, "temperature_scatterer", end, label)
            numbers += [square.over(temperature, 1), kurtosis.over(3, 1), scatterer.over(temperature, 1)]
        for result, curve, name in ((flux, outgoing_flux, "F"), (profile, end_scatterers, "g")):
            label = f"Kolmogorov's distance of {name}, γ = {gamma}"
            numbers.append(Number(label, *largest_distance(*curve(result)[1:]), freedom(result)))
    return Evidence(numbers)


def jump_and_halves(data: Data) -> Evidence:
    """Jump of F at p = 0 over max F, and departure of the outgoing halves from a Gaussian, at both ends."""
    result = data.one("fig03", "paper")
    largest = float(result["flux_density"].mean.max())
    jumps = [
        number(result, "jump", end, f"jump over max F, x = {half}").over(largest) for end, half, _ in OUTGOING
    ]
    return Evidence([*jumps, *_departures(result)])


def _departures(result: Result, name: str = "") -> list[Number]:
    """|<p^4>/<p^2>^2 - 3| of both outgoing halves, which is 0 for a Gaussian."""
    numbers = []
    for end, half, description in OUTGOING:
        departure = number(result, "kurtosis", (end, half)).over(1, 3)
        numbers.append(_magnitude(departure, f"|⟨p⁴⟩/⟨p²⟩² - 3|, {description}{name}"))
    return numbers


def _magnitude(number: Number, label: str = "") -> Number:
    """Absolute value of a number. The error is that of the number, also if its value is 0."""
    return replace(number, value=abs(number.value), label=label)


def gaussian_only_if(data: Data) -> Evidence:
    """The halves are Gaussian only if the temperatures are equal.

    Literal ("only if"): at unequal temperatures, and the σ of the paper's figure, the halves are not Gaussian. Alternative ("if"): at equal
    temperatures they are Gaussian."""
    unequal, equal, exchange = (data.one("fig03", run) for run in ("paper", "equal", "exchange"))
    largest = max(departure.value for departure in _departures(exchange))
    return Evidence(
        _departures(unequal, ", σ = 1/2"),
        alternative=_departures(equal, ", equal T"),
        caveat="The direction “only if” is judged; “if” is the alternative reading, at equal temperatures and unequal rates. The paper's "
        f"sentence is about σ = 1/2. At σ = 0 the distance is at most {scientific(largest, 1)} at unequal temperatures too, as momenta are only exchanged.",
    )


def _deviations(data: Data) -> tuple[pd.DataFrame, float]:
    """Deviation of the finite chains from the continuum by N and bin, and the degrees of freedom of its errors."""
    return deviations(data.of("fig03_inset")), freedom(*data.of("fig03_inset", "momentum_flux"))


def _bins(table: pd.DataFrame, degrees: float) -> list[Number]:
    """Deviation of the simulation over max F in each bin within REACH; bins beyond contain too few particles for a reliable error."""
    rows = table[(table.kind == "simulation") & (table.momentum.abs() < REACH)].itertuples()
    return [
        Number(
            f"F_N - F over max F, N = {row.cells}, p = {row.momentum:g}", row.deviation, row.error, degrees
        )
        for row in rows
    ]


def _shaped(table: pd.DataFrame, cells: int, degrees: float) -> tuple[list[Number], str]:
    """F_N - F in the printed normalisation, in every bin and extrapolated to p = 0, and a sentence on the goodness of the scaling.

    The numbers are the deviation in mean field, scaled to the simulation, because the largest of many noisy bins would be biased. If the
    simulation rejects the shape of the mean field, the root mean square of the residual bounds the systematic error."""
    near = table[(table.cells == cells) & (table.momentum.abs() < REACH)].sort_values("momentum")
    simulation, theory = (near[near.kind == kind] for kind in ("simulation", "mean field"))
    value, error, shape = (
        column.to_numpy() for column in (simulation.deviation, simulation.error, theory.deviation)
    )
    size, spread, misfit = fit_multiple(shape, value, error)
    bins = [
        Number(f"F_N - F as printed, N = {cells}, p = {row.momentum:g}", row.absolute_as_printed, 0.0)
        for row in theory.itertuples()
    ]
    scaled = [
        replace(entry.over(1 / size), error=spread * abs(entry.value), freedom=degrees)
        for entry in (*bins, *_at_zero(theory, cells))
    ]
    known_bins = int(np.count_nonzero(error)) - 1
    sentence = f"At N = {cells} it is {with_error(size, spread)} of that in mean field, {{}} ({goodness(misfit, known_bins)})."
    if not rejected(misfit, known_bins):
        return scaled, sentence.format("whose shape it has")
    missed = math.sqrt(max(0.0, misfit / known_bins - 1) * np.mean(error[error > 0] ** 2))
    missed *= float((near.absolute_as_printed / near.deviation).median())
    shape_text = f"whose shape it has but for {scientific(missed)} (root mean square), which bounds the systematic error"
    return [with_systematic(entry, [entry.value + missed]) for entry in scaled], sentence.format(shape_text)


def _at_zero(theory: pd.DataFrame, cells: int) -> list[Number]:
    """F_N - F at p = 0 from both sides, extrapolated by the line through the two innermost bins of a half. The difference from the
    parabola through three bins bounds the systematic error."""
    numbers = []
    for side, direction in ((-1, "below"), (1, "above")):
        inner = theory[side * theory.momentum > 0].sort_values("momentum", key=abs).head(len(LINE))
        value = inner.absolute_as_printed.to_numpy()
        label = f"F_N - F as printed, N = {cells}, {EXTRAPOLATED} to p = 0 from {direction}"
        numbers.append(with_systematic(Number(label, float(LINE @ value), 0.0), [float(PARABOLA @ value)]))
    return numbers


def deviations_small(data: Data) -> Evidence:
    """Deviations at all N. The literal band is the printed bound, the intended one this bound before rounding to its digit."""
    table, degrees = _deviations(data)
    deviations, sentences = [], []
    for cells in sorted({*table.cells}):
        scaled, sentence = _shaped(table, cells, degrees)
        deviations += scaled
        sentences.append(sentence)
    return Evidence(
        deviations,
        deviations,
        _bins(table, degrees),
        caveat=f"{NORMALISATION} {sentences[0]} {_largest_bin(deviations)}",
    )


def deviations_at_16(data: Data) -> Evidence:
    """Deviations at N = 16, with the bands of deviations_small."""
    table, degrees = _deviations(data)
    deviations, sentence = _shaped(table, 16, degrees)
    caveat = f"{NORMALISATION} {sentence} {_largest_bin(deviations)}"
    return Evidence(deviations, deviations, _bins(table[table.cells == 16], degrees), caveat=caveat)


def _largest_bin(numbers: Sequence[Number]) -> str:
    """Sentence on the largest mean over a bin; extrapolated numbers are excluded."""
    largest = max(
        (entry for entry in numbers if EXTRAPOLATED not in entry.label), key=lambda entry: abs(entry.value)
    )
    position = largest.label.partition(", ")[2]
    return f"The largest mean over a bin, as in the panel, is {with_error(largest.value, largest.error)} ({position})."


def deviations_vanish(data: Data) -> Evidence:
    exponent, law = decay(data)
    later, _ = decay(data, skipped=1)
    every = where_made(lambda: _from_kinetic(data, "fig04b", "deterministic", "mean-field", " at γ = N"))
    return Evidence(
        [exponent],
        alternative=every,
        caveat=f"At γ = 1. χ² of the power law is {law.chi_square:.1f} for {law.freedom}; without the smallest N "
        f"the exponent is {with_error(later.value, later.error)}. The alternative reading is one chain at γ = N.",
    )


def decay(data: Data, skipped: int = 0) -> tuple[Number, PowerLaw]:
    """Exponent of the amplitude of the deviation against N (see amplitudes), and the fitted law. skipped: number of the
    smallest sizes that are left out."""
    table, _ = _deviations(data)
    results = by_size(data.of("fig03_inset", "momentum_flux"))[skipped:]
    rows = amplitudes(table).iloc[skipped:]
    sizes = [Number("", row.amplitude, row.error) for row in rows.itertuples()]
    label = f"d ln |F_N - F| / d ln N, N = {rows.cells.min()} to {rows.cells.max()}"
    return power(results, [*rows.cells], sizes, label)


def deviations_central(data: Data) -> Evidence:
    """Deviations at N = 2, where they are largest: those beyond the thermal momentum against those of the two central bins, and the odd part
    of the central ones over their mean magnitude."""
    table, degrees = _deviations(data)
    temperature = np.mean(data.one("fig03_inset", "simulation_cells=2").ends("temperature"))
    part = table[(table.kind == "simulation") & (table.cells == 2)].sort_values("momentum")
    momentum, value, error = (part[name].to_numpy() for name in ("momentum", "deviation", "error"))
    middle = len(momentum) // 2
    left, right = (Number("", value[k], error[k], degrees) for k in (middle - 1, middle))
    centre = combination([_magnitude(left), _magnitude(right)], [0.5, 0.5], "")
    outer = np.flatnonzero((np.abs(momentum) > np.sqrt(temperature)) & (np.abs(momentum) < REACH))
    less = []
    for k in outer:
        label = f"1 - |deviation at p = {momentum[k]:g}| over that at p = 0"
        both = [centre, Number("", abs(value[k]), error[k], degrees)]
        less.append(combination(both, [1 / centre.value, -1 / centre.value], label))
    half = 0.5 / abs(centre.value)
    odd = combination([left, right], [half, -half], "odd part over the whole at p = 0")
    return Evidence([*less, _magnitude(odd, odd.label)])


def on_top_of_kinetic(data: Data) -> Evidence:
    return Evidence(_from_kinetic(data, "fig04a", "rare", "kinetic"))


def _from_kinetic(data: Data, panel: str, run: str, equation: str, chain: str = "") -> list[Number]:
    """F_N minus F over the largest F, behind the first scatterer and the last. chain: text added to the labels."""
    simulated = data.one(panel, run)
    flux, kinetic = simulated["flux"], data.one(panel, equation)["flux"]
    last, scale = len(flux.mean) - 1, float(kinetic.mean.max())
    return [
        number(simulated, "flux", (bond, k), f"deviation over max F{chain}, {name}, p = {p:g}").over(scale, at(kinetic, bond / last)[k] / scale)
        for bond, name in ((1, "x = 1/N"), (last, "x = 1"))
        for k, p in enumerate(flux.axes["momentum"])
        if abs(p) < REACH
    ]  # fmt: skip


def jump_smaller(data: Data) -> Evidence:
    rare, deterministic = data.one("fig04a", "rare"), data.one("fig04b", "deterministic")
    return Evidence([
        ratio(number(deterministic, "jump", bond), number(rare, "jump", bond), f"jump(γ = N)/jump(γ = 1), {name}")
        for bond, name in ((1, "x = 1/N"), (-1, "x = 1"))
    ])  # fmt: skip


def jump_from_rates_only(data: Data) -> Evidence:
    """Jump at equal rates, unequal temperatures and gamma = N, over max F. It is
    extrapolated by lines through two bins on either side; the error of this extrapolation in mean field bounds the systematic error."""
    equal, kinetic = (data.one("fig04b", run) for run in ("equal", "mean-field-equal"))
    scale = float(equal["flux"].mean.max())
    missed = extrapolation_error(at_ends([equal, kinetic])) / scale
    jumps = [
        number(equal, "jump", bond, f"jump over max F at ν_L = ν_R, {name}").over(scale)
        for bond, name in ((1, "x = 1/N"), (-1, "x = 1"))
    ]
    theory = [float(kinetic["jump"].mean[bond]) / scale for bond in (1, -1)]
    return Evidence(
        [with_systematic(jump, [jump.value + missed]) for jump in jumps],
        caveat=f"In mean field it is {theory[0]:.3f} and {theory[1]:.3f}: equal rates do not remove it there either.",
    )


CLAIMS: dict[str, Claim] = {
    "C04": equilibrium,
    "C09": jump_and_halves,
    "C10": deviations_small,
    "C11": deviations_at_16,
    "C12": deviations_vanish,
    "C13": on_top_of_kinetic,
    "C14": jump_smaller,
    "C31": jump_from_rates_only,
    "C32": deviations_central,
    "C33": gaussian_only_if,
}
