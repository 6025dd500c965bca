"""Numbers of the panels of the method: accuracy, stability and the picture of the model (plotted.py)."""

from typing import Any

import numpy as np
import pytest

from tests.python.plotted import CHAIN, RING, assert_line, assert_points, draw, over, result
from workflow.figures import accuracy
from workflow.lib.load import Result


def test_accuracy(monkeypatch: pytest.MonkeyPatch) -> None:
    seconds = {"persistence_replicas=32": 2.0, "persistence_replicas=128": 8.0}
    monkeypatch.setattr(accuracy, "cpu_seconds", lambda path: seconds.get(path.stem, 1.0))
    runs = [result(f"persistence_replicas={n}", RING, mu=value) for n, value in ((32, 0.3), (128, 0.33))]
    for run, count, error in zip(runs, (32, 128), (0.03, 0.0165), strict=True):
        run.provenance["target_quantity"] = "mu"
        run["mu"].error[...], run["mu"].replicas[...] = error, count
    runs += [
        result(f"kinetic_target-error={k}", CHAIN | {"gamma": 1.0}, "boltzmann", momentum_points=10.0 * k)
        for k in (1, 2)
    ]
    runs += [
        result(f"relaxation_relaxation-time={t}_start={start}", CHAIN | {"start": start, "relaxation_time": t}, kappa=k + t, stationary=1.0, drift_p_value=0.5)
        for k, start in ((10, "warm"), (20, "cold"), (30, "empty")) for t in (1.0, 10.0)
    ]  # fmt: skip
    runs += [
        result(f"first-time_fit-from={t}", RING | {"fit_from": t}, amplitude=t / 100) for t in (1.0, 2.0)
    ]
    axes, table, _ = draw("accuracy", runs)
    against, distances, relaxation, first, kinetic = axes
    assert_points(against, ([2, 8], [0.1, 0.05], [0.1 / 62**0.5, 0.05 / 254**0.5]))
    assert_points(distances, ([32], [-0.03 / np.hypot(0.03, 0.0165)], [0]))
    kappas = [np.array([k + 1, k + 10]) for k in (10, 20, 30)]
    assert_points(relaxation, *(([1, 10], kappa, 0.01 * kappa) for kappa in kappas))
    assert_points(first, ([1, 2], [0.01, 0.02], [1e-4, 2e-4]))
    assert_line(kinetic, [10, 20], [0.5, 0.5])
    assert [*table.cpu_seconds] == [2, 8, 1, 1]


def test_stability() -> None:
    def drifts(run: str, factor: float, **options: Any) -> Result:
        given = RING | {name.replace("_", "-"): value for name, value in options.items()}
        drift = {"energy_drift": factor * 1e-14, "momentum_drift": factor * 3e-14}
        return result(run, given, mu=0.3 + factor / 100, **drift)

    runs = [drifts(f"collisions_observation-time={t:g}", t, observation_time=t) for t in (1.0, 2.0)]
    runs += [
        drifts(f"mass-ratio_sigma={sigma}", 3.0, sigma=sigma, observation_time=1.0) for sigma in (-0.9, 0.99)
    ]
    runs += [
        drifts(name, 4.0, cell_length=length, observation_time=1.0)
        for name, length in (("tiny", 1e-15), ("huge", 1e13))
    ]
    (left, middle, right), table, caption = draw("stability", runs)
    assert_points(left, *((100, *over(runs[:2], f"{name}_drift")) for name in ("energy", "momentum")))
    assert_points(middle, *(([x], [y], [y / 100]) for x in (0.1, 0.01) for y in (3e-14, 9e-14)))
    assert_points(right, ([1e-15, 1e13], 0.34, 0.0034))
    assert [*table.collisions] == [100] * 6
    assert "by at most 4.0·10⁻¹⁴ of itself, their momentum (open symbols) by 1.2·10⁻¹³" in caption
    assert "28 orders of magnitude" in caption


def test_model_is_a_picture_of_the_tabulated_flights() -> None:
    axes, table, _ = draw("model", [])
    ends = table[["start_time", "end_time"]].to_numpy()
    assert (ends[:, 1] >= ends[:, 0]).all()
    speeds = (table.end_position - table.start_position) / (table.end_time - table.start_time)
    moving = table.momentum != 0
    np.testing.assert_allclose(speeds[moving], table.momentum[moving], rtol=1e-9)
    assert len(axes) >= 2
