"""Fits of growth laws against data that follow a known law."""

import numpy as np
import pandas as pd
import pytest
from scipy.stats import kstest

from workflow.figures.ext09 import LAWS, laws
from workflow.lib.growth import local_exponents

SIZES = np.array([16, 32, 64, 128, 256, 512, 1024, 2048], dtype=float)
TRUTH = {
    "N^(1/3)": 60 + 40 * np.cbrt(SIZES),
    "logarithm": 50 + 40 * np.log(SIZES),
    "constant": 300 - 200 * SIZES ** (-1 / 3),
}


@pytest.mark.parametrize("law", TRUTH)
def test_the_law_is_found_and_its_p_value_is_uniform(law: str) -> None:
    values, p_values = TRUTH[law], []
    for seed in range(200):
        noise = 0.005 * np.random.default_rng(seed).standard_normal(len(values))
        table = pd.DataFrame({"cells": SIZES, "kappa": values * (1 + noise), "kappa_error": 0.005 * values})
        found = laws(table).set_index("law")
        assert {*found.index} == {*LAWS}
        p_values.append(found.p_value[law])
        if seed < 20:
            assert found.chi_square.idxmin() == law
    assert kstest(p_values, "uniform").pvalue > 1e-3


def test_local_exponents() -> None:
    values = 70 * SIZES**0.25
    middle, slope, error = local_exponents(SIZES, values, 0.01 * values)
    np.testing.assert_allclose(middle, np.sqrt(SIZES[1:] * SIZES[:-1]))
    np.testing.assert_allclose(slope, 0.25)
    np.testing.assert_allclose(error, 0.01 * np.sqrt(2) / np.log(2))
