"""The numbers that claims are judged by, as in test_claim_numbers.py: the pulse and the sound of closed chains."""

import math

import numpy as np
import pytest

from tests.python.claim_numbers import DATA, check, freedom, of
from tests.python.known_results import Fill, Known, axes, quantity, truth, uneven
from tests.python.known_worlds import damped
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
        place = 300 * time ** (1.1 + other * (0.08 if apart else 0.05))
        place[odd] *= 1 if other else 1.02
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
    error, error_of_rest = (0.01 * math.sqrt(2) / math.log(last / 0.0125) for last in (0.032, 0.02))
    assert (abs(rest - found) > 2 * math.hypot(error, error_of_rest)) == apart
    for numbers in (evidence.literal, evidence.intended):
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
    for numbers in (evidence.literal, evidence.intended):
        check(numbers, *damping(data, "fig09a", apart), freedom=511)
    check(FUNCTIONS["C28"](data).literal, *damping(data, "fig09b", apart), freedom=511)
    value, error = of("ext03", "long", "damping_exponent", data)
    later, _ = of("ext03", "long", "damping_exponent_from", data)
    others = [*later[1 : len(later) // 2 + 1], -ext03.damping(data.one("ext03", "long"), above=True).exponent]
    check(
        evidence.alternative,
        value,
        error,
        max(abs(other - value) for other in others),
        freedom("ext03", "long"),
    )


def one_fit_off(k: int) -> Fill:
    """Only what is fitted from the k-th time on differs from the exponent."""

    def fill(run: Run) -> dict[str, Quantity]:
        later = np.full(len(uneven(run)["damping_exponent_from"].mean), 0.6)
        later[k : k + 1] += 0.2
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
                (found,) = evidence.alternative
                above = ext03.damping(data.one("ext03", "long"), above=True).exponent
                assert found.systematic == pytest.approx(max(0.2 * (k in of_sound), abs(0.6 + above)))


@pytest.mark.parametrize(
    ("drift", "told"),
    [
        (0.02, "A power of t describes"),
        (-0.05, "No power of t describes"),
        (math.nan, "A power of t describes"),
    ],
)
def test_whether_a_power_describes_the_height_is_told(drift: float, told: str) -> None:
    def said(**given: float) -> str:
        rest = truth(damped("fig09b", 1)["fig09b"] | given, 0.001)

        def fill(run: Run) -> dict[str, Quantity]:
            return {
                **rest(run),
                "damping_drift": quantity(run, "damping_drift", np.array(drift), np.array(0.01)),
            }

        return FUNCTIONS["C28"](Known({"fig09b": fill})).caveat

    assert said().startswith(f"{told} the height: its exponent ")
    assert ("over too few octaves" in said()) == math.isnan(drift)
    assert "as the ring has closed" in said(energy_difference=1)


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
