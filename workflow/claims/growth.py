"""Claims on the conductivity against the size (fig. 8, section 6)."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

import numpy as np

from workflow.claims.data import Data, MissingError, freedom, mean_slope, number, power, where_made
from workflow.claims.evidence import Claim, Evidence
from workflow.claims.verdict import Number, with_systematic
from workflow.figures import ext09
from workflow.figures.ext11 import tabulate
from workflow.lib.fit import PowerLaw, fit_power, with_error
from workflow.lib.growth import Growth, fits
from workflow.lib.load import Result
from workflow.lib.style import spacing

T = TypeVar("T")

BULK = 16  # smaller chains are mostly ends
LARGE = 16  # the largest sizes are those within this factor of the largest
FIXED_SPACING = 0.1  # of ext11
EXPONENT = "d ln κ/d ln N"  # in the names of numbers
FIXED = ("dilute", "dense")  # series of ext09 at fixed spacing; `thinning` has the paper's 1/N


def sizes(data: Data, gamma: str | int) -> list[Result]:
    """Stationary runs of fig. 8, by N."""
    return _stationary(data.of("fig08", "conductivity", gamma=gamma))


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
    """Of the conductivity over these sizes."""
    if len(runs) < 2:
        raise MissingError(f"Fewer than two sizes are stationary at this quality ({name})")
    cells = [one.parameters["cells"] for one in runs]
    label = f"{name}, N = {cells[0]} to {cells[-1]}"
    return power(runs, cells, [kappa(one) for one in runs], label)


def largest_sizes(runs: Sequence[Result]) -> list[Result]:
    return [one for one in runs if one.parameters["cells"] * LARGE >= runs[-1].parameters["cells"]]


def _series(data: Data) -> dict[str, list[Result]]:
    """Stationary runs of every series of ext09 that has been made, by N."""
    try:
        made = data.of("ext09")
    except MissingError:
        return {}
    by_name = {
        name: _stationary([one for one in made if one.path.stem.startswith(name)])
        for name in ("thinning", *FIXED)
    }
    return {name: runs for name, runs in by_name.items() if runs}


def last_exponents(data: Data) -> dict[str, Number]:
    """Of kappa between the two largest stationary sizes: fig. 8, and every series of ext09 that has been made. Those of kappa by
    the temperatures of the arriving particles and of the baths bound the systematic error: in an infinite chain all are one. To it
    is added what a start that is not forgotten could change."""

    def between(name: str, runs: Sequence[Result]) -> Number:
        left, right = (runs[-1].parameters[f"temperature-{side}"] for side in ("left", "right"))
        label = f"{EXPONENT}, T_R/T_L = {right / left:.2g}, spacing {spacing(runs[-1])[1]}"
        found, *others = (exponent(runs, label, kappa)[0] for kappa in (_kappa, _by_particles, _by_baths))
        defined = with_systematic(found, [one.value for one in others])
        memory, _ = memory_of_start(data, name)
        return with_systematic(defined, [defined.value + memory])

    series = {"fig08": sizes(data, "N")} | _series(data)
    return {name: between(name, runs[-2:]) for name, runs in series.items() if len(runs) > 1}


def memory_of_start(data: Data, series: str) -> tuple[float, int]:
    """Half the difference of ln kappa between a cold and a hot start (ext. 12), at the largest size that has them, over ln 2: what it
    would change an exponent by if only one of two sizes, a factor of two apart, had it; and that size. 0 where no start was varied."""
    try:
        runs = [one for one in data.of("ext12") if one.path.stem.startswith(f"{series}-start")]
    except MissingError:
        return 0.0, 0
    largest = max((one.parameters["cells"] for one in runs), default=0)
    kappa = {one.parameters["start"]: _kappa(one).value for one in runs if one.parameters["cells"] == largest}
    return (abs(math.log(kappa["hot"] / kappa["cold"])) / 2 / math.log(2) if kappa else 0.0), largest


def starts(data: Data) -> str:
    """Up to which size starts were varied at fixed spacing, in words; nothing where none was."""
    largest = max(memory_of_start(data, series)[1] for series in FIXED)
    return (
        f"; starts were varied there up to N = {largest} (ext12), and what they change is in the bounds"
        if largest
        else ""
    )


def _stationary(runs: Sequence[Result]) -> list[Result]:
    return sorted(
        (one for one in runs if one["stationary"].mean == 1), key=lambda one: one.parameters["cells"]
    )


def laws(data: Data) -> dict[str, list[Growth]]:
    """Every law, one with a finite limit among them, fitted to ext09 at fixed spacing over the largest sizes, by spacing and sizes."""
    fitted = {}
    fixed = [runs for name, runs in _series(data).items() if name in FIXED]
    for runs in map(largest_sizes, fixed):
        cells = [one.parameters["cells"] for one in runs]
        values = [_kappa(one) for one in runs]
        if found := fits(cells, [one.value for one in values], [one.error for one in values], cells[0]):
            fitted[f"spacing {spacing(runs[-1])[1]}, N = {cells[0]} to {cells[-1]}"] = found
    return fitted


def without_limit(fitted: Mapping[str, Sequence[Growth]]) -> str:
    """That the law with a finite limit is rejected at every spacing, beside how the others fit, in words; nothing if it is not.
    Laws that come to a limit more slowly are not tested."""
    bounded = [one for found in fitted.values() for one in found if one.law == "constant"]
    if not bounded or max(one.p_value for one in bounded) > ext09.LEVEL:
        return ""
    told = "; ".join(f"at {place}, {ext09.compared(found)}" for place, found in fitted.items())
    return f"a finite limit that is approached as N^(-1/3) is rejected at fixed density: {told}"


def linear(data: Data) -> Evidence:
    found, law = exponent(largest_sizes(sizes(data, 1)), f"{EXPONENT}, γ = 1")
    return Evidence([found], caveat=_fit(law))


def halves(by_size: Sequence[T]) -> list[Sequence[T]]:
    """The smaller and the larger sizes, with the middle one in both. A power law has one exponent in them."""
    middle = len(by_size) // 2
    return [part for part in (by_size[: middle + 1], by_size[middle:]) if len(part) > 1]


def cube_root(data: Data) -> Evidence:
    """Of the smaller and of the larger half of fig. 8's sizes, which a power law has in common; intended meaning: between the largest
    sizes; alternative reading, at fixed spacing: of the conductivity without a particle current, and between the largest sizes."""
    runs = [one for one in sizes(data, "N") if one.parameters["cells"] >= BULK]
    _, law = exponent(runs, f"fig. 8, γ = N, {BULK} cells or more")
    last, fitted = last_exponents(data), laws(data)
    limit = without_limit(fitted)
    compared = "".join(f" At {place}, {ext09.compared(found)}." for place, found in fitted.items())
    told = ", ".join(f"{with_error(one.value, one.error)} ({one.label})" for one in last.values())
    return Evidence(
        [exponent(part, f"{EXPONENT}, γ = N, spacing 1/N")[0] for part in halves(runs)],
        [one for name, one in last.items() if name not in FIXED],
        [
            *where_made(lambda: [without_particle_current(data)]),
            *(one for name, one in last.items() if name in FIXED),
        ],
        caveat=f"Over all sizes {_fit(law)} Between the largest sizes: {told}. At spacing 1/N the gas thins out as N grows, so that size and density change together.{compared}",
        remark=limit + starts(data) if limit else "",
    )


def without_particle_current(data: Data) -> Number:
    """Exponent of kappa_0, the conductivity at J_n = 0, at fixed spacing (ext. 11), over sizes whose runs are stationary. Those
    of the smaller and of the larger half bound the systematic error."""
    asked = data.of("ext11", cell_length=FIXED_SPACING)
    moving = {one.parameters["cells"] for one in asked if one["stationary"].mean != 1}
    runs = [one for one in asked if one.parameters["cells"] not in moving]
    if len({one.parameters["cells"] for one in runs}) < 2:
        raise MissingError("Fewer than two sizes of ext11 are stationary at this quality")
    table = tabulate(runs)
    values = [*zip(table.cells, table.kappa_0, table.kappa_0_error, strict=True)]
    law, *parts = (fit_power(*np.array(part, float).T) for part in (values, *halves(values)))
    label = f"d ln κ_0/d ln N at J_n = 0 and spacing {FIXED_SPACING}, N = {table.cells.min()} to {table.cells.max()}"
    found = Number(mean_slope(label, law), law.exponent, law.error, freedom(*runs))
    return with_systematic(found, [part.exponent for part in parts])


def _fit(law: PowerLaw) -> str:
    return f"χ² of the power law {law.chi_square:.1f} with {law.freedom} degrees of freedom."


CLAIMS: dict[str, Claim] = {"C23": linear, "C24": cube_root}
