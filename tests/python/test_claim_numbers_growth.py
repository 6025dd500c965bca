"""The numbers that claims are judged by, as in test_claim_numbers.py: pulses, and conductivity against size."""

import math
import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from tests.python.claim_numbers import DATA, check, of, power
from tests.python.known_results import Fill, Known, axes, quantity, truth, uneven
from workflow.claims.data import MissingError
from workflow.claims.judge import FUNCTIONS
from workflow.figures import ext03
from workflow.lib.load import Quantity, Result
from workflow.lib.plan import Run


def pulse(apart: bool, odd: int = 2) -> Fill:
    """Peaks that are lost at the first time and at the last, off a power of time at one other. In their exponents the two starts are
    a little more than two errors apart, or a little less. The damping is the larger, the later it is fitted."""

    def fill(run: Run) -> dict[str, Quantity]:
        found, other = uneven(run), run.name == "rest"
        time = found["peak"].axes["time"]
        place = 300 * time ** (1.1 + other * (0.04 if apart else 0.03))
        place[odd] *= 1.02
        place[[0, -1]] = math.nan
        damping = np.array(0.6 + other * (0.065 if apart else 0.05))
        later = damping + 0.002 * np.arange(len(time) - 1)
        return found | {
            "peak_position": quantity(run, "peak_position", place, 0.01 * place),
            "damping_exponent": quantity(run, "damping_exponent", damping, np.array(0.02)),
            "damping_exponent_from": quantity(run, "damping_exponent_from", later, 0.01 * later),
        }

    return fill


def sound(damping: float, background: float) -> Fill:
    """Gaussian peaks that move and widen, and fall by a power of time above a background that falls more slowly."""

    def fill(run: Run) -> dict[str, Quantity]:
        time, cell = (axes(run)[name] for name in ("time", "cell"))
        height, beside = 1e4 * time**-damping, background * time**-0.3
        distance = np.abs(cell - len(cell) // 2) - 310 * time[:, np.newaxis]
        width = 40 * time[:, np.newaxis] ** (2 / 3)
        profile = beside[:, np.newaxis] + height[:, np.newaxis] * np.exp(-((distance / width) ** 2))
        given = {"peak": height + beside, "peak_position": 310 * time, "momentum_correlation": profile}
        return uneven(run) | {
            name: quantity(run, name, value, 0.01 * np.abs(value)) for name, value in given.items()
        }

    return fill


def pulses(apart: bool, odd: int = 2) -> Known:
    return Known(
        dict.fromkeys(("fig09a", "fig09b"), pulse(apart, odd)) | {"ext03": sound(0.7, background=-500)}
    )


def test_damping_above_a_background() -> None:
    """The law is that of the peak above it, not that of its height."""
    result = Known({"ext03": sound(0.7, background=-500)}).one("ext03", "long")
    assert ext03.damping(result, above=True).exponent == pytest.approx(-0.7, abs=2e-3)
    assert abs(ext03.damping(result).exponent + 0.7) > 0.01
    lost = result["peak"].mean
    lost[1:] = math.nan
    assert math.isnan(ext03.damping(result, above=True).exponent)


def test_pulse_leaves() -> None:
    data = pulses(False)
    result: Result = data.one("fig09a", "gaussian")
    known = range(1, len(result["peak"].mean) - 1)
    nearest = [round(float(result["peak_position"].mean[k])) - 1 for k in known]  # distances count from 1
    assert len(set(nearest)) > 4
    values, errors = (
        [array[k, place] / result["peak"].mean[k] for k, place in zip(known, nearest, strict=True)]
        for array in (result["odd_part"].mean, result["odd_part"].error)
    )
    share, error = result["centre_share"].mean[-1], result["centre_share"].error[-1]
    check(FUNCTIONS["C25"](data).literal, [share, *values], [error, *errors], freedom=511)


@pytest.mark.parametrize("apart", [False, True])
@pytest.mark.parametrize(
    "odd", [2, 3, -3]
)  # the first but one, the first but two, the last but one of those known
def test_way_of_the_peak(apart: bool, odd: int) -> None:
    data = pulses(apart, odd)
    evidence = FUNCTIONS["C26"](data)

    def slope(run: str, first: int, last: int) -> float:
        place = data.one("fig09b", run)["peak_position"]
        x, y = np.log(place.axes["time"][1:-1]), np.log(place.mean[1:-1])
        return float((y[last] - y[first]) / (x[last] - x[first]))

    found, rest = slope("gaussian", 0, -1), slope("rest", 0, -1)
    others = [slope("gaussian", *ends) for ends in ((1, -1), (2, -1), (0, -2))] + [rest] * apart
    error = 0.01 * math.sqrt(2) / math.log(0.04 / 0.0125)
    assert (abs(rest - found) > 2 * math.sqrt(2) * error) == apart
    for numbers in (evidence.literal, evidence.substance):
        check(numbers, found, error, max(abs(other - found) for other in others), 511)


def test_too_short_a_way() -> None:
    def fill(run: Run) -> dict[str, Quantity]:
        place = uneven(run)["peak_position"]
        place.mean[3:] = math.nan
        return {"peak_position": place}

    with pytest.raises(MissingError):
        FUNCTIONS["C26"](Known({"fig09b": fill}))


def damping(data: Known, panel: str, apart: bool) -> tuple[float, float, float]:
    result, rest = (data.one(panel, run) for run in ("gaussian", "rest"))
    value = float(result["damping_exponent"].mean)
    later = result["damping_exponent_from"].mean
    others = [*later[1 : 5 if panel == "fig09a" else 4], *[rest["damping_exponent"].mean] * apart]
    return value, 0.02, max(abs(other - value) for other in others)


@pytest.mark.parametrize("apart", [False, True])
def test_damping(apart: bool) -> None:
    data = pulses(apart)
    evidence = FUNCTIONS["C27"](data)
    for numbers in (evidence.literal, evidence.substance):
        check(numbers, *damping(data, "fig09a", apart), freedom=511)
    check(FUNCTIONS["C28"](data).literal, *damping(data, "fig09b", apart), freedom=511)
    value, error = of("ext03", "long", "damping_exponent", data)
    later, _ = of("ext03", "long", "damping_exponent_from", data)
    others = [*later[1 : len(later) // 2 + 1], -ext03.damping(data.one("ext03", "long"), above=True).exponent]
    check(evidence.other, value, error, max(abs(other - value) for other in others), 95)


def one_fit_off(k: int) -> Fill:
    """Only what is fitted from the k-th time on differs from the exponent."""

    def fill(run: Run) -> dict[str, Quantity]:
        later = np.full(len(uneven(run)["damping_exponent_from"].mean), 0.6)
        later[k] += 0.2
        found = sound(0.6, background=0)(run) if run.program == "correlation" else uneven(run)
        return found | {
            "damping_exponent": quantity(run, "damping_exponent", np.array(0.6), np.array(0.02)),
            "damping_exponent_from": quantity(run, "damping_exponent_from", later, 0.01 * later),
        }

    return fill


def test_which_fits_bound_the_damping() -> None:
    """Up to the half of the times, but never the first, which is the exponent itself."""
    half = len(DATA.one("ext03", "long")["damping_exponent_from"].mean) // 2
    bounds = {"C27": (range(1, 5), range(1, half + 1)), "C28": (range(1, 4), None)}
    for k in range(half + 2):
        data = Known(dict.fromkeys(("fig09a", "fig09b", "ext03"), one_fit_off(k)))
        for claim, (of_pulse, of_sound) in bounds.items():
            evidence = FUNCTIONS[claim](data)
            assert [one.systematic for one in evidence.literal] == pytest.approx([0.2 * (k in of_pulse)])
            if of_sound:
                (found,) = evidence.other
                assert found.systematic == pytest.approx(0.2 * (k in of_sound), abs=2e-3)


@pytest.mark.parametrize("known", [0, 1, 2, 5])
def test_speeds_that_are_told(known: int) -> None:
    """The first and the last of those at which there is a moving peak."""

    def fill(run: Run) -> dict[str, Quantity]:
        speed = np.full(len(uneven(run)["peak_speed"].mean), math.nan)
        speed[2 : 2 + known] = 500 - np.arange(known)
        return uneven(run) | {"peak_speed": quantity(run, "peak_speed", speed, 0.1 * np.ones(len(speed)))}

    data = Known({"fig09a": fill})
    middle = data.one("fig09a", "gaussian")["peak_speed"].axes["middle"]
    ends = [f"{500 - k}.00(10) at t = {middle[2 + k]:.3g}" for k in (0, known - 1)]
    expected = f"Speed of the peaks: {', '.join(ends)}." if known else "No moving peak was found."
    assert FUNCTIONS["C25"](data).caveat == expected


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
    return found | kappas | {"stationary": stationary}


SOME = Known(dict.fromkeys(("fig08", "fig09a", "fig09b", "ext09"), conductivities))


def kappa(
    panel: str, sizes: Sequence[int], *series: str, data: Known = SOME, name: str = "kappa"
) -> tuple[list[int], np.ndarray, np.ndarray]:
    """By size, of the series that has it."""
    names = {run.options["cells"]: run.name for run in SOME.plan[panel].runs if run.series in series}
    mean, error = np.array([of(panel, names[size], name, data) for size in sizes]).T
    return [*sizes], mean, error


def last_two(panel: str, sizes: Sequence[int], series: str, data: Known) -> tuple[float, float, float]:
    """Exponent between two sizes; that by the temperatures of the particles bounds the systematic error."""
    kinds = ("kappa", "kappa_particle")
    found, other = (power(*kappa(panel, sizes, series, data=data, name=name)) for name in kinds)
    assert abs(other[0] - found[0]) > 1e-3
    return found[0], found[1], abs(other[0] - found[0])


@pytest.mark.parametrize("odd", [128, 1024])  # so that the one or the other half is the farther off
def test_conductivity(odd: int) -> None:
    """At gamma = 1 from a sixteenth of the largest size on; at gamma = N both halves from 16 on, and between the two largest."""
    data = Known(dict.fromkeys(("fig08", "ext09"), partial(conductivities, odd=odd)))
    kappas = partial(kappa, data=data)
    rare = power(*kappas("fig08", [128, 256, 512, 1024, 2048], "rare"))
    check(FUNCTIONS["C23"](data).literal, *rare, 127)

    evidence = FUNCTIONS["C24"](data)
    sizes = [16, 32, 128, 256, 512, 1024]
    parts = [power(*kappas("fig08", part, "deterministic", "large")) for part in (sizes[:4], sizes[3:])]
    check(evidence.literal, *np.array(parts).T)
    assert [one.freedom for one in evidence.literal] == [383, 95]
    last = [
        last_two("fig08", [512, 1024], "large", data),
        last_two("ext09", [1024, 2048], "thinning-large", data),
    ]
    check(evidence.substance, *np.array(last).T)
    assert [one.freedom for one in evidence.substance] == [95, 63]


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
                "stationary": quantity(run, "stationary", np.array(1.0), None),
            }

        caveat = FUNCTIONS["C24"](Known({"fig08": conductivities, "ext09": fill})).caveat
        law = r"χ² = ([\d.]+) for 3, [^;]*?at spacing ([\d.]+), N = 128 to 2048"
        return {
            spacing: float(found) for found, spacing in re.findall(law, caveat.partition("finite limit")[2])
        }

    assert told(True) == {"0.1": 0.0, "0.025": 0.0}
    size = 2.0 ** np.arange(7, 12)
    kappa = 20 + 50 * np.cbrt(size)
    _, (left_over,), *_ = np.linalg.lstsq(
        np.stack([np.ones(5), 1 / np.cbrt(size)], axis=1) / (0.01 * kappa)[:, None], np.full(5, 100.0)
    )
    assert left_over > 50
    assert told(False) == pytest.approx({"0.1": left_over, "0.025": left_over}, abs=0.05)


@pytest.mark.parametrize("few", [1, 2])
def test_an_exponent_takes_two_sizes(few: int) -> None:
    """Of ext. 9 that are stationary."""

    def fill(run: Run) -> dict[str, Quantity]:
        still = run.series.startswith("thinning") and run.options["cells"] in (16, 32)[:few]
        return uneven(run) | {"stationary": quantity(run, "stationary", np.array(float(still)), None)}

    substance = FUNCTIONS["C24"](Known({"fig08": conductivities, "ext09": fill})).substance
    assert len(substance) == few


@pytest.mark.parametrize(
    ("number", "claim", "sizes", "series", "freedom"),
    [
        (0, "C27", [128, 256, 512, 1024], ["deterministic", "large"], 95),
        (1, "C28", [128, 256, 512, 1024, 2048], ["rare"], 127),
    ],
)
def test_relation_of_pulse_and_conductivity(
    number: int, claim: str, sizes: list[int], series: list[str], freedom: float
) -> None:
    exponent, error, bound = power(*kappa("fig08", sizes, *series))
    (peak,) = FUNCTIONS[claim](SOME).literal
    slope = 1 / peak.value**2
    found = FUNCTIONS["C30"](SOME).literal[number]
    expected = 2 - 1 / peak.value - exponent
    error = math.hypot(slope * peak.error, error)
    check([found], expected, error, slope * peak.systematic + bound, freedom)


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
    found, *last = FUNCTIONS["C24"](data).other
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
        assert len(FUNCTIONS["C24"](data).other) == few - 1
    with pytest.raises(MissingError):
        FUNCTIONS["C24"](Known({"fig08": truth({"kappa": 1, "stationary": 0}, 0.1)}))
