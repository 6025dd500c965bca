"""Claims on the conductivity against the size (fig. 8, section 6), and on heat in equilibrium."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from workflow.claims.data import (
    Claim,
    Data,
    Evidence,
    MissingError,
    by_size,
    freedom,
    mean_slope,
    number,
    power,
)
from workflow.claims.verdict import Number, with_systematic
from workflow.figures import ext09, ext13
from workflow.figures.ext11 import tabulate
from workflow.lib.fit import PowerLaw, fit_power, with_error
from workflow.lib.load import Result
from workflow.lib.style import spacing

T = TypeVar("T")

BULK = 16  # smaller chains are mostly ends
LARGE = 16  # the largest sizes are those within this factor of the largest
FIXED_SPACING = 0.1  # of ext11
EXPONENT = "d ln κ/d ln N"  # in the names of numbers
THINNING = "spacing 1/N"  # at which the gas thins out as N grows
SERIES = ("thinning", "dilute", "dense")  # of ext09, by spacing


def sizes(data: Data, gamma: str | int) -> list[Result]:
    """Stationary runs of fig. 8, by N."""
    return _stationary(data.of("fig08", "conductivity", gamma=gamma, rule="elastic"))


def _kappa(run: Result) -> Number:
    return number(run, "kappa")


def _by_particles(run: Result) -> Number:
    """kappa with the temperatures of the arriving particles in place of T_1 and T_N (eq. 28)."""
    return number(run, "kappa_particle")


def _by_baths(run: Result) -> Number:
    """kappa with the temperatures of the baths in place of T_1 and T_N."""
    return number(run, "energy_current").over(ext09.drop_per_cell(run))


def exponent(
    runs: Sequence[Result], name: str, kappa: Callable[[Result], Number] = _kappa
) -> tuple[Number, PowerLaw]:
    """Exponent of the conductivity over these sizes. Raises MissingError."""
    if len(runs) < 2:
        raise MissingError(f"Fewer than two sizes are stationary at this quality ({name})")
    cells = [one.parameters["cells"] for one in runs]
    label = f"{name}, N = {cells[0]} to {cells[-1]}"
    return power(runs, cells, [kappa(one) for one in runs], label)


def largest_sizes(runs: Sequence[Result]) -> list[Result]:
    return [one for one in runs if one.parameters["cells"] * LARGE >= runs[-1].parameters["cells"]]


def between_baths(data: Data, series: str) -> list[Result]:
    """Stationary runs of a series of ext09, by N."""
    return _stationary([one for one in data.of("ext09") if one.run.startswith(series)])


def thinning_exponents(data: Data) -> list[Number]:
    """Of kappa between the two largest sizes at the paper's spacing, for both drives; the labels are drive and sizes."""
    found = [one for one in last_exponents(data) if f", {THINNING}" in one.label]
    return [
        replace(one, label=one.label.removeprefix(f"{EXPONENT}, ").replace(f", {THINNING}", ""))
        for one in found
    ]


def last_exponents(data: Data) -> list[Number]:
    """Exponents of kappa between baths, in fig. 8 and in every series of ext09 that has been made."""
    try:
        series = [between_baths(data, name) for name in SERIES]
    except MissingError:  # no ext09 at all
        series = []
    return [last_exponent(runs) for runs in (sizes(data, "N"), *series) if len(runs) > 1]


def last_exponent(runs: Sequence[Result]) -> Number:
    """Exponent of kappa between the two largest sizes. The temperatures of the arriving particles and of the baths in place of T_1
    and T_N, which give the same exponent in an infinite chain, bound the systematic error."""
    left, right = runs[-1].ends("temperature")
    label = f"{EXPONENT}, T_R/T_L = {right / left:.2g}, spacing {spacing(runs[-1])[1]}"
    one, *others = (exponent(runs[-2:], label, kappa)[0] for kappa in (_kappa, _by_particles, _by_baths))
    return with_systematic(one, [other.value for other in others])


def _stationary(runs: Sequence[Result]) -> list[Result]:
    return by_size(one for one in runs if one["stationary"].mean == 1)


def linear(data: Data) -> Evidence:
    found, law = exponent(largest_sizes(sizes(data, 1)), f"{EXPONENT}, γ = 1")
    return Evidence([found], caveat=f"Over these sizes {_fit(law)}")


def halves(by_size: Sequence[T]) -> list[Sequence[T]]:
    """The smaller and the larger sizes, with the middle one in both. A power law has one exponent in them."""
    middle = len(by_size) // 2
    return [part for part in (by_size[: middle + 1], by_size[middle:]) if len(part) > 1]


def cube_root(data: Data) -> Evidence:
    """Literal: of the smaller and of the larger half of fig. 8's sizes, which a power law has in common. Intended, at fixed density:
    of the heat that passes in equilibrium, and of the conductivity without a particle current. Alternative: between baths."""
    runs = [one for one in sizes(data, "N") if one.parameters["cells"] >= BULK]
    _, law = exponent(runs, f"fig. 8, γ = N, {BULK} cells or more")
    last = [f"{with_error(one.value, one.error)} at {one.label}" for one in thinning_exponents(data)]
    return Evidence(
        [exponent(part, f"{EXPONENT}, γ = N, {THINNING}")[0] for part in halves(runs)],
        [*equilibrium(data), without_particle_current(data)],
        last_exponents(data),
        caveat=f"At the paper's spacing 1/N the density falls as N grows. Over all sizes {_fit(law)} Between the two largest "
        f"the exponent is {' and '.join(last)}.{_diffusion(data)} The intended band tells 1/3 from diffusion and from 1/2, not from 2/5.",
    )


def equilibrium(data: Data) -> list[Number]:
    """b of κ ∼ N^b, as <Q²> ∼ t^(1+b), of every gas over the last octave of its longest ring."""
    return [last_octave(ring) for ring in longest_rings(data)]


def longest_rings(data: Data) -> list[Result]:
    """Of every gas in ext. 13 that conserves momentum."""
    longest: dict[str, Result] = {}
    for ring in sorted(data.of("ext13", rule="elastic"), key=_last_time):
        longest[gas_name(ring)] = ring
    return [*longest.values()]


def last_octave(ring: Result) -> Number:
    """d ln⟨Q²⟩/d ln t - 1; by how much the octave before differs bounds the systematic error."""
    label = f"d ln⟨Q²⟩/d ln t - 1, {gas_name(ring)}, t = {_last_time(ring):.0f}"
    before, last = (number(ring, "local_exponent", k, label).over(1, 1) for k in (-2, -1))
    return with_systematic(last, [before.value])


def gas_name(ring: Result) -> str:
    gas = ext13.chain(ring)
    return f"ζ = {gas.zeta:g}, M = {gas.mass:.2g}"


def _last_time(ring: Result) -> float:
    """Middle of the last octave."""
    return float(ring["local_exponent"].axes["middle"][-1])


def _diffusion(data: Data) -> str:
    """What the chains and rings do that do not conserve momentum, in words."""
    told = f" With random directions, which do not conserve momentum, {saturation(data)}."
    for ring in data.of("ext13", rule="random-direction"):
        quantity = ring["local_exponent"]
        before, last = (with_error(quantity.mean[k] - 1, quantity.error[k]) for k in (-2, -1))
        told += f" In a ring d ln⟨Q²⟩/d ln t - 1 is then {before} and {last} in the last two octaves, to t = {_last_time(ring):.0f} ({gas_name(ring)})."
    return told


def saturation(data: Data) -> str:
    """κ of the two longest chains with random directions of every spacing, and its exponent between them, in words."""
    runs: dict[str, list[Result]] = {}
    for run in _stationary(data.of("fig08", "conductivity", rule="random-direction")):
        runs.setdefault(spacing(run)[1], []).append(run)
    told = []
    for length, of_spacing in runs.items():
        pair = of_spacing[-2:]
        values = [
            f"{with_error(one.value, one.error)} at N = {run.parameters['cells']}"
            for run, one in zip(pair, map(_kappa, pair), strict=True)
        ]
        slope = f", an exponent of {exponent(pair, '')[1].text}" if len(pair) > 1 else ""
        told.append(f"{' and '.join(values)} (λ = {length}{slope})")
    return f"κ is {'; '.join(told)}" if told else "κ is stationary at no size"


def stationary_at_fixed_spacing(data: Data) -> list[Result]:
    """Runs of ext. 11 at fixed spacing, of sizes whose runs are all stationary. Raises MissingError."""
    asked = data.of("ext11", "conductivity", cell_length=FIXED_SPACING)
    moving = {one.parameters["cells"] for one in asked if one["stationary"].mean != 1}
    runs = [one for one in asked if one.parameters["cells"] not in moving]
    if len({one.parameters["cells"] for one in runs}) < 2:
        raise MissingError("Fewer than two sizes of ext11 are stationary at this quality")
    return runs


def without_particle_current(data: Data, last: int | None = None) -> Number:
    """Exponent of kappa_0, the conductivity at J_n = 0, at fixed spacing (ext. 11), over all sizes or so many of the largest. Those
    of the smaller and of the larger half bound the systematic error."""
    runs = stationary_at_fixed_spacing(data)
    table = tabulate(runs)
    table = table.iloc[-last:] if last else table
    values = [*zip(table.cells, table.kappa_0, table.kappa_0_error, strict=True)]
    law, *parts = (fit_power(*np.array(part, float).T) for part in (values, *halves(values)))
    label = f"d ln κ_0/d ln N at J_n = 0 and spacing {FIXED_SPACING}, N = {table.cells.min()} to {table.cells.max()}"
    found = Number(mean_slope(label, law), law.exponent, law.error, freedom(*runs))
    return with_systematic(found, [part.exponent for part in parts])


def _fit(law: PowerLaw) -> str:
    return f"the power law has χ² = {law.chi_square:.1f} for {law.freedom}."


CLAIMS: dict[str, Claim] = {"C23": linear, "C24": cube_root}
