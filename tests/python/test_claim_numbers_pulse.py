"""The numbers that claims are judged by, as in test_claim_numbers.py: the pulse and the sound of closed chains."""

import math

import numpy as np
import pytest

from tests.python.known_results import Fill, Known, axes, check, freedom, of, quantity, truth, uneven
from tests.python.test_claim_verdicts import damped
from workflow.claims.data import MissingError
from workflow.claims.judge import FUNCTIONS
from workflow.lib.load import Quantity, Result
from workflow.lib.plan import Run


def pulse(apart: bool) -> Fill:
    """Peaks that are lost at the first time and at the last. In their exponents the two starts are
    a little more than two errors apart, or a little less. The damping is the larger, the later it is fitted."""

    def fill(run: Run) -> dict[str, Quantity]:
        found, other = uneven(run), run.name == "rest"
        time = found["peak"].axes["time"]
        place = 300 * time ** (1.1 + other * (0.08 if apart else 0.05))
        place[[0, -1]] = math.nan
        damping = np.array(0.6 + other * (0.065 if apart else 0.05))
        later = damping + 0.002 * np.arange(len(time) - 1)
        return found | {
            "peak_position": quantity(run, "peak_position", place, 0.01 * place),
            "damping_exponent": quantity(run, "damping_exponent", damping, np.array(0.02)),
            "damping_exponent_from": quantity(run, "damping_exponent_from", later, 0.01 * later),
        }

    return fill


def pulses(apart: bool) -> Known:
    return Known(dict.fromkeys(("fig09a", "fig09b", "ext14"), pulse(apart)) | {"ext03": uneven})


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


def path(time: np.ndarray) -> np.ndarray:
    """Exponents of 0.9 between the first two times, of 1 until the last but one, and of 1.3 at last."""
    exponents = np.array([0.9, *np.ones(len(time) - 3), 1.3])
    return 300 * np.exp(np.concatenate([[0], np.cumsum(exponents * np.diff(np.log(time)))]))


@pytest.mark.parametrize("lost", [False, True])
def test_way_of_the_peak(lost: bool) -> None:
    """In the paper's ring from rest and in the long one; without the last time, if its peak is lost."""

    def fill(run: Run) -> dict[str, Quantity]:
        place = path(axes(run)["time"])
        if run.program == "energy_pulse" and run.name == "gaussian":
            place = place**2
        if lost:
            place[-1] = math.nan
        return uneven(run) | {"peak_position": quantity(run, "peak_position", place, 0.01 * place)}

    data = Known(dict.fromkeys(("fig09b", "ext14"), fill))
    evidence = FUNCTIONS["C26"](data)
    for panel, run, numbers in (("fig09b", "rest", evidence.literal), ("ext14", "long", evidence.intended)):
        place = data.one(panel, run)["peak_position"]
        seen = slice(None, -1 if lost else None)
        x, y = np.log(place.axes["time"][seen]), np.log(place.mean[seen])
        slopes = [(y[j] - y[i]) / (x[j] - x[i]) for i, j in ((0, -1), (1, -1), (0, -2))]
        error = 0.01 * math.sqrt(2) / (x[-1] - x[0])
        check(numbers, slopes[0], error, max(abs(one - slopes[0]) for one in slopes), freedom(panel, run))


def test_too_short_a_way() -> None:
    """Two positions have an exponent and no bound of its error."""

    def fill(run: Run) -> dict[str, Quantity]:
        place = uneven(run)["peak_position"]
        place.mean[2:] = math.nan
        return {"peak_position": place, "peak_speed": uneven(run)["peak_speed"]}

    with pytest.raises(MissingError, match="too few times"):
        FUNCTIONS["C26"](Known({"fig09b": fill, "ext14": uneven}))


def test_slowing_of_the_peaks() -> None:
    """Between the first speed and the last of those that are known, from the paper's start, and with a weak pulse. Mutants: the first
    two; a ratio of speeds without that of the times."""

    def fill(run: Run) -> dict[str, Quantity]:
        middle = axes(run)["middle"]
        speed = 300 * middle ** (-0.4 if run.name == "weak" else -0.1)
        speed[2] *= 2
        speed[0] = math.nan
        return uneven(run) | {"peak_speed": quantity(run, "peak_speed", speed, 0.01 * speed)}

    data = Known(dict.fromkeys(("fig09a", "ext14"), fill))
    evidence = FUNCTIONS["C35"](data)
    for panel, run, numbers, value in (
        ("fig09a", "rest", evidence.literal, -0.1),
        ("ext14", "weak", evidence.alternative, -0.4),
    ):
        middle = data.one(panel, run)["peak_speed"].axes["middle"]
        check(numbers, value, 0.01 * math.sqrt(2) / math.log(middle[-1] / middle[1]), 0, freedom(panel, run))
    with pytest.raises(MissingError, match="too few times"):
        FUNCTIONS["C35"](Known({"fig09a": one_speed, "ext14": fill}))


def one_speed(run: Run) -> dict[str, Quantity]:
    speed = uneven(run)["peak_speed"]
    speed.mean[1:] = math.nan
    return {"peak_speed": speed}


def damping(data: Known, panel: str, apart: bool) -> tuple[float, float, float]:
    result, rest = (data.one(panel, run) for run in ("gaussian", "rest"))
    value = float(result["damping_exponent"].mean)
    later = result["damping_exponent_from"].mean
    others = [*later[1 : 5 if panel == "fig09a" else 4], *[rest["damping_exponent"].mean] * apart]
    return value, 0.02, max(abs(other - value) for other in others)


@pytest.mark.parametrize("apart", [False, True])
def test_damping(apart: bool) -> None:
    """Every octave of the paper's pulse, with the bias of the peak's fit; all times of the weak pulse and of the longest record of sound,
    with the fits from the first half of the times on, but not the first, which is the exponent itself."""
    data = pulses(apart)
    evidence = FUNCTIONS["C27"](data)
    value, error = of("fig09a", "rest", "local_damping_exponent", data)
    assert len(value) == 4
    check(evidence.literal, value, error, 0.02, freedom("fig09a", "rest"))
    longest = max(data.of("ext03", "correlation"), key=lambda one: one["peak"].axes["time"][-1])
    weak = data.one("ext14", "weak")
    for numbers, result in ((evidence.intended, weak), (evidence.alternative, longest)):
        found, later = result["damping_exponent"], result["damping_exponent_from"].mean
        bound = max(abs(later[1 : len(later) // 2 + 1] - found.mean))
        check(numbers, found.mean, found.error, bound, result.parameters["replicas"] - 1)
    check(FUNCTIONS["C28"](data).literal, *damping(data, "fig09b", apart), freedom=511)
    assert not FUNCTIONS["C27"](Known({name: data.fills[name] for name in ("fig09a", "ext14")})).alternative


def one_fit_off(k: int) -> Fill:
    """Only the fit from the k-th time on differs from the exponent."""

    def fill(run: Run) -> dict[str, Quantity]:
        later = np.full(len(uneven(run)["damping_exponent_from"].mean), 0.6)
        later[k : k + 1] += 0.2
        return uneven(run) | {
            "damping_exponent": quantity(run, "damping_exponent", np.array(0.6), np.array(0.02)),
            "damping_exponent_from": quantity(run, "damping_exponent_from", later, 0.01 * later),
        }

    return fill


def test_which_fits_bound_the_damping() -> None:
    """Fits up to half of the times, without the first, which is the exponent itself."""
    for k in range(6):
        data = Known(dict.fromkeys(("fig09a", "fig09b", "ext14"), one_fit_off(k)))
        (weak,), (rare,) = FUNCTIONS["C27"](data).intended, FUNCTIONS["C28"](data).literal
        assert weak.systematic == pytest.approx(0.2 * (k in range(1, 5)))
        assert rare.systematic == pytest.approx(0.2 * (k in range(1, 4)))


@pytest.mark.parametrize(
    ("drift", "begin"),
    [
        (0.02, "A power of t describes"),
        (-0.05, "No power of t describes"),
        (math.nan, "A power of t describes"),
    ],
)
def test_whether_a_power_describes_the_height_is_stated(drift: float, begin: str) -> None:
    def caveat(**given: float) -> str:
        rest = truth(damped("fig09b", 1)["fig09b"] | given, 0.001)

        def fill(run: Run) -> dict[str, Quantity]:
            return {
                **rest(run),
                "damping_drift": quantity(run, "damping_drift", np.array(drift), np.array(0.01)),
            }

        return FUNCTIONS["C28"](Known({"fig09b": fill})).caveat

    assert caveat().startswith(f"{begin} the height: its exponent ")
    assert ("over too few octaves" in caveat()) == math.isnan(drift)
    assert "as the ring has closed" in caveat(energy_difference=1)


@pytest.mark.parametrize("known", [0, 1, 2, 5])
def test_speeds_that_are_stated(known: int) -> None:
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
