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
from workflow.lib.conductivity import drop_per_cell
from workflow.lib.fit import PowerLaw, fit_power, with_error
from workflow.lib.load import Result
from workflow.lib.response import tabulate
from workflow.lib.rings import chain
from workflow.lib.style import spacing

T = TypeVar("T")

BULK = 16  # cells; shorter chains are dominated by their ends
LARGE = 16  # the largest sizes are those within this factor of the largest
FIXED_SPACING = 0.1  # spacing of the chains of ext. 11 that have a thermodynamic limit
EXPONENT = "d ln κ/d ln N"  # part of the labels of exponents
THINNING = "spacing 1/N"  # at which the gas thins out as N grows
SERIES = ("thinning", "dilute", "dense")  # first parts of the names of the runs of ext09, one per spacing


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
    return number(run, "energy_current").over(drop_per_cell(run))


def exponent(
    runs: Sequence[Result], name: str, kappa: Callable[[Result], Number] = _kappa
) -> tuple[Number, PowerLaw]:
    """Exponent of the conductivity against the number of cells, over the sizes of the runs. Raises MissingError for fewer than two."""
    if len(runs) < 2:
        raise MissingError(f"Fewer than two sizes are stationary at this quality ({name})")
    cells = [run.parameters["cells"] for run in runs]
    label = f"{name}, N = {cells[0]} to {cells[-1]}"
    return power(runs, cells, [kappa(run) for run in runs], label)


def largest_sizes(runs: Sequence[Result]) -> list[Result]:
    return [run for run in runs if run.parameters["cells"] * LARGE >= runs[-1].parameters["cells"]]


def between_baths(data: Data, series: str) -> list[Result]:
    """Stationary runs of a series of ext09, by N."""
    return _stationary([run for run in data.of("ext09") if run.run.startswith(series)])


def thinning_exponents(data: Data) -> list[Number]:
    """Exponents of kappa between the two largest sizes at the paper's spacing, for both drives, labelled by drive and sizes."""
    slopes = [slope for slope in last_exponents(data) if f", {THINNING}" in slope.label]
    return [
        replace(slope, label=slope.label.removeprefix(f"{EXPONENT}, ").replace(f", {THINNING}", ""))
        for slope in slopes
    ]


def last_exponents(data: Data) -> list[Number]:
    """Exponents of kappa between baths, in fig. 8 and in every series of ext09 that has results."""
    try:
        series = [between_baths(data, name) for name in SERIES]
    except MissingError:  # ext09 has no results
        series = []
    return [last_exponent(runs) for runs in (sizes(data, "N"), *series) if len(runs) > 1]


def last_exponent(runs: Sequence[Result]) -> Number:
    """Exponent of kappa between the two largest sizes. With the temperatures of the arriving particles or of the baths in place of T_1
    and T_N it would be the same in an infinite chain; the differences bound the systematic error."""
    left, right = runs[-1].ends("temperature")
    label = f"{EXPONENT}, T_R/T_L = {right / left:.2g}, spacing {spacing(runs[-1])[1]}"
    slope, *alternatives = (
        exponent(runs[-2:], label, kappa)[0] for kappa in (_kappa, _by_particles, _by_baths)
    )
    return with_systematic(slope, [alternative.value for alternative in alternatives])


def _stationary(runs: Sequence[Result]) -> list[Result]:
    return by_size(run for run in runs if run["stationary"].mean == 1)


def linear(data: Data) -> Evidence:
    slope, law = exponent(largest_sizes(sizes(data, 1)), f"{EXPONENT}, γ = 1")
    return Evidence([slope], caveat=f"Over these sizes {_fit(law)}")


def halves(by_size: Sequence[T]) -> list[Sequence[T]]:
    """The smaller and the larger sizes, with the middle one in both. A power law has the same exponent in both halves."""
    middle = len(by_size) // 2
    return [part for part in (by_size[: middle + 1], by_size[middle:]) if len(part) > 1]


def cube_root(data: Data) -> Evidence:
    """Exponents of kappa. Literal: over the smaller and over the larger half of fig. 8's sizes, which agree for a power law. Intended, at
    fixed density: from the heat that passes in equilibrium, and from the conductivity without a particle current. Alternative: between
    the two largest sizes of fig. 8 and of every series of ext. 9."""
    runs = [run for run in sizes(data, "N") if run.parameters["cells"] >= BULK]
    _, law = exponent(runs, f"fig. 8, γ = N, {BULK} cells or more")
    last = [f"{with_error(slope.value, slope.error)} at {slope.label}" for slope in thinning_exponents(data)]
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
    """The ring of longest time of every gas in ext. 13 that conserves momentum."""
    longest: dict[str, Result] = {}
    for ring in sorted(data.of("ext13", rule="elastic"), key=_last_time):
        longest[gas_name(ring)] = ring
    return [*longest.values()]


def last_octave(ring: Result) -> Number:
    """d ln⟨Q²⟩/d ln t - 1 over the last octave; the difference from the octave before bounds the systematic error."""
    label = f"d ln⟨Q²⟩/d ln t - 1, {gas_name(ring)}, t = {_last_time(ring):.0f}"
    before, last = (number(ring, "local_exponent", k, label).over(1, 1) for k in (-2, -1))
    return with_systematic(last, [before.value])


def gas_name(ring: Result) -> str:
    gas = chain(ring)
    return f"ζ = {gas.zeta:g}, M = {gas.mass:.2g}"


def _last_time(ring: Result) -> float:
    """Geometric middle of the last octave of time."""
    return float(ring["local_exponent"].axes["middle"][-1])


def _diffusion(data: Data) -> str:
    """Sentences on the chains and rings that do not conserve momentum."""
    text = f" With random directions, which do not conserve momentum, {saturation(data)}."
    for ring in data.of("ext13", rule="random-direction"):
        quantity = ring["local_exponent"]
        before, last = (with_error(quantity.mean[k] - 1, quantity.error[k]) for k in (-2, -1))
        text += f" In a ring d ln⟨Q²⟩/d ln t - 1 is then {before} and {last} in the last two octaves, to t = {_last_time(ring):.0f} ({gas_name(ring)})."
    return text


def saturation(data: Data) -> str:
    """κ of the two longest chains with random directions of every spacing, and its exponent between them, as text."""
    runs: dict[str, list[Result]] = {}
    for run in _stationary(data.of("fig08", "conductivity", rule="random-direction")):
        runs.setdefault(spacing(run)[1], []).append(run)
    texts = []
    for length, of_spacing in runs.items():
        pair = of_spacing[-2:]
        values = [
            f"{with_error(kappa.value, kappa.error)} at N = {run.parameters['cells']}"
            for run, kappa in zip(pair, map(_kappa, pair), strict=True)
        ]
        slope = f", an exponent of {exponent(pair, '')[1].text}" if len(pair) > 1 else ""
        texts.append(f"{' and '.join(values)} (λ = {length}{slope})")
    return f"κ is {'; '.join(texts)}" if texts else "κ is stationary at no size"


def stationary_at_fixed_spacing(data: Data) -> list[Result]:
    """Runs of ext. 11 at fixed spacing, of sizes whose runs are all stationary. Raises MissingError."""
    planned = data.of("ext11", "conductivity", cell_length=FIXED_SPACING)
    moving = {run.parameters["cells"] for run in planned if run["stationary"].mean != 1}
    runs = [run for run in planned if run.parameters["cells"] not in moving]
    if len({run.parameters["cells"] for run in runs}) < 2:
        raise MissingError("Fewer than two sizes of ext11 are stationary at this quality")
    return runs


def without_particle_current(data: Data, last: int | None = None) -> Number:
    """Exponent of kappa_0, the conductivity at J_n = 0, at fixed spacing (ext. 11), over all sizes or over the `last` largest.
    The exponents over the smaller and over the larger half bound the systematic error."""
    runs = stationary_at_fixed_spacing(data)
    table = tabulate(runs)
    table = table.iloc[-last:] if last else table
    values = [*zip(table.cells, table.kappa_0, table.kappa_0_error, strict=True)]
    law, *parts = (fit_power(*np.array(part, float).T) for part in (values, *halves(values)))
    label = f"d ln κ_0/d ln N at J_n = 0 and spacing {FIXED_SPACING}, N = {table.cells.min()} to {table.cells.max()}"
    slope = Number(mean_slope(label, law), law.exponent, law.error, freedom(*runs))
    return with_systematic(slope, [part.exponent for part in parts])


def _fit(law: PowerLaw) -> str:
    return f"the power law has χ² = {law.chi_square:.1f} for {law.freedom}."


CLAIMS: dict[str, Claim] = {"C23": linear, "C24": cube_root}
