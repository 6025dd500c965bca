"""Numbers of claims, calculated from results with known true values (claim_truths.py).

Exact results give the known numbers and systematic errors. Noisy results, drawn TRIALS times with the
standard errors that they state, give numbers that scatter about them as their own errors predict: chi-square
over the trials and their mean, both at the p-value LEVEL. An error that is wrong by a factor of two is found
in all numbers.
"""

import numpy as np
import pytest
from scipy.stats import chi2, norm

from tests.study.claim_truths import CASES, Case
from tests.study.known_results import Known, drawn, truth
from workflow.study import judge
from workflow.study.verdict import Estimate

TRIALS, LEVEL = 100, 1e-5


def data(case: Case) -> Known:
    return Known({panel: truth(given, case.errors) for panel, given in case.world.items()})


def numbers(name: str, known: Known) -> list[Estimate]:
    return judge.function_of({"function": name})(known)


def answers(case: Case) -> np.ndarray:
    """Expected numbers as an array [number, (value, systematic error)]."""
    return np.array([one if isinstance(one, tuple) else (one, 0.0) for one in case.numbers])


def test_every_module_of_claims_is_here() -> None:
    assert {name.partition(".")[0] for name in CASES} == judge.MODULES.keys()


@pytest.mark.parametrize("name", CASES)
def test_exact_results_give_the_known_numbers(name: str) -> None:
    found = np.array([(one.value, one.systematic) for one in numbers(name, data(CASES[name]))])
    np.testing.assert_allclose(found, answers(CASES[name]), rtol=1e-5, atol=1e-8)


def outside(z: np.ndarray, dof: np.ndarray) -> np.ndarray:
    """Whether the scores [trial, number] contradict Student's t with these degrees of freedom, by their
    variance or by their mean."""
    trials, total, stretch = len(z), np.sum(z**2, axis=0), dof / (dof - 2)
    low, high = chi2.ppf(LEVEL, trials), chi2.isf(LEVEL, trials) * stretch
    return (
        (total < low) | (total > high) | (abs(z.mean(axis=0)) * trials**0.5 > norm.isf(LEVEL / 2) * stretch)
    )


@pytest.mark.parametrize("name", CASES)
def test_noisy_results_scatter_about_them_as_the_errors_predict(name: str) -> None:
    case, random = CASES[name], np.random.default_rng(5)
    known = data(case)
    numbers(name, known)  # loads the results
    draws = [numbers(name, drawn(known, random)) for _ in range(TRIALS)]
    uncertain = [
        k for k, one in enumerate(draws[0]) if one.error > 0
    ]  # the others are exact: mu at sigma = 1 and -1
    trials = np.array([[(draw[k].value, draw[k].error) for k in uncertain] for draw in draws])
    z = (trials[..., 0] - answers(case)[uncertain, 0]) / trials[..., 1]
    dof = np.array([min(draws[0][k].dof, 1e6) for k in uncertain])
    assert not outside(z, dof).any()
    assert outside(z * 2, dof).all()
    assert outside(z / 2, dof).all()
