"""The numbers that claims are judged by, from results in which no two values are alike: each is taken from the right run,
quantity and element, with its error. Filling chains and closed chains."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.python.known_results import (
    DATA,
    Known,
    check,
    each,
    freedom,
    of,
    quantity,
    relative_change,
    uneven,
)
from workflow.claims.data import ratio
from workflow.claims.judge import FUNCTIONS
from workflow.claims.verdict import Number
from workflow.lib.caption import scientific
from workflow.lib.load import Quantity
from workflow.lib.plan import Run


def test_filling_chain() -> None:
    plateau, error = of("fig01", "unit-chain", "plateau")
    evidence = FUNCTIONS["C01"](DATA)
    check(evidence.literal, *relative_change(plateau[:-1], plateau[1:], error[:-1], error[1:]), freedom=63)
    ends = [np.array(of("fig01", run, "plateau"))[:, [0, -1]] for run in ("paper", "short")]
    (first, last), errors = (np.array([one[row] for one in ends]).T for row in (0, 1))
    check(evidence.alternative, *relative_change(first, last, *errors))

    (slope, slope_error), (curvature, curvature_error) = (
        of("fig01", "unit-chain", f"log_{name}") for name in ("slope", "curvature")
    )
    bent, bent_error = relative_change(slope, curvature, slope_error, curvature_error)
    agreement = relative_change(plateau[-1], slope, error[-1], slope_error)
    evidence = FUNCTIONS["C02"](DATA)
    check(evidence.literal, [bent + 1, agreement[0]], [bent_error, agreement[1]], freedom=63)
    rise = np.array(relative_change(plateau[0], plateau[-1], error[0], error[-1]))
    check(evidence.intended, *(rise / math.log(9))[:, None])

    evidence = FUNCTIONS["C03"](DATA)
    check(evidence.literal, *of("fig01", "unit-chain", "front_exponent"), freedom=63)
    check(evidence.intended, *each("fig01", "front_exponent", "paper", "short"))


def test_misfits_of_the_front() -> None:
    """Exactly 1/ln t, the same relative error everywhere: chi^2 of 1/t is the variance of t/ln t over its mean square."""

    def fill(run: Run) -> dict[str, Quantity]:
        time = uneven(run)["front"].axes["time"]
        return uneven(run) | {"front": quantity(run, "front", 7 / np.log(time), 0.01 * 7 / np.log(time))}

    time = np.array([200, 600, 1000, 1400, 1800])
    scaled = np.log(time) / time
    expected = 1e4 * (5 - scaled.sum() ** 2 / np.sum(scaled**2))
    caveat = FUNCTIONS["C03"](Known({"fig01": fill})).caveat
    assert f"{expected:.0f} and 0 at λ = 1/N" in caveat


def test_persistence() -> None:
    evidence = FUNCTIONS["C15"](DATA)
    for numbers, series in ((evidence.intended, "dense"), (evidence.alternative, "paper")):
        runs = [run for run in DATA.plan["fig05"].runs if run.series == series]
        mean, error = each("fig05", "mu", *(run.name for run in runs))
        check(
            numbers,
            mean - [math.acos(run.options["sigma"]) / math.pi for run in runs],
            error,
            0,
            runs[0].options["replicas"] - 1,
        )
    mean, error = each("fig05", "mu", *(f"paper_sigma={sigma}" for sigma in (-1, 0, 1)))
    check(evidence.literal, mean - [1, 0.5, 0], error, freedom=1023)


def test_waiting_times() -> None:
    """The shortest relaxation, whose exponent is far off, does not count."""

    def fill(run: Run) -> dict[str, Quantity]:
        short = run.options["relaxation-time"] == 1
        return {"exponent": quantity(run, "exponent", np.array(9.0), np.array(0.1))} if short else uneven(run)

    data = Known({"fig06": uneven, "ext07": fill})
    for claim, sigma, aged in (("C16", 0.5, [10, 100, 1000]), ("C17", 0, [])):
        value, error = of("fig06", f"all_sigma={sigma}", "exponent")
        spread, _ = of("fig06", f"all_sigma={sigma}", "exponent_spread")
        others = [of("ext07", f"waiting_relaxation-time={time}", "exponent")[0] for time in aged]
        bound = spread + max([abs(other - value) for other in others], default=0)
        check(FUNCTIONS[claim](data).literal, value, error, bound, 8191)


def ext01(sigma: float, zero: bool) -> list[str]:
    name = f"paper_sigma={sigma}_zero-total-momentum={zero}"
    return [f"{name}_relaxation-time={time}" for time in (10, 1000)]


@pytest.mark.parametrize(
    ("claim", "panel", "run", "sigma", "others"),
    [
        ("C18", "fig07", "all", 0.5, [*ext01(0.5, True), "dense_sigma=0.5"]),
        ("C19", "fig07_inset", "all_sigma=0", 0, ["dense-drift"]),
    ],
)
def test_spreading(claim: str, panel: str, run: str, sigma: float, others: list[str]) -> None:
    evidence = FUNCTIONS[claim](DATA)
    value, error = of(panel, run, "alpha")
    relaxed, _ = each("ext01", "alpha", *ext01(sigma, False))
    freedom = DATA.plan[panel].run(run).options["replicas"] - 1
    check(evidence.literal, value, error, abs(relaxed - value).max(), freedom)
    check(evidence.alternative, *each("ext01", "alpha", *others))
    if claim == "C18":  # of two contents and relaxation times, which their labels state
        labels = {number.label.rpartition(", n = ")[2] for number in evidence.alternative}
        assert labels == {"20, t_r = 10", "20, t_r = 1000", "80, t_r = 10"}


def test_exponents_and_drifts_of_every_sigma_but_0() -> None:
    runs = [run.name for run in DATA.plan["fig07_inset"].runs if run.options["sigma"] != 0]
    free, zero = ([run for run in runs if run.startswith(series)] for series in ("all", "zero-momentum"))
    evidence = FUNCTIONS["C20"](DATA)
    assert len(free) == len(zero) == 12
    check(evidence.literal, *each("fig07_inset", "alpha", *free), freedom=511)
    check(evidence.intended, *each("fig07_inset", "alpha", *zero), freedom=511)

    drift, error = each("fig07_inset", "momentum_drift", *runs)
    evidence = FUNCTIONS["C22"](DATA)
    check(evidence.literal, np.log10(drift), error / drift / np.log(10), freedom=511)
    assert f"The largest change is {scientific(drift.max())}," in evidence.caveat

    evidence = FUNCTIONS["C21"](DATA)
    for numbers in (evidence.literal, evidence.intended):
        check(
            numbers,
            *each(
                "ext01",
                "alpha",
                *(run.name for run in DATA.plan["ext01"].runs if run.series.startswith("random")),
            ),
        )


@pytest.mark.parametrize(("quality", "run", "first"), [("deep", "long", 0), ("standard", "energy", 2)])
def test_ageing(quality: str, run: str, first: int) -> None:
    """Of the longest run of the paper's chain the last decade over the first from t = 1 on, which of the long one is the first of all;
    the chain of few particles is as long, and not always made."""
    data = Known({"ext07": uneven}, quality)
    panel = data.plan["ext07"]
    data.plan = data.plan | {"ext07": replace(panel, runs=panel.runs[::-1])}  # no result depends on the order
    slope, error = of("ext07", run, "decade_slope", data)
    evidence = FUNCTIONS["C29"](data)
    check(
        evidence.literal,
        *relative_change(slope[first], slope[-1], error[first], error[-1]),
        freedom=freedom("ext07", run, data),
    )
    largest = slope.argmax()
    value, spread = relative_change(slope[largest], slope[-1], error[largest], error[-1])
    check(evidence.alternative, value + 1, spread)
    if quality == "standard":
        assert not evidence.intended
        return
    slope, error = of("ext07", "few", "decade_slope", data)
    largest = slope.argmax()
    value, spread = relative_change(slope[largest], slope[-1], error[largest], error[-1])
    check(evidence.intended, value + 1, spread, freedom=freedom("ext07", "few", data))


def test_a_decade_from_1_on_counts_though_rounding_puts_it_below() -> None:
    def fill(run: Run) -> dict[str, Quantity]:
        slope = uneven(run)["decade_slope"]
        return {"decade_slope": replace(slope, axes={"decade": (1 - 1e-15) * slope.axes["decade"]})}

    (found,), (exact,) = (FUNCTIONS["C29"](Known({"ext07": each})).literal for each in (fill, uneven))
    assert found.value == exact.value


def test_ratios_also_of_a_number_that_vanishes() -> None:
    """Mutant: a relative error, which has no meaning there."""
    found = ratio(Number("", 0.0, 0.3, 5, 0.1), Number("", 2.0, 0.5, 4, 0.2), "")
    check([found], 0, 0.15, 0.05, 4)
    found = ratio(Number("", 4.0, 0.3, 7, 0.1), Number("", -2.0, 0.2, 9, 0.2), "")
    check([found], -2, 0.25, 0.25, 7)
