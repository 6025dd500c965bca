"""Numbers of the panels of the method: accuracy, stability and the picture of the model (plotted.py)."""

from typing import Any

import numpy as np
import pytest

from tests.python.plotted import CHAIN, RING, assert_line, assert_points, draw, result
from workflow.figures import accuracy
from workflow.lib.load import Result

STARTS = ("warm", "cold", "empty")


def test_accuracy(monkeypatch: pytest.MonkeyPatch) -> None:
    """κ is 100 in the reference, and 100 + k in the other runs; every run takes its κ in seconds. Two runs of
    fig. 8 have errors of 2 % and 4 %, of 10 % and 20 % without control variates."""
    runs: list[Result] = []
    monkeypatch.setattr(accuracy, "cpu_seconds", lambda path: seconds[path])

    def chain(run: str, kappa: float, errors: tuple[float, float] = (0.02, 0.1), **options: Any) -> None:
        made = result(run, CHAIN | {"relaxation_time": 3.0, "observation_time": 10.0} | options, "conductivity", kappa=kappa,
                      stationary=1.0, stationarity_p_value=0.5)  # fmt: skip
        target = options.get("target_error", np.nan)
        made.provenance.update(
            achieved_error=errors[0], error_without_control_variates=errors[1], target_error=target
        )
        runs.append(made)

    for size, errors in ((16, (0.02, 0.1)), (64, (0.04, 0.2))):
        chain(f"deterministic_cells={size}", 5.0 * size, errors, cells=size)
    chain("reference", 100.0, start="warm")
    for k, start in enumerate(STARTS, 1):
        for time in (1.0, 10.0):
            chain(
                f"relaxation_start={start}_time={time}",
                100 + 10 * k + time,
                start=start,
                relaxation_time=time,
            )
            chain(
                f"window_start={start}_time={time}", 100 + 20 * k + time, start=start, observation_time=time
            )
    for k, target in enumerate((0.1, 0.01)):
        chain(f"target_error={target}", 101.0 + k, target_error=target)
    for k in (1, 2):
        kinetic = result(f"kinetic_target-error={k}", CHAIN | {"gamma": 1.0}, "boltzmann", kappa=float(k))
        kinetic.provenance.update(achieved_error=10.0**-k, target_error=1.0)
        runs.append(kinetic)
    seconds = {run.path: float(run["kappa"].mean) for run in runs}
    (costs, relaxation, window, targets, kinetic_axes), table, caption = draw("accuracy", runs)
    of_costs = [80 * 2.0**2, 320 * 4.0**2]
    np.testing.assert_allclose(table.cost_of_1_percent[:2], of_costs)
    np.testing.assert_allclose(table.cost_without_control_variates[:2], [80 * 10.0**2, 320 * 20.0**2])
    assert_line(costs, [16, 64], of_costs)
    for axes, step in ((relaxation, 10), (window, 20)):
        kappas = [100 + step * k + np.array([1.0, 10]) for k in (1, 2, 3)]
        assert_points(axes, *((kappa, kappa / 100 - 1, np.hypot(0.01 * kappa, 1) / 100) for kappa in kappas))
    assert_points(targets, ([102], [2], [2]), ([101], [0.1], [0.2]))  # by ascending target
    assert_line(kinetic_axes, [1, 2], [0.1, 0.01])
    assert "costs 320 s at N = 16, 5100 s at N = 64" in caption
    assert "Deviation over target: 2.00 at most" in " ".join(caption.split())


def test_stability() -> None:
    """Drifts of ε times the time by the formula printed, of a tenth with the rule of the programs; currents of
    1.001 times the exact ones; chains in two units of length that agree up to t = 10, and differ by 1 % later."""
    runs = []
    for rule, factor in (("elastic", 0.1), ("printed", 1.0)):
        for time in (1.0, 100.0):
            drift = {"energy_change": factor * time * 1e-16, "momentum_change": factor * time * 3e-16}
            given = RING | {"sigma": 0.3, "rule": rule, "observation_time": time}
            runs.append(result(f"rounding_rule={rule}_{time}", given, **drift))
    baths = CHAIN | {
        "cells": 4,
        "nu_left": 10.0,
        "nu_right": 20.0,
        "temperature_left": 2.0,
        "temperature_right": 3.0,
    }
    free = (10 * 2 - 20 * 3) / 2
    limits = {"passing": ({"gamma": 1e-6}, free), "light": ({"sigma": -0.999}, free), "heavy": ({"sigma": 0.999, "gamma": 2.0}, free / 5),
              "hot": ({"sigma": 0.0, "temperature_right": 2000.0}, (20 - 40000) / 2)}  # fmt: skip
    runs += [
        result(name, baths | options, energy_current_mean=1.001 * exact)
        for name, (options, exact) in limits.items()
    ]
    for series, unit in (("unit", 1.0), ("tripled", 9.0)):
        for time in (1.0, 10.0, 100.0):
            energy = 300.0 * unit * (1.01 if (unit, time) == (9, 100) else 1)
            given = RING | {"observation_time": time, "temperature": 500 * unit}
            runs.append(result(f"{series}_t={time}", given, particle_energy=energy))
    (drifts, currents, partings), table, caption = draw("stability", runs)
    of_collisions = [
        (
            [100, 100],
            [factor * size * 1e-16, factor * size * 1e-14],
            np.array([0.01, 0.01]) * factor * size * np.array([1e-16, 1e-14]),
        )
        for factor in (0.1, 1)
        for size in (1, 3)
    ]
    assert_points(drifts, *of_collisions)
    assert_points(currents, ([1] * 4, np.arange(4)[::-1], [10.01] * 4))
    assert_points(partings, ([100] * 3, [1e-17, 1e-17, 0.01], [0, 0, 0]))
    assert [*table.limit.dropna()] == [
        "$\\gamma = 10^{-6}$",
        "$1 + \\sigma = 10^{-3}$",
        "$1 - \\sigma = 10^{-3}$",
        "$T_R/T_L = 10^{3}$",
    ]
    assert "energy changes by 1.0·10⁻¹⁵ as computed here, by 1.0·10⁻¹⁴ by the paper's formula" in caption


def test_model_is_a_picture_of_the_tabulated_flights() -> None:
    axes, table, _ = draw("model", [])
    ends = table[["start_time", "end_time"]].to_numpy()
    assert (ends[:, 1] >= ends[:, 0]).all()
    speeds = (table.end_position - table.start_position) / (table.end_time - table.start_time)
    moving = table.momentum != 0
    np.testing.assert_allclose(speeds[moving], table.momentum[moving], rtol=1e-9)
    assert len(axes) >= 2
