"""Numbers and parameters in captions."""

import numpy as np

from tests.python.conftest import ROOT
from workflow.lib.caption import listed, number, parameters, replicas
from workflow.lib.load import Quantity, Result


def result(**options: object) -> Result:
    count = np.array([32, 64]) if "replicas" in options else None
    quantity = Quantity(np.zeros(2), None, None, count, {}, "1", {}, {}, None)
    return Result(ROOT, options, {}, {"a": quantity})


def test_words_of_parameters() -> None:
    runs = [result(sigma=sigma, gamma=gamma, replicas=2) for sigma, gamma in ((0.5, "N"), (-0.5, 1.0))]
    assert parameters(runs, "sigma", "gamma", "cells") == "σ = −1/2 and 1/2, γ = 1 and N"
    assert replicas([*runs, result(sigma=0.5)]) == "64 replicas"
    assert [number(value) for value in (-0.05, 100 / 3, 1100 / 9, 50000.0, 1 / 3, 2)] == [
        "−0.05",
        "100/3",
        "122.2",
        "50000",
        "1/3",
        "2",
    ]
    assert listed(["a"]) == "a"
    assert listed(["a", "b", "c"]) == "a, b and c"
