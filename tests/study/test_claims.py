"""The table of claims, its messages, and how a claim is judged."""

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from tests.python.conftest import ROOT
from tests.python.test_release import results_of_release
from tests.study.known_results import known
from workflow.lib.load import FormatError, Result
from workflow.study import judge
from workflow.study.claims import growth
from workflow.study.claims.fluxes import largest_distance
from workflow.study.results import (
    MissingError,
    Results,
    combination,
    estimate,
    exponent_between,
    octaves,
    ratio,
)
from workflow.study.verdict import Band, Estimate, Outcome, Verdict, level_of_each

ROWS = judge.read_claims(ROOT)


def test_every_statement_has_a_row() -> None:
    """Numbers are consecutive, in the order of the figures. A statement as meant comes after the one as
    printed."""
    printed = [row["number"] for row in ROWS if row["kind"] == "as printed"]
    assert printed == [f"C{k:02d}" for k in range(1, len(printed) + 1)]
    for former, row in pairwise(ROWS):
        assert row["panel"][:5] >= former["panel"][:5]
        if row["kind"] == "as meant":
            assert (former["number"], former["kind"]) == (row["number"], "as printed")


@pytest.mark.parametrize(
    "damage",
    [
        lambda text: text.replace("-0.1 to 0.1", "0.1 to -0.1", 1),
        lambda text: text.replace("-1.5 to 1.5", "1.5 to -1.5", 1),
        lambda text: text.replace("front_falls", "front_rises", 1),
        lambda text: text.replace("as meant", "meant", 1),
    ],
)
def test_a_damaged_table_is_reported_in_one_line(tmp_path: Path, damage: Callable[[str], str]) -> None:
    path = tmp_path / judge.CLAIMS_FILE
    path.parent.mkdir(parents=True)
    path.write_text(damage((ROOT / judge.CLAIMS_FILE).read_text()))
    with pytest.raises(FormatError, match=r"study/claims\.csv: "):
        judge.read_claims(tmp_path)


def test_what_was_not_measured_is_undecided() -> None:
    for row in ROWS:
        judgement = judge.judge(row, Results([]), 0.05)
        assert judgement.verdict.outcome is Outcome.UNDECIDED
        assert judgement.missing


def of_sizes(kappa: Callable[[int], float], still: Callable[[int], bool] = lambda _: True) -> Results:
    given = {
        "kappa": lambda run: kappa(run.options["cells"]),
        "stationary": lambda run: float(still(run.options["cells"])),
    }
    return known({"fig08": given}, 0.01)


def test_a_power_law_needs_two_octaves() -> None:
    for sizes in ((64,), (32, 64), (8, 16, 32)):
        with pytest.raises(MissingError, match="two octaves"):
            growth.linear(of_sizes(float, sizes.__contains__))


@pytest.mark.parametrize(
    ("law", "error", "outcome"),
    [
        (lambda n: n ** (1 / 3), 0.003, Outcome.REPRODUCED),
        (lambda n: n ** (1 / 3), 0.1, Outcome.UNDECIDED),
        # The tangent at N = 256 has the exponent 1/3: a fit of all sizes would find it.
        (lambda n: n ** (1 / 3) * np.exp(-0.1 * np.log(n / 256) ** 2), 0.003, Outcome.CONTRADICTED),
        # A bend within the band, however precise.
        (lambda n: n ** (1 / 3) * np.exp(-0.005 * np.log(n / 256) ** 2), 1e-5, Outcome.REPRODUCED),
        (lambda n: n ** (1 / 2), 0.003, Outcome.CONTRADICTED),
    ],
)
def test_which_data_decide_octaves(law: Callable, error: float, outcome: Outcome) -> None:
    values = {n: Estimate("", law(n), error * law(n)) for n in (2**k for k in range(5, 12))}
    numbers = tuple(octaves(values, 32, ""))
    assert Verdict(Band.parse("0.283 to 0.383"), numbers, 0.05 / 38).outcome is outcome


def test_no_result_of_the_release_is_needed_for_a_report_and_fewer_decide_no_more() -> None:
    """Of the results of the release, each of those that a row depends on is removed in turn."""
    loaded = results_of_release()
    level = level_of_each(len(ROWS))
    whole = Recording(loaded)
    for row in ROWS:
        whole.used.clear()
        outcome = judge.judge(row, whole, level).verdict.outcome
        for path in sorted(whole.used):
            rest = Results(result for result in loaded if result.path != path)
            assert judge.judge(row, rest, level).verdict.outcome in (outcome, Outcome.UNDECIDED), (
                row["number"],
                path,
            )


class Recording(Results):
    """Results that note which of them are looked up."""

    def __init__(self, results: list[Result]) -> None:
        super().__init__(results)
        self.used: set[Path] = set()

    def of_panel(self, panel: str) -> list[Result]:
        found = super().of_panel(panel)
        self.used |= {result.path for result in found}
        return found


def test_errors_of_ratios_and_sums() -> None:
    first, second = Estimate("", 4.0, 0.3, 7, 0.1), Estimate("", 2.0, 0.2, 9, 0.0)
    result = ratio(first, second, "r")
    assert (result.value, result.dof) == (2, 7)
    assert result.error == pytest.approx(2 * (0.075**2 + 0.1**2) ** 0.5)
    assert result.systematic == pytest.approx(0.05)
    vanishing = ratio(Estimate("", 0.0, 0.3, 5, 0.1), Estimate("", -2.0, 0.5, 4, 0.2), "r")
    assert (vanishing.value, vanishing.error, vanishing.systematic, vanishing.dof) == (0, 0.15, 0.05, 4)
    total = combination([first, second], [1, -2], "d", 1)
    assert (total.value, total.dof, total.systematic) == (-1, 7, 0.1)
    assert total.error == pytest.approx(0.5)
    power = exponent_between(first, second, 2, "p")
    assert (power.value, power.dof) == (pytest.approx(-1), 7)
    assert power.error == pytest.approx((0.075**2 + 0.1**2) ** 0.5 / np.log(2))
    scaled = first / -2 - 1
    assert (scaled.value, scaled.error, scaled.systematic) == (-3, 0.15, 0.05)


def test_the_error_of_a_distance_is_that_of_the_bins_with_particles() -> None:
    """Bins of width 2, of which the Gaussian of a high temperature fills none: the sum is 0.2 from the second
    on. The first is empty, and has no error. Of a normalised histogram the sum has 0.8 of the error of the
    second bin and 0.2 of that of the third, and none at the end. Detected mistake: that of all bins below."""
    momentum, density, error = np.array([[-1, 1, 3], [0, 0.1, 0], [np.nan, 0.05, 0.01]])
    assert largest_distance(momentum, density, error, 1e12, normalised=False) == pytest.approx(
        (0.2, 0.1), rel=1e-4
    )
    density = np.array([0, 0.1, 0.4])
    expected = 0.8, np.hypot(0.8 * 0.1, 0.2 * 0.02)
    assert largest_distance(momentum, density, error, 1e-12, normalised=True) == pytest.approx(
        expected, rel=1e-4
    )
    whole = np.array([0, 0, 0.5])
    assert largest_distance(momentum, whole, error, 1e12, normalised=True)[1] == pytest.approx(0, abs=1e-12)


def test_fitted_control_variates_take_degrees_of_freedom() -> None:
    exact = next(iter(of_sizes(float).results("fig08", "deterministic")))
    plain = exact["kappa"]
    fitted = replace(plain, control_variates=6)
    number = estimate(replace(exact, quantities={"kappa": fitted}), "kappa")
    assert number.dof == plain.replicas - 7
