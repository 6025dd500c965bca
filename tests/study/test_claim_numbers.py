"""Numbers of claims and their systematic errors from exact results (claim_truths.py)."""

import numpy as np
import pytest

from tests.study.claim_truths import CASES
from tests.study.known_results import known
from workflow.study import judge


def test_every_module_of_claims_is_here() -> None:
    assert {name.partition(".")[0] for name in CASES} == judge.MODULES.keys()


@pytest.mark.parametrize("name", CASES)
def test_exact_results_give_the_known_numbers(name: str) -> None:
    world, numbers = CASES[name]
    estimates = judge.function_of({"function": name})(known(world, 1e-3))
    found = np.array([(one.value, one.systematic) for one in estimates])
    expected = [one if isinstance(one, tuple) else (one, 0.0) for one in numbers]
    np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-8)
