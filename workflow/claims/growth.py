"""Claims on the conductivity against the size (fig. 8, section 6)."""

from collections.abc import Sequence

from workflow.claims.data import Data, MissingError, number, power
from workflow.claims.evidence import Claim, Evidence
from workflow.claims.verdict import Number, with_systematic
from workflow.lib.fit import PowerLaw, with_error
from workflow.lib.load import Result

BULK = 16  # smaller chains are mostly ends
LARGE = 16  # the largest sizes are those within this factor of the largest
FIXED = ("dilute", "dense")  # series of ext09 at fixed spacing; `thinning` has the paper's 1/N


def sizes(data: Data, gamma: str | int) -> list[Result]:
    """Stationary runs of fig. 8, by N."""
    return _stationary(data.of("fig08", "conductivity", gamma=gamma))


def exponent(runs: Sequence[Result], name: str) -> tuple[Number, PowerLaw]:
    """Of kappa over these sizes."""
    if len(runs) < 2:
        raise MissingError("fewer than two sizes")
    cells = [one.parameters["cells"] for one in runs]
    label = f"{name}, N = {cells[0]} to {cells[-1]}"
    return power(runs, cells, [number(one, "kappa") for one in runs], label)


def largest_sizes(runs: Sequence[Result]) -> list[Result]:
    return [one for one in runs if one.parameters["cells"] * LARGE >= runs[-1].parameters["cells"]]


def last_exponents(data: Data) -> dict[str, Number]:
    """Of kappa between the two largest stationary sizes: fig. 8, and every series of ext09 that has been made."""
    series = {"fig08": sizes(data, "N")}
    for name in ("thinning", *FIXED):
        try:
            series[name] = _stationary([one for one in data.of("ext09") if one.path.stem.startswith(name)])
        except MissingError:
            continue
    return {name: exponent(runs[-2:], name)[0] for name, runs in series.items() if len(runs) > 1}


def _stationary(runs: Sequence[Result]) -> list[Result]:
    return sorted(
        (one for one in runs if one["stationary"].mean == 1), key=lambda one: one.parameters["cells"]
    )


def linear(data: Data) -> Evidence:
    found, law = exponent(largest_sizes(sizes(data, 1)), "d ln κ/d ln N, γ = 1")
    return Evidence([found], caveat=_fit(law))


def cube_root(data: Data) -> Evidence:
    """One exponent over the paper's sizes; in substance that of the largest sizes; at fixed spacing in the other reading.
    The exponents of the smaller and of the larger half of the sizes bound the systematic error."""
    runs = [one for one in sizes(data, "N") if one.parameters["cells"] >= BULK]
    found, law = exponent(runs, "d ln κ/d ln N, γ = N")
    half = len(runs) // 2
    parts = [exponent(part, "")[0].value for part in (runs[: half + 1], runs[half:]) if len(part) > 1]
    last = last_exponents(data)
    told = ", ".join(f"{with_error(one.value, one.error)} ({one.label})" for one in last.values())
    return Evidence(
        [with_systematic(found, parts)],
        [one for name, one in last.items() if name not in FIXED],
        [one for name, one in last.items() if name in FIXED],
        caveat=f"{_fit(law)} Between the largest sizes: {told}. At spacing 1/N the gas thins out as N grows.",
    )


def _fit(law: PowerLaw) -> str:
    return f"χ² of the power law {law.chi_square:.1f} with {law.freedom} degrees of freedom."


CLAIMS: dict[str, Claim] = {"C23": linear, "C24": cube_root}
