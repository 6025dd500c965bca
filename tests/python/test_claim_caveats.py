"""Numbers in the labels and caveats of claims, and claims for which there are too few results."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.python.claim_truths import CASES, finite
from tests.python.known_results import Fill, Known, quantity, truth, uneven
from tests.python.test_claim_numbers import data
from workflow.claims.data import MissingError
from workflow.claims.judge import FUNCTIONS
from workflow.lib.load import Quantity
from workflow.plan import Run


def caveat(name: str) -> str:
    return FUNCTIONS[name](data(CASES[name])).caveat


def with_peaks(name: str, kept: slice) -> Fill:
    """Results with peaks only at the times of the slice: position 10, speeds 500, 499, ..., relative errors of a tenth."""

    def fill(run: Run) -> dict[str, Quantity]:
        values = np.full(len(uneven(run)[name].mean), math.nan)
        values[kept] = 500 - np.arange(len(values[kept]))
        return uneven(run) | {name: quantity(run, name, values, np.full(len(values), 0.1))}

    return fill


def test_misfits_of_the_front() -> None:
    """The front is exactly 1/ln t with constant relative errors. chi^2 of 1/t is then the variance of t/ln t over its mean square."""

    def fill(run: Run) -> dict[str, Quantity]:
        time = uneven(run)["front"].axes["time"]
        return uneven(run) | {"front": quantity(run, "front", 7 / np.log(time), 0.01 * 7 / np.log(time))}

    time = np.array([200, 600, 1000, 1400, 1800])
    scaled = np.log(time) / time
    expected = 1e4 * (5 - scaled.sum() ** 2 / np.sum(scaled**2))
    assert f"{expected:.0f} and 0 at λ = 1/N" in FUNCTIONS["C03"](Known({"fig01": fill})).caveat


def test_numbers_in_caveats() -> None:
    assert "At N = 2 it is 1.25" in caveat("C10")
    assert "At N = 16 it is 1.25" in caveat("C11")
    assert "whose shape it has (χ² = 0.0 for 39" in caveat("C11")
    assert "The largest mean over a bin, as in the panel, is 0.004657(11) (N = 2, p = 1)" in caveat("C10")
    assert "without the smallest N the exponent is −0.900(25)" in caveat("C12")
    assert "at most 6·10⁻¹ at unequal temperatures too" in caveat("C33")
    assert "between 1.420 and 1.460" in caveat("C18")  # all particles, n = 20 and 80
    assert "The largest change is 4.9·10⁻⁵," in caveat("C22")
    assert (
        "d ln⟨Q²⟩/d ln t - 1 is then 0.4800(15) and 0.5000(15) in the last two octaves, to t = 192 (ζ = 1.6, M = 3)"
        in caveat("C24")
    )
    assert (
        "κ is 5.6569(57) at N = 32 and 11.314(11) at N = 128 (λ = 1/N, an exponent of 0.5000(10));"
        in caveat("C24")
    )
    assert (
        "exponent is 0.2000(20) at T_R/T_L = 1.5, N = 1024 to 2048 and 0.1000(20) at T_R/T_L = 4"
        in caveat("C24")
    )
    assert "at t = 256, 512 and 1024. The peak is then 7 to 16 cells wide" in caveat("C30")


def test_what_another_shape_misses_is_a_systematic_error() -> None:
    """The simulation differs from the shape of the mean field by +-0.02 in alternate bins, which is 5e-5 in the printed normalisation."""

    def another(run: Run, place: np.ndarray, p: np.ndarray) -> np.ndarray:
        return finite(run, place, p) + run.replicated * 0.02 * np.where(p % 4 == 1, 1, -1)

    evidence = FUNCTIONS["C11"](Known({"fig03_inset": truth({"flux": another}, 5e-4)}))
    assert "whose shape it has but for" in evidence.caveat
    assert evidence.literal[0].systematic == pytest.approx(5e-5, rel=0.3)


def test_a_decade_from_1_on_counts_though_rounding_puts_it_below() -> None:
    def fill(run: Run) -> dict[str, Quantity]:
        slope = uneven(run)["decade_slope"]
        return {"decade_slope": replace(slope, axes={"decade": (1 - 1e-15) * slope.axes["decade"]})}

    (found,), (exact,) = (FUNCTIONS["C29"](Known({"ext07": each})).literal for each in (fill, uneven))
    assert found.value == exact.value


def test_an_exponent_is_called_a_mean_slope_where_the_law_is_rejected() -> None:
    """In these results kappa ~ N with relative errors of a hundredth; kappa of one size may be three times as large."""

    def label(odd: int) -> str:
        given = {
            "kappa": lambda run: run.options["cells"] * (3.0 if run.options["cells"] == odd else 1),
            "stationary": 1,
        }
        (number,) = FUNCTIONS["C23"](Known({"fig08": truth(given, 0.01)})).literal
        return number.label

    assert "mean slope" not in label(0)
    assert label(512).startswith(f"{label(0)}, a mean slope (χ² = ")


@pytest.mark.parametrize("few", [1, 2])
def test_an_exponent_takes_two_sizes(few: int) -> None:
    """few: number of stationary sizes of ext09; all sizes of fig08 are stationary."""

    def still(run: Run) -> float:
        return float(run.series == "thinning" and run.options["cells"] in (16, 32)[:few])

    case = data(CASES["C24"])
    fills = case.fills | {"ext09": truth(dict(CASES["C24"].world["ext09"]) | {"stationary": still}, 0.01)}
    assert len(FUNCTIONS["C24"](Known(fills)).alternative) == few


def test_what_is_missing_is_stated() -> None:
    one_size = dict(CASES["C24"].world["ext11"]) | {
        "stationary": lambda run: float(run.options["cells"] == 16)
    }
    with pytest.raises(MissingError, match="ext11"):
        FUNCTIONS["C24"](Known(data(CASES["C24"]).fills | {"ext11": truth(one_size, 0.01)}))
    with pytest.raises(MissingError):
        FUNCTIONS["C24"](Known({"fig08": truth(dict(CASES["C24"].world["fig08"]) | {"stationary": 0}, 0.1)}))
    with pytest.raises(MissingError, match="too few times"):
        FUNCTIONS["C26"](Known({"fig09b": with_peaks("peak_position", slice(2)), "ext14": uneven}))
    with pytest.raises(MissingError, match="too few times"):
        FUNCTIONS["C35"](Known({"fig09a": with_peaks("peak_speed", slice(1)), "ext14": uneven}))
