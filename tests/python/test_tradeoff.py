"""The arithmetic of speed against accuracy."""

import numpy as np
import pytest

from workflow.tradeoff.accuracy import amplitude, uncertainty
from workflow.tradeoff.measure import shortened

REPLICAS = np.array([10, 100, 1000])


def test_amplitude_of_the_law_and_of_noisy_errors() -> None:
    seconds = np.array([0.1, 1, 10])
    assert amplitude(seconds, 3 / np.sqrt(seconds), REPLICAS) == pytest.approx(3)
    # The least precise point hardly counts.
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
