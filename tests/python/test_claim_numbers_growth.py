"""The numbers that claims are judged by, as in test_claim_numbers.py: conductivity against size."""

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from tests.python.known_results import Known, check, freedom, of, power, quantity, truth, uneven
from tests.python.test_claim_verdicts import drop_per_cell, linear_response
from workflow.claims.data import MissingError
from workflow.claims.growth import equilibrium
from workflow.claims.judge import FUNCTIONS
from workflow.claims.pulse import damping_exponent
from workflow.lib.fit import with_error
from workflow.lib.load import Quantity
from workflow.lib.plan import Run


def conductivities(run: Run, odd: int = 0) -> dict[str, Quantity]:
    """kappa is about N, three times that at the size odd, and 1000 times where the run is not stationary: N = 64 and the largest of fig. 8."""
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
    """Energy current for kappa at the temperatures of the baths."""
    return quantity(run, "energy_current", kappa * drop_per_cell(run), np.array(0.01))


SOME = Known(dict.fromkeys(("fig08", "fig09a", "fig09b", "ext09", "ext13"), conductivities))


def kappa(
    panel: str, sizes: Sequence[int], *series: str, data: Known = SOME, name: str = "kappa"
) -> tuple[list[int], np.ndarray, np.ndarray]:
    """Sizes, kappa and its errors."""
    names = {run.options["cells"]: run.name for run in SOME.plan[panel].runs if run.series in series}
    mean, error = np.array([of(panel, names[size], name, data) for size in sizes]).T
    return [*sizes], mean, error


def last_two(
    panel: str, sizes: Sequence[int], series: Sequence[str], data: Known
) -> tuple[float, float, float]:
    """Exponent between two sizes; those by the temperatures of the particles and of the baths bound the systematic error."""
    kinds = ("kappa", "kappa_particle")
    found, other = (power(*kappa(panel, sizes, *series, data=data, name=name)) for name in kinds)
    _, (first, second), _ = kappa(panel, sizes, *series, data=data, name="energy_current")
    by_baths = 1 + math.log(second / first) / math.log(sizes[1] / sizes[0])
    bounds = [abs(one - found[0]) for one in (other[0], by_baths)]
    assert min(bounds) > 1e-3
    return found[0], found[1], max(bounds)


SIZES, MOVING = np.array([16, 32, 64, 128]), 256
KAPPA_0 = dict(zip(SIZES, SIZES**0.3, strict=True)) | {16: 3, MOVING: 1000}


def response(still: Collection[int] = SIZES) -> Callable[[Run], dict[str, Quantity]]:
    """kappa_0 = N^0.3 but at N = 16; only the energy current at a difference of temperature, in which kappa_0 is linear, has an error.
    The largest chain is not stationary."""

    given = linear_response(lambda cells: float(KAPPA_0[cells]))

    def fill(run: Run) -> dict[str, Quantity]:
        stationary = float(run.options["cells"] in still or run.series.endswith("-temperature"))
        found = truth({**given, "stationary": stationary}, 1e-12)(run)
        if run.series.endswith("-temperature"):
            current = found["energy_current"].mean
            found["energy_current"] = quantity(run, "energy_current", current, 1e-4 * abs(current))
        return found

    return fill


@pytest.mark.parametrize("odd", [128, 1024])  # so that the one or the other half is the farther off
def test_conductivity(odd: int) -> None:
    """At gamma = 1 from a sixteenth of the largest size on; at gamma = N both halves from 16 on, and between the two largest, also
    of ext. 9."""
    of_panels = dict.fromkeys(("fig08", "ext09"), partial(conductivities, odd=odd))
    data = Known(of_panels | {"ext11": response(), "ext13": uneven})
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
    expected = [last_two("fig08", [512, 1024], ("deterministic", "large"), data)]
    expected += [last_two("ext09", [256, 512], (gas,), data) for gas in ("thinning", "dilute", "dense")]
    check(evidence.alternative, *np.array(expected).T)
    last = (("fig08", "large"), ("ext09", "thinning"), ("ext09", "dilute"), ("ext09", "dense"))
    assert [one.freedom for one in evidence.alternative] == [freedom(*one) for one in last]


def test_heat_in_equilibrium() -> None:
    """Of every gas the last octave of the longest ring less 1, and how much the octave before differs. Mutants: the first ring of a
    gas; the exponent itself; random directions among the gases."""
    data = Known({"fig08": conductivities, "ext11": response(), "ext13": uneven})
    evidence = FUNCTIONS["C24"](data)
    rings = ("dilute-long", "dense-longest", "light-longest")
    found = {one.label.partition(", t = ")[0]: one for one in evidence.intended[:-1]}
    gases = ("ζ = 0.8, M = 3", "ζ = 1.6, M = 3", "ζ = 0.8, M = 0.33")
    assert len(found) == len(gases)
    for ring, gas in zip(rings, gases, strict=True):
        (*_, before, last), error = of("ext13", ring, "local_exponent", data)
        number = found[f"d ln⟨Q²⟩/d ln t - 1, {gas}"]
        check([number], last - 1, error[-1], abs(last - before), freedom("ext13", ring))
    value, error = of("ext13", "random", "local_exponent", data)
    assert f"1 is {with_error(value[-1] - 1, error[-1])} (ζ = 1.6, M = 3)" in evidence.caveat


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
    """So many sizes of ext. 9 are stationary, besides fig. 8."""

    def fill(run: Run) -> dict[str, Quantity]:
        still = run.series.startswith("thinning") and run.options["cells"] in (16, 32)[:few]
        stationary = quantity(run, "stationary", np.array(float(still)), None)
        return uneven(run) | {"stationary": stationary, "energy_current": current(run, np.array(1.0))}

    found = FUNCTIONS["C24"](
        Known({"fig08": conductivities, "ext09": fill, "ext11": response(), "ext13": uneven})
    )
    assert len(found.alternative) == few


@pytest.mark.parametrize(
    ("k", "panel", "sizes", "series"),
    [
        (0, "fig09a", [128, 256, 512, 1024], ["deterministic", "large"]),
        (1, "fig09b", [128, 256, 512, 1024, 2048], ["rare"]),
    ],
)
def test_relation_of_pulse_and_conductivity(k: int, panel: str, sizes: list[int], series: list[str]) -> None:
    exponent, error, bound = power(*kappa("fig08", sizes, *series))
    peak = damping_exponent(SOME, panel)
    slope = 1 / peak.value**2
    found = FUNCTIONS["C30"](SOME).literal[k]
    expected = 2 - 1 / peak.value - exponent
    error = math.hypot(slope * peak.error, error)
    check([found], expected, error, slope * peak.systematic + bound, freedom("fig08", series[-1]))


def test_relation_of_sound_and_heat_in_equilibrium() -> None:
    """One number for every gas, with the sound of the longest record; none without a record of sound."""
    data = Known({**SOME.fills, "ext03": uneven})
    (sound,) = FUNCTIONS["C27"](Known({**data.fills, "ext14": uneven})).alternative
    heat, slope = equilibrium(data)[0], 1 / sound.value**2
    evidence = FUNCTIONS["C30"](data)
    assert len(heat) == 3
    check(
        evidence.intended,
        [2 - 1 / sound.value - one.value for one in heat],
        [math.hypot(slope * sound.error, one.error) for one in heat],
        [slope * sound.systematic + one.systematic for one in heat],
    )
    assert not FUNCTIONS["C30"](SOME).intended


def test_conductivity_without_a_particle_current() -> None:
    data = Known({"fig08": conductivities, "ext11": response(), "ext13": uneven})
    *_, found = FUNCTIONS["C24"](data).intended
    current = [of("ext11", f"dense-temperature_cells={size}", "energy_current", data)[1] for size in SIZES]
    force = 1 / (1000 / 9) - 1 / 90
    errors = np.array(current) * SIZES / abs(force) / 1e4  # of L_uu/T^2
    values = np.array([KAPPA_0[size] for size in SIZES])
    value, error, _ = power(SIZES, values, errors)
    halves = [power(SIZES[part], values[part], errors[part])[0] for part in (slice(3), slice(2, 4))]
    bound = max(abs(half - value) for half in halves)
    assert bound > 0.05
    assert (found.value, found.systematic) == pytest.approx((value, bound), abs=2e-3)  # weights are drawn
    assert found.error == pytest.approx(error, rel=0.05)
    assert found.freedom == freedom("ext11", "dense-temperature")
    few = Known({"fig08": conductivities, "ext11": response(SIZES[:1]), "ext13": uneven})
    with pytest.raises(MissingError, match="ext11"):
        FUNCTIONS["C24"](few)
    with pytest.raises(MissingError):
        FUNCTIONS["C24"](Known({"fig08": truth({"kappa": 1, "stationary": 0}, 0.1)}))
