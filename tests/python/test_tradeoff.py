"""The arithmetic of speed against accuracy: laws, comparisons, differences from the careful setting."""

import ast
from collections.abc import Collection, Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.stats import chi2
from workflow.tradeoff.prediction import foretold

from workflow import tradeoff
from workflow.lib.plan import load_plan
from workflow.tradeoff.accuracy import amplitude, uncertainty
from workflow.tradeoff.bias import with_bias
from workflow.tradeoff.efficiency import Estimate, compared, jackknife
from workflow.tradeoff.measure import QUALITY, shortened

REPLICAS = np.array([10, 100, 1000])


def test_amplitude_of_the_law_and_of_noisy_errors() -> None:
    seconds = np.array([0.1, 1, 10])
    assert amplitude(seconds, 3 / np.sqrt(seconds), REPLICAS) == pytest.approx(3)
    # The least precise point has a negligible weight.
    assert amplitude(seconds, 3 / np.sqrt(seconds) * [2, 1, 1], REPLICAS) == pytest.approx(3, rel=0.01)


def test_uncertainty_over_samples() -> None:
    samples = np.random.default_rng(1).normal(size=(4000, 10))
    errors = samples.std(axis=1, ddof=1) / np.sqrt(10)
    ratio = np.var(errors) / np.mean(uncertainty(errors, 10) ** 2)
    assert 0.9 < ratio < 1.1
    assert not 0.9 < 2 * ratio < 1.1  # mutant: without the 2


@pytest.mark.parametrize(
    ("times", "share", "part"), [(400, 0.1, "40"), ("20N", 0.5, "10N"), ("2,6", 0.5, "1,3")]
)
def test_shortened(times: float | str, share: float, part: str) -> None:
    assert shortened(times, share) == part


def test_jackknife_of_a_ratio_over_samples() -> None:
    generator = np.random.default_rng(1)
    pulls = []
    for _ in range(400):
        rows = generator.normal([3, 2], 0.1, size=(20, 2))
        value, error = jackknife(lambda row: row[0] / row[1], rows)
        pulls.append((value - 1.5) / error)
    low, high = chi2.ppf([5e-4, 1 - 5e-4], 400)
    assert low < np.sum(np.square(pulls)) < 19 / 17 * high  # squared Student variables have the mean 19/17
    assert not low < np.sum(np.square(pulls)) / 1.5**2 < 19 / 17 * high  # mutant: errors too large


def test_compared() -> None:
    plain = Estimate(np.array([1.0, 1.0]), np.array([0.3, 0.0]), 2, 101, "energy")
    better = Estimate(np.array([1.5, 9.0]), np.array([0.4, 0.1]), 0.5, 51, "energy")
    row = compared("device", "quantity", plain, better)
    assert row["factor"] == pytest.approx(0.09 * 2 / (0.16 * 0.5))
    assert row["factor_error"] == pytest.approx(row["factor"] * np.sqrt(0.02 + 0.04))
    assert row["units"] == "energy"
    assert row["z"] == pytest.approx(1)  # a value without an error is not compared
    assert row["values"] == 1


def test_foretold_is_what_is_said_first() -> None:
    said = "p: 64 replicas: mu = 1 +- 1, not reached; the run ends after 640 to 900\n"
    assert foretold(said + said.replace("640", "700")) == (640, 900)


def test_bias_is_the_difference_from_the_last_row_of_a_knob() -> None:
    rows = {"knob": ["a", "a", "b"], "quantity": "q", "value": [3.0, 2.0, 7.0], "error": [0.3, 0.4, 0.7]}
    table = with_bias(pd.DataFrame(rows))
    assert list(table.bias) == pytest.approx([0.5, 0, 0])
    assert list(table.bias_error) == pytest.approx([0.25, 0.2, 0.1])
    assert list(table.careful) == [False, True, True]


def named_runs(panels: Collection[str]) -> Iterator[tuple[str, str]]:
    """Pairs of adjacent constants in these modules: the name of a panel and that of a run."""
    for module in Path(tradeoff.__path__[0]).glob("*.py"):
        for node in ast.walk(ast.parse(module.read_text())):
            values = node.args if isinstance(node, ast.Call) else getattr(node, "elts", [])
            constants = [value.value if isinstance(value, ast.Constant) else None for value in values]
            for panel, name in pairwise(constants):
                if panel in panels and isinstance(name, str):
                    yield panel, name


def test_every_run_that_is_named_is_planned() -> None:
    panels = load_plan(QUALITY)
    names = set(named_runs(panels))
    assert len(names) > 10
    for panel, name in names:
        assert panels[panel].run(name).name == name
