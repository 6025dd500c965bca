"""The numbers that claims are judged by, as in test_claim_numbers.py: conductivity against size."""

import math
import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from tests.python.claim_numbers import check, freedom, of, power
from tests.python.known_results import Known, quantity, truth, uneven
from tests.python.known_worlds import drop_per_cell
from workflow.claims.data import MissingError
from workflow.claims.growth import without_limit
from workflow.claims.judge import FUNCTIONS
from workflow.lib.growth import Growth
from workflow.lib.load import Quantity
from workflow.lib.plan import Run


def conductivities(run: Run, odd: int = 0) -> dict[str, Quantity]:
    """About N, three times that at one size; wrong where the run is not stationary: N = 64 and the largest of fig. 8."""
    found = uneven(run)
    if run.program != "conductivity":
        return found
    size = run.options["cells"]
    moving = size == 64 or run.name == "large_cells=2048"
    factor = size * (1000 if moving else 3 if size == odd else 1)
    kappas = {
        name: quantity(run, name, (1 + 0.1 * found[name].mean) * factor, found[name].error * size)
        for name in ("kappa", "kappa_particle")
    }
    stationary = replace(found["stationary"], mean=np.array(float(not moving)))
    energy = current(run, (1 + 0.1 * found["energy_current"].mean) * factor)
    return found | kappas | {"stationary": stationary, "energy_current": energy}


def current(run: Run, kappa: np.ndarray) -> Quantity:
    """Of energy, where kappa has the temperatures of the baths."""
    return quantity(run, "energy_current", kappa * drop_per_cell(run), np.array(0.01))


SOME = Known(dict.fromkeys(("fig08", "fig09a", "fig09b", "ext09"), conductivities))


def kappa(
    panel: str, sizes: Sequence[int], *series: str, data: Known = SOME, name: str = "kappa"
) -> tuple[list[int], np.ndarray, np.ndarray]:
    """By size, of the series that has it."""
    names = {run.options["cells"]: run.name for run in SOME.plan[panel].runs if run.series in series}
    mean, error = np.array([of(panel, names[size], name, data) for size in sizes]).T
    return [*sizes], mean, error


def last_two(panel: str, sizes: Sequence[int], series: str, data: Known) -> tuple[float, float, float]:
    """Exponent between two sizes; those by the temperatures of the particles and of the baths bound the systematic error."""
    kinds = ("kappa", "kappa_particle")
    found, other = (power(*kappa(panel, sizes, series, data=data, name=name)) for name in kinds)
    _, (first, second), _ = kappa(panel, sizes, series, data=data, name="energy_current")
    by_baths = 1 + math.log(second / first) / math.log(sizes[1] / sizes[0])
    bounds = [abs(one - found[0]) for one in (other[0], by_baths)]
    assert min(bounds) > 1e-3
    return found[0], found[1], max(bounds)


@pytest.mark.parametrize("odd", [128, 1024])  # so that the one or the other half is the farther off
def test_conductivity(odd: int) -> None:
    """At gamma = 1 from a sixteenth of the largest size on; at gamma = N both halves from 16 on, and between the two largest."""
    data = Known(dict.fromkeys(("fig08", "ext09"), partial(conductivities, odd=odd)))
    kappas = partial(kappa, data=data)
    rare = power(*kappas("fig08", [128, 256, 512, 1024, 2048], "rare"))
    check(FUNCTIONS["C23"](data).literal, *rare, freedom("fig08", "rare"))

    evidence = FUNCTIONS["C24"](data)
    sizes = [16, 32, 128, 256, 512, 1024]
    parts = [power(*kappas("fig08", part, "deterministic", "large")) for part in (sizes[:4], sizes[3:])]
    check(evidence.literal, *np.array(parts).T)
    assert [one.freedom for one in evidence.literal] == [
        freedom("fig08", "deterministic"),
        freedom("fig08", "large"),
    ]
    last = [
        last_two("fig08", [512, 1024], "large", data),
        last_two("ext09", [1024, 2048], "thinning-large", data),
    ]
    check(evidence.intended, *np.array(last).T)
    assert [one.freedom for one in evidence.intended] == [
        freedom("fig08", "large"),
        freedom("ext09", "thinning-large"),
    ]


def test_conductivity_with_a_finite_limit() -> None:
    """Which ext. 9 at fixed spacing has, or has not. The sizes within a factor of 16 of the largest decide."""

    def told(limit: bool) -> dict[str, float]:
        def fill(run: Run) -> dict[str, Quantity]:
            size = run.options["cells"]
            kappa = (900 - 700 * size ** (-1 / 3) if limit else 20 + 50 * size ** (1 / 3)) * (
                1 if size >= 128 else 2
            )
            return uneven(run) | {
                "kappa": quantity(run, "kappa", np.array(kappa), np.array(0.01 * kappa)),
                "energy_current": current(run, np.array(kappa)),
                "stationary": quantity(run, "stationary", np.array(1.0), None),
            }

        caveat = FUNCTIONS["C24"](Known({"fig08": conductivities, "ext09": fill})).caveat
        law = r"At spacing ([\d.]+), N = 128 to 2048, χ² is, with 3 degrees of freedom, ([\d.]+) for a \+ b N\^\(-1/3\)"
        return {spacing: float(found) for spacing, found in re.findall(law, caveat)}

    assert told(True) == {"0.1": 0.0, "0.025": 0.0}
    size = 2.0 ** np.arange(7, 12)
    kappa = 20 + 50 * np.cbrt(size)
    _, (left_over,), *_ = np.linalg.lstsq(
        np.stack([np.ones(5), 1 / np.cbrt(size)], axis=1) / (0.01 * kappa)[:, None], np.full(5, 100.0)
    )
    assert left_over > 50
    assert told(False) == pytest.approx({"0.1": left_over, "0.025": left_over}, abs=0.05)


def test_a_finite_limit_is_rejected_where_every_spacing_rejects_it() -> None:
    """98 for 3 degrees of freedom has p = 4e-21, 3 has 0.39."""

    def fitted(chi_square: float) -> list[Growth]:
        return [Growth("constant", 128, chi_square, 3, 2), Growth("logarithm", 128, 1.0, 3, 2)]

    assert without_limit({"spacing 1": fitted(98), "spacing 2": fitted(70)}) == (
        "a finite limit that is approached as N^(-1/3) is rejected at fixed density: "
        "at spacing 1, χ² is, with 3 degrees of freedom, 98.0 for a + b N^(-1/3), 1.0 for a + b ln N; "
        "at spacing 2, χ² is, with 3 degrees of freedom, 70.0 for a + b N^(-1/3), 1.0 for a + b ln N"
    )
    assert without_limit({"spacing 1": fitted(98), "spacing 2": fitted(3)}) == ""
    assert without_limit({}) == ""


@pytest.mark.parametrize("apart", [0.04, -0.04])
def test_a_start_that_is_not_forgotten_widens_the_bound(apart: float) -> None:
    """By half the difference of ln kappa between the cold and the hot start at the largest size that has them, over ln 2."""

    def fill(run: Run) -> dict[str, Quantity]:
        size, start = run.options["cells"], run.options["start"]
        moved = apart if run.series.startswith("dense") and size == 512 else 0.3 if size == 64 else 0
        kappa = np.array(100 * (math.exp(moved) if start == "hot" else 1.0))
        return uneven(run) | {"kappa": quantity(run, "kappa", kappa, 0.01 * kappa)}

    def bounds(**worlds: Callable[[Run], dict[str, Quantity]]) -> dict[str, float]:
        evidence = FUNCTIONS["C24"](Known({"fig08": conductivities, "ext09": conductivities, **worlds}))
        return {one.label: one.systematic for one in (*evidence.intended, *evidence.alternative)}

    widened, plain = bounds(ext12=fill), bounds()
    assert {label.partition(", N = ")[0]: widened[label] - plain[label] for label in plain} == pytest.approx({
        "d ln κ/d ln N, T_R/T_L = 1.5, spacing 1/N": 0,
        "d ln κ/d ln N, T_R/T_L = 4, spacing 1/N": 0,
        "d ln κ/d ln N, T_R/T_L = 4, spacing 0.025": 0,
        "d ln κ/d ln N, T_R/T_L = 4, spacing 0.1": 0.02 / math.log(2),
    })  # fmt: skip


def test_an_exponent_is_called_a_mean_slope_where_the_law_is_rejected() -> None:
    """With errors of a hundredth: of kappa ~ N where every size follows it, and where one is three times as large."""

    def labels(odd: int) -> list[str]:
        def fill(run: Run) -> dict[str, Quantity]:
            size = run.options["cells"]
            kappa = np.array(float(size * (3 if size == odd else 1)))
            still = quantity(run, "stationary", np.array(1.0), None)
            return uneven(run) | {"kappa": quantity(run, "kappa", kappa, 0.01 * kappa), "stationary": still}

        return [one.label for one in FUNCTIONS["C23"](Known({"fig08": fill})).literal]

    (straight,), (bent,) = labels(0), labels(512)
    assert "mean slope" not in straight
    assert bent.startswith(f"{straight}, a mean slope (χ² = ")


@pytest.mark.parametrize("few", [1, 2])
def test_an_exponent_takes_two_sizes(few: int) -> None:
    """Of ext. 9 that are stationary."""

    def fill(run: Run) -> dict[str, Quantity]:
        still = run.series.startswith("thinning") and run.options["cells"] in (16, 32)[:few]
        stationary = quantity(run, "stationary", np.array(float(still)), None)
        return uneven(run) | {"stationary": stationary, "energy_current": current(run, np.array(1.0))}

    intended = FUNCTIONS["C24"](Known({"fig08": conductivities, "ext09": fill})).intended
    assert len(intended) == few


@pytest.mark.parametrize(
    ("number", "claim", "sizes", "series"),
    [
        (0, "C27", [128, 256, 512, 1024], ["deterministic", "large"]),
        (1, "C28", [128, 256, 512, 1024, 2048], ["rare"]),
    ],
)
def test_relation_of_pulse_and_conductivity(
    number: int, claim: str, sizes: list[int], series: list[str]
) -> None:
    exponent, error, bound = power(*kappa("fig08", sizes, *series))
    (peak,) = FUNCTIONS[claim](SOME).literal
    slope = 1 / peak.value**2
    found = FUNCTIONS["C30"](SOME).literal[number]
    expected = 2 - 1 / peak.value - exponent
    error = math.hypot(slope * peak.error, error)
    check([found], expected, error, slope * peak.systematic + bound, freedom("fig08", series[-1]))


def test_conductivity_without_a_particle_current() -> None:
    """Currents by linear response with kappa_0 = N^0.3 but at N = 16; only the energy current at a difference of temperature, in which
    kappa_0 is linear, has an error. The thinning gas has another response, and the largest chain is not stationary."""

    sizes, moving = np.array([16, 32, 64, 128]), 256
    kappa_0 = dict(zip(sizes, sizes**0.3, strict=True)) | {16: 3, moving: 1000}

    def currents(name: str) -> Callable[[Run], float]:
        def of_run(run: Run) -> float:
            o, cells = run.options, run.options["cells"]
            left, right = ((o[f"temperature-{end}"], o[f"nu-{end}"]) for end in ("left", "right"))
            heat = 1 / right[0] - 1 / left[0]
            drift = math.log(left[1] / right[1] * math.sqrt(right[0] / left[0]))
            nn, un = 3 * cells, 70 * cells * (5 if o["cell-length"] == "1/N" else 1)
            uu = 1e4 * kappa_0[cells] + un**2 / nn
            row = (uu, un) if name == "energy_current" else (un, nn)
            return float((row[0] * heat + row[1] * drift) / cells)

        return of_run

    given = {name: currents(name) for name in ("energy_current", "particle_current")}

    def fill(run: Run, still: Collection[int] = sizes) -> dict[str, Quantity]:
        stationary = float(run.options["cells"] in still or run.series.endswith("-temperature"))
        found = truth({**given, "stationary": stationary, "current_correlation": 0.0}, 1e-12)(run)
        if run.series.endswith("-temperature"):
            current = found["energy_current"].mean
            found["energy_current"] = quantity(run, "energy_current", current, 1e-4 * abs(current))
        return found

    data = Known({"fig08": conductivities, "ext09": conductivities, "ext11": fill})
    found, *last = FUNCTIONS["C24"](data).alternative
    expected = [last_two("ext09", [1024, 2048], f"{gas}-large", data) for gas in ("dilute", "dense")]
    check(last, *np.array(expected).T)
    current = [of("ext11", f"dense-temperature_cells={size}", "energy_current", data)[1] for size in sizes]
    force = 1 / (1000 / 9) - 1 / 90
    errors = np.array(current) * sizes / abs(force) / 1e4  # of L_uu/T^2
    values = np.array([kappa_0[size] for size in sizes])
    value, error, _ = power(sizes, values, errors)
    halves = [power(sizes[part], values[part], errors[part])[0] for part in (slice(3), slice(2, 4))]
    bound = max(abs(half - value) for half in halves)
    assert bound > 0.05
    assert (found.value, found.systematic) == pytest.approx((value, bound), abs=2e-3)  # weights are drawn
    assert found.error == pytest.approx(error, rel=0.05)
    assert found.freedom == 47
    for few in (1, 2):
        data = Known({"fig08": conductivities, "ext11": partial(fill, still=sizes[:few])})
        assert len(FUNCTIONS["C24"](data).alternative) == few - 1
    with pytest.raises(MissingError):
        FUNCTIONS["C24"](Known({"fig08": truth({"kappa": 1, "stationary": 0}, 0.1)}))
