"""The numbers of every claim from the results of the release are those of docs/gallery/numbers.csv.

What was wrong when it was recorded stays: a new claim needs a test with numbers calculated by hand. Claims
that are not recorded yet do not count.
"""

import io

import numpy as np
import pandas as pd

from tests.python.conftest import ROOT
from tests.python.test_release import results_of_release
from workflow.study.judge import judge_all
from workflow.study.report import numbers_file
from workflow.study.results import Results

CLAIM, NUMBER = ["claim", "kind"], ["value", "error", "systematic"]


def test_claims_have_the_recorded_numbers() -> None:
    """Their verdicts depend on the number of claims. Detected mistake: a line of a claim, of `results.py` or
    of `physics` changes a number."""
    recorded = pd.read_csv(ROOT / "docs/gallery/numbers.csv")
    judgements = judge_all(Results(results_of_release()))
    found = pd.read_csv(io.BytesIO(numbers_file(judgements)))
    known = pd.MultiIndex.from_frame(found[CLAIM]).isin(pd.MultiIndex.from_frame(recorded[CLAIM]))
    found, recorded = (table.sort_values([*CLAIM, "quantity", "value"]) for table in (found[known], recorded))
    assert [*found.quantity] == [*recorded.quantity]
    np.testing.assert_allclose(found[NUMBER], recorded[NUMBER], rtol=2e-6, atol=1e-300)
