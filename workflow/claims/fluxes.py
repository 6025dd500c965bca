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
from workflow.figures import ext10, fig03_inset, fig04
from workflow.lib.caption import goodness, scientific
from workflow.lib.fit import PowerLaw, fit_multiple, rejected, with_error
from workflow.lib.load import Result

# Nearly four thermal momenta of the hotter bath; beyond, a bin holds less than 1e-4 of the particles.
REACH = 40
# What means over the three innermost bins of a half weigh in the value at p = 0.
LINE, PARABOLA = np.array([12, -4, 0]) / 8, np.array([15, -10, 3]) / 8
EXTRAPOLATED = "extrapolated"  # in the names of numbers
NORMALISATION = "F as printed, with the mean of both rates, integrates to 1; relative to max F in the alternative reading."
OUTGOING = ((0, 0, "p < 0 at x = 0"), (-1, 1, "p > 0 at x = 1"))  # place, half, name


def equilibrium(data: Data) -> Evidence:
    """Moments of the flux that leaves, of the end scatterers, and the largest distance of the distributions."""
    found = []
    for gamma in (1, "N"):
        programs = ("momentum_flux", "steady_profile")
        flux, profile = (data.of("ext10", program, gamma=gamma)[0] for program in programs)
        temperature = flux.parameters["temperature-left"]
        for place, half, name in OUTGOING:
            square = number(flux, "square", (place, half), f"⟨p²⟩/T - 1, {name}, γ = {gamma}")
            kurtosis = number(flux, "kurtosis", (place, half), f"⟨p⁴⟩/(3⟨p²⟩²) - 1, {name}, γ = {gamma}")
            label = f"⟨P²⟩/MT - 1 at x = {half}, γ = {gamma}"
            scatterer = number(profile, "temperature_scatterer", place, label)
            found += [square.over(temperature, 1), kurtosis.over(3, 1), scatterer.over(temperature, 1)]
        for result, curve, name in ((flux, ext10.outgoing_flux, "F"), (profile, ext10.end_scatterers, "g")):
            label = f"Kolmogorov's distance of {name}, γ = {gamma}"
            found.append(Number(label, *ext10.largest_distance(*curve(result)[1:]), freedom(result)))
    return Evidence(found)


def jump_and_halves(data: Data) -> Evidence:
    result = data.one("fig03", "paper")
    largest = float(result["flux_density"].mean.max())
    jumps = [
        number(result, "jump", place, f"jump over max F, x = {half}").over(largest)
        for place, half, _ in OUTGOING
    ]
    return Evidence([*jumps, *_departures(result)])


def _departures(result: Result, name: str = "") -> list[Number]:
    """|<p^4>/<p^2>^2 - 3| of the outgoing halves."""
    found = []
    for place, half, told in OUTGOING:
        departure = number(result, "kurtosis", (place, half)).over(1, 3)
        found.append(_magnitude(departure, f"|⟨p⁴⟩/⟨p²⟩² - 3|, {told}{name}"))
    return found


def _magnitude(number: Number, label: str = "") -> Number:
    """Has its error also where it vanishes."""
    return replace(number, value=abs(number.value), label=label)


def gaussian_only_if(data: Data) -> Evidence:
    """Only if: unequal temperatures make halves that are not Gaussian, at the σ of the paper's figure. If: equal ones make Gaussian
    halves."""
    unequal, equal, exchange = (data.one("fig03", run) for run in ("paper", "equal", "exchange"))
    largest = max(one.value for one in _departures(exchange))
    return Evidence(
        _departures(unequal, ", σ = 1/2"),
        alternative=_departures(equal, ", equal T"),
        caveat="The direction “only if” is judged; “if” is the alternative reading, at equal temperatures and unequal rates. The paper's "
        f"sentence is about σ = 1/2. At σ = 0 the distance is at most {scientific(largest, 1)} at unequal temperatures too, as momenta are only exchanged.",
    )


def _deviations(data: Data) -> tuple[pd.DataFrame, float]:
    """Of the finite chains from the continuum, by N and bin; degrees of freedom."""
    return fig03_inset.tabulate(data.of("fig03_inset")), freedom(*data.of("fig03_inset", "momentum_flux"))


def _bins(table: pd.DataFrame, known: float) -> list[Number]:
    """Of the simulation relative to max F, where enough fell into them for their errors to be known."""
    rows = table[(table.kind == "simulation") & (table.momentum.abs() < REACH)].itertuples()
    return [
        Number(f"F_N - F over max F, N = {row.cells}, p = {row.momentum:g}", row.deviation, row.error, known)
        for row in rows
    ]


def _shaped(table: pd.DataFrame, cells: int, known: float) -> tuple[list[Number], str]:
    """F_N - F as printed in every bin and at p = 0: the deviation in mean field, scaled to the simulation, as the largest of many
    noisy bins is biased. Where the simulation has another shape, what the scaling misses of it bounds the systematic error. Also
    returns the goodness of the scaling, as text."""
    near = table[(table.cells == cells) & (table.momentum.abs() < REACH)].sort_values("momentum")
    simulation, theory = (near[near.kind == kind] for kind in ("simulation", "mean field"))
    value, error, shape = (
        one.to_numpy() for one in (simulation.deviation, simulation.error, theory.deviation)
    )
    size, spread, misfit = fit_multiple(shape, value, error)
    bins = [
        Number(f"F_N - F as printed, N = {cells}, p = {row.momentum:g}", row.absolute_as_printed, 0.0)
        for row in theory.itertuples()
    ]
    scaled = [
        replace(one.over(1 / size), error=spread * abs(one.value), freedom=known)
        for one in (*bins, *_at_zero(theory, cells))
    ]
    known_bins = int(np.count_nonzero(error)) - 1
    told = f"At N = {cells} it is {with_error(size, spread)} of that in mean field, {{}} ({goodness(misfit, known_bins)})."
    if not rejected(misfit, known_bins):
        return scaled, told.format("whose shape it has")
    missed = math.sqrt(max(0.0, misfit / known_bins - 1) * np.mean(error[error > 0] ** 2))
    missed *= float((near.absolute_as_printed / near.deviation).median())
    shape_told = f"whose shape it has but for {scientific(missed)} (root mean square), which bounds the systematic error"
    return [with_systematic(one, [one.value + missed]) for one in scaled], told.format(shape_told)


def _at_zero(theory: pd.DataFrame, cells: int) -> list[Number]:
    """At p = 0, from both sides: on the line through the two innermost bins of a half. What the parabola through three gives
    bounds the systematic error."""
    found = []
    for side, told in ((-1, "below"), (1, "above")):
        inner = theory[side * theory.momentum > 0].sort_values("momentum", key=abs).head(len(LINE))
        value = inner.absolute_as_printed.to_numpy()
        label = f"F_N - F as printed, N = {cells}, {EXTRAPOLATED} to p = 0 from {told}"
        found.append(with_systematic(Number(label, float(LINE @ value), 0.0), [float(PARABOLA @ value)]))
    return found


def deviations_small(data: Data) -> Evidence:
    """Strictly, and to the digit printed."""
    table, known = _deviations(data)
    found, told = [], []
    for cells in sorted({*table.cells}):
        scaled, said = _shaped(table, cells, known)
        found += scaled
        told.append(said)
    return Evidence(
        found, found, _bins(table, known), caveat=f"{NORMALISATION} {told[0]} {_largest_bin(found)}"
    )


def deviations_at_16(data: Data) -> Evidence:
    """Strictly, and to the digit printed."""
    table, known = _deviations(data)
    found, told = _shaped(table, 16, known)
    caveat = f"{NORMALISATION} {told} {_largest_bin(found)}"
    return Evidence(found, found, _bins(table[table.cells == 16], known), caveat=caveat)


def _largest_bin(found: Sequence[Number]) -> str:
    """Of the numbers that are not extrapolated, in words."""
    largest = max((one for one in found if EXTRAPOLATED not in one.label), key=lambda one: abs(one.value))
    place = largest.label.partition(", ")[2]
    return f"The largest mean over a bin, as in the panel, is {with_error(largest.value, largest.error)} ({place})."


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
    """Exponent, against N, of the part of the deviation that has the shape of that of the mean field at N = 2; without so many of
    the smallest sizes."""
    table, _ = _deviations(data)
    results = by_size(data.of("fig03_inset", "momentum_flux"))[skipped:]
    found = fig03_inset.amplitudes(table).iloc[skipped:]
    amplitudes = [Number("", one.amplitude, one.error) for one in found.itertuples()]
    label = f"d ln |F_N - F| / d ln N, N = {found.cells.min()} to {found.cells.max()}"
    return power(results, [*found.cells], amplitudes, label)


def deviations_central(data: Data) -> Evidence:
    """At N = 2, where they are largest: central bins against those beyond the thermal momentum; odd part against even part."""
    table, known = _deviations(data)
    temperature = np.mean(data.one("fig03_inset", "simulation_cells=2").ends("temperature"))
    part = table[(table.kind == "simulation") & (table.cells == 2)].sort_values("momentum")
    momentum, value, error = (part[name].to_numpy() for name in ("momentum", "deviation", "error"))
    middle = len(momentum) // 2
    left, right = (Number("", value[k], error[k], known) for k in (middle - 1, middle))
    centre = combination([_magnitude(left), _magnitude(right)], [0.5, 0.5], "")
    outer = np.flatnonzero((np.abs(momentum) > np.sqrt(temperature)) & (np.abs(momentum) < REACH))
    less = []
    for k in outer:
        label = f"1 - |deviation at p = {momentum[k]:g}| over that at p = 0"
        both = [centre, Number("", abs(value[k]), error[k], known)]
        less.append(combination(both, [1 / centre.value, -1 / centre.value], label))
    half = 0.5 / abs(centre.value)
    odd = combination([left, right], [half, -half], "odd part over the whole at p = 0")
    return Evidence([*less, _magnitude(odd, odd.label)])


def on_top_of_kinetic(data: Data) -> Evidence:
    return Evidence(_from_kinetic(data, "fig04a", "rare", "kinetic"))


def _from_kinetic(data: Data, panel: str, run: str, equation: str, told: str = "") -> list[Number]:
    """F_N minus F over the largest F, behind the first scatterer and the last. told: of which chain."""
    simulated = data.one(panel, run)
    flux, kinetic = simulated["flux"], data.one(panel, equation)["flux"]
    last, scale = len(flux.mean) - 1, float(kinetic.mean.max())
    return [
        number(simulated, "flux", (bond, k), f"deviation over max F{told}, {name}, p = {p:g}").over(scale, fig04.at(kinetic, bond / last)[k] / scale)
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
    """Jump at equal rates, unequal temperatures and gamma = N, over max F. What the lines through two bins on either side, which give
    it, miss in mean field bounds the systematic error."""
    equal, kinetic = (data.one("fig04b", run) for run in ("equal", "mean-field-equal"))
    scale = float(equal["flux"].mean.max())
    missed = fig04.extrapolation_error(fig04.tabulate([equal, kinetic])) / scale
    jumps = [
        number(equal, "jump", bond, f"jump over max F at ν_L = ν_R, {name}").over(scale)
        for bond, name in ((1, "x = 1/N"), (-1, "x = 1"))
    ]
    theory = [float(kinetic["jump"].mean[bond]) / scale for bond in (1, -1)]
    return Evidence(
        [with_systematic(one, [one.value + missed]) for one in jumps],
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
