"""The numbers of the claims, calculated from results with known true values (claim_truths*.py).

Exact results give the known numbers and systematic errors. Noisy results, drawn TRIALS times with the standard errors that they
state, give numbers that scatter about them as their own errors predict: chi-square over the trials and their mean, both at the
p-value LEVEL. An error that is wrong by a factor of two is found in all numbers.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2, norm

from tests.python.claim_truths import CASES, Case
from tests.python.claim_truths_closed import sound
from tests.python.known_results import Known, truth
from workflow.claims import pulse
from workflow.claims.judge import FUNCTIONS
from workflow.claims.verdict import Number
from workflow.lib.load import Quantity

TRIALS, LEVEL = 100, 1e-5
READINGS = ("literal", "intended", "alternative")
# Numbers whose errors are upper bounds: part of the label, and largest factor by which the error may be too large.
BOUNDS = {"Kolmogorov's distance": 1.5, "1 - |deviation at p": 1.1}


def data(case: Case, random: np.random.Generator | None = None) -> Known:
    return Known(
        {panel: truth(given, case.errors, random) for panel, given in case.world.items()}, case.quality
    )


def numbers(name: str, known: Known) -> list[Number]:
    evidence = FUNCTIONS[name[:3]](known)
    return [one for reading in READINGS for one in getattr(evidence, reading)]


def answers(case: Case) -> np.ndarray:
    """Expected numbers as an array [number, (value, systematic error)]."""
    every = [one for reading in READINGS for one in getattr(case, reading)]
    return np.array([one if isinstance(one, tuple) else (one, 0.0) for one in every])


def test_every_claim_is_here() -> None:
    assert {name[:3] for name in CASES} == FUNCTIONS.keys()


@pytest.mark.parametrize("name", CASES)
def test_exact_results_give_the_known_numbers(name: str) -> None:
    case = CASES[name]
    evidence = FUNCTIONS[name[:3]](data(case))
    for reading in READINGS:
        assert len(getattr(evidence, reading)) == len(getattr(case, reading)), reading
    found = np.array([(one.value, one.systematic) for one in numbers(name, data(case))])
    np.testing.assert_allclose(found, answers(case), rtol=1e-5, atol=1e-8)


def outside(z: np.ndarray, freedom: np.ndarray, widest: np.ndarray) -> np.ndarray:
    """Whether the scores [trial, number] contradict Student's t with these degrees of freedom, by their variance or by their mean.
    widest: largest factor by which an error may be too large."""
    trials, total, stretch = len(z), np.sum(z**2, axis=0), freedom / (freedom - 2)
    low, high = chi2.ppf(LEVEL, trials) / widest**2, chi2.isf(LEVEL, trials) * stretch
    return (
        (total < low) | (total > high) | (abs(z.mean(axis=0)) * trials**0.5 > norm.isf(LEVEL / 2) * stretch)
    )


def test_the_order_of_the_heat_peak_scatters_as_its_error_predicts() -> None:
    """The error is the spread over eight runs."""
    case, random = CASES["C30"], np.random.default_rng(6)
    orders = [pulse.heat_peak(data(case, random))[0] for _ in range(TRIALS // 2)]
    z = np.array([[(one.value - 1.7) / one.error] for one in orders])
    assert not outside(z, np.array([7.0]), np.ones(1)).any()
    assert outside(2 * z, np.array([7.0]), np.ones(1)).all()


def cheaper(name: str, monkeypatch: pytest.MonkeyPatch) -> Case:
    """A claim in its world. In C30 the order of the heat peak, which is tested above, is exact and is not fitted again."""
    case = CASES[name]
    if name != "C30":
        return case
    order, sentence = pulse.heat_peak(data(case))
    monkeypatch.setattr(pulse, "heat_peak", lambda _: (replace(order, error=0.0), sentence))
    return replace(case, world=case.world | {"ext03": sound})


@pytest.mark.parametrize("name", CASES)
def test_noisy_results_scatter_about_them_as_the_errors_predict(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    case, random = cheaper(name, monkeypatch), np.random.default_rng(5)
    draws = [numbers(name, data(case, random)) for _ in range(TRIALS)]
    known = answers(case)[:, 0]
    measured = [k for k, label in enumerate(draws[0]) if label.error]
    trials = np.array([[(draw[k].value, draw[k].error) for k in measured] for draw in draws])
    if not measured:
        assert name in ("C09", "C33")  # these are computed and have no statistical error
        return
    z = (trials[..., 0] - known[measured]) / trials[..., 1]
    labels = [draws[0][k].label for k in measured]
    freedom = np.array([min(draws[0][k].freedom, 1e6) for k in measured])
    widest = np.array([next((w for text, w in BOUNDS.items() if text in label), 1) for label in labels])
    wrong = outside(z, freedom, widest)
    assert not wrong.any(), [labels[k] for k in np.flatnonzero(wrong)]
    assert outside(z * 2, freedom, np.ones(1)).all()
    assert outside(z / 2 / widest, freedom, np.ones(1)).all()


def changed(known: Known, path: str) -> Known:
    """The data with all means of one run changed by different relative amounts of about a thousandth."""
    run, random = known.loaded[path], np.random.default_rng(1)

    def shifted(quantity: Quantity) -> Quantity:
        return replace(quantity, mean=quantity.mean * random.uniform(1.001, 1.002, quantity.mean.shape))

    quantities = {
        name: quantity if name == "stationary" else shifted(quantity)
        for name, quantity in run.quantities.items()
    }
    data = known.anew()
    data.loaded = known.loaded | {path: replace(run, quantities=quantities)}
    return data


@pytest.mark.parametrize("name", CASES)
def test_degrees_of_freedom_are_those_of_the_run_with_the_fewest_replicas(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A number depends on those runs whose change changes it. Exception: the heat peak, whose error is the spread over eight runs."""
    known = data(cheaper(name, monkeypatch))
    plain = numbers(name, known)
    fewest = np.full(len(plain), np.inf)
    for path in list(known.used):
        run = known.loaded[path]
        if "replicas" not in run.parameters:
            continue  # computed runs have no replicas
        for k, number in enumerate(numbers(name, changed(known, path))):
            if abs(number.value - plain[k].value) > 1e-9 * abs(plain[k].value):
                fewest[k] = min(fewest[k], run.parameters["replicas"] - 1)
    fewest[["heat peak" in number.label for number in plain]] = 7
    np.testing.assert_array_equal([shifted.freedom for shifted in plain], fewest)
