"""Numbers of the panels of the method: accuracy, stability and the picture of the model (plotted.py)."""

from typing import Any

import numpy as np
import pytest

from tests.python.plotted import CHAIN, RING, assert_line, assert_points, draw, lines, result
from workflow.figures import accuracy
from workflow.lib.figure import NoValueError
from workflow.lib.load import Result

KAPPA = {N: (f"chain_cells={N}", N / 4, 0.01 * N**0.5, {"cells": N}) for N in (4, 8, 16, 32, 60, 128)}
ERRORS = [("cheap", 1.0, 0.001), ("typical", 2.0, 0.01), ("dear", 3.0, 0.1)]


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Function that makes a result with this CPU time and relative error, which is three times as large without
    control variates."""
    seconds = {}
    monkeypatch.setattr(accuracy, "cpu_seconds", lambda path: seconds[path])

    def make(name: str, time: float, error: float, options: Any = (), **more: Any) -> Result:
        given = CHAIN | {"relaxation_time": 3.0} | dict(options)
        made = result(name, given, more.get("program", "conductivity"), kappa=more.get("kappa", 1.0))
        errors = {"achieved_error": error, "error_without_control_variates": 3 * error}
        made.provenance.update(errors, target_quantity=more.get("target", "kappa"))
        seconds[made.path] = time
        return made

    return make


def texts(axes: Any) -> list[str]:
    return [text.get_text() for text in axes.texts]


def test_lines_of_accuracy_pass_through_the_runs_with_the_slope_of_the_number_of_replicas(run: Any) -> None:
    """Of κ at γ = N the smallest chain from N = 16 on, the middle and the largest; of μ the run of median cost; an
    error of 80 % is that of a target next to 0."""
    runs = [run(*KAPPA[cells]) for cells in KAPPA] + [run("rare", 9.0, 0.2, {"gamma": 1.0})]
    runs += [run(*each, target="mu") for each in ERRORS] + [run("wild", 1.0, 0.8, target="alpha")]
    runs += [run("mine", 5.0, 0.03, target="my_number", program="mine")]
    (axes, _), _, caption = draw("accuracy", runs)
    expected = [KAPPA[cells][1:3] for cells in (16, 60, 128)] + [(2.0, 0.01), (5.0, 0.03)]
    straight = [(x, y) for x, y in lines(axes) if len(x) == 2]
    assert len(straight) == len(expected)
    for time, error in expected:
        assert_line(axes, [time], [error])
        assert any(np.allclose(y, error * (x / time) ** -0.5) for x, y in straight)
    assert {*texts(axes)} == {
        r"$\mu$",
        "my number",
        *(rf"$\kappa$, $N = {cells}$" for cells in (16, 60, 128)),
    }
    assert "costs 64 s at N = 16 and 4100 s at N = 128 (γ = N)" in caption
    assert "kinetic" not in caption


def test_floors_of_accuracy_are_significant_deviations_from_the_reference(run: Any) -> None:
    """Errors are 1 %: 2 % of deviation are below two errors of the difference."""
    runs = [run(name, 1.0, 0.01, {"relaxation_time": time}, kappa=kappa) for name, time, kappa in
            (("reference", 100.0, 50.0), ("cold", 7.0, 40.0), ("warm", 2.0, 51.0))]  # fmt: skip
    runs += [run(f"kinetic_gamma={gamma}_k={k}", k, 10.0**-k, {"gamma": gamma}, program="boltzmann") for gamma in (1.0, 5.0)
             for k in (2, 1)]  # fmt: skip
    (axes, _), table, caption = draw("accuracy", runs)
    axes.figure.canvas.draw()  # without κ of other panels
    np.testing.assert_allclose(table.deviation[:3], [np.nan, -0.2, 0.02])
    np.testing.assert_allclose(table.deviation_error[1:3], np.hypot(0.5, [0.4, 0.51]) / 50)
    dashed = [line for line in axes.get_lines() if line.get_linestyle() == "--"]
    assert [list(line.get_ydata()) for line in dashed] == [[pytest.approx(0.2)] * 2]
    assert_line(axes, [1, 2], [0.1, 0.01])
    assert {*texts(axes)} == {
        "cold start, relaxed for 7: 20.0(1.3) %",
        *(rf"kinetic equation, $\gamma = {gamma}$" for gamma in (1, 5)),
    }
    assert "bias of short relaxation (dashed, N = 8); those of the kinetic equation" in caption


def test_cost_of_1_percent(run: Any) -> None:
    """t (error / 1 %)², with 9 times that without control variates, of κ alone."""
    runs = [run(*KAPPA[cells]) for cells in (8, 4)] + [
        run("rare", 9.0, 0.2, {"gamma": 1.0}),
        run(*ERRORS[1], target="mu"),
    ]
    (_, axes), table, _ = draw("accuracy", runs)
    costs = np.array([4 / 4 * 4, 8 / 4 * 8])
    np.testing.assert_allclose(table.cost_of_1_percent, [*costs[::-1], 9 * 20**2, 2])
    assert_line(axes, [4, 8], costs)
    assert_line(axes, [4, 8], 9 * costs)
    assert_line(axes, [8], [9 * 20**2])
    assert sum(len(x) > 0 for x, _ in lines(axes)) == 4


def test_accuracy_without_any_error_is_refused_in_one_line(run: Any) -> None:
    with pytest.raises(NoValueError, match="raise the number of replicas"):
        draw("accuracy", [run("alone", 1.0, np.nan)])


def test_stability() -> None:
    """Drifts of 1 times the time by the formula printed, of a tenth with the rule of the programs; currents of
    1.001 times the exact ones, with errors of 1 %."""
    runs = []
    for rule, factor in (("elastic", 0.1), ("printed", 1.0)):
        for time in (1.0, 100.0):
            drift = {"energy_change": factor * time, "momentum_change": 3 * factor * time}
            given = RING | {"sigma": 0.3, "rule": rule, "observation_time": time}
            runs.append(result(f"rounding_rule={rule}_{time}", given, **drift))
            runs[-1].provenance["events"] = int(6400 * time)
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
    (extremes, drifts), table, caption = draw("stability", runs)
    rows = np.arange(4)[::-1]
    assert_line(extremes, [1e-3] * 4, rows)
    bars = [(bar.get_y() + bar.get_height() / 2, bar.get_x() + bar.get_width()) for bar in extremes.patches]
    np.testing.assert_allclose(bars, [(row, 2 * 0.01001) for row in rows])
    assert_line(extremes, [10.0] * 2, [0, 1])  # rounding of the energy
    assert [label.get_text() for label in extremes.get_yticklabels()] == [*table.limit.dropna()]
    of_collisions = [([100, 1e4], [each, 100 * each], 0) for each in (0.1, 0.3, 1.0, 3.0)]
    assert_points(drifts, *of_collisions)
    assert_line(drifts, [100, 1e4], 2.0**-53 * np.array([10, 100]))
    assert [*table.limit.dropna()] == [
        "$\\gamma = 10^{-6}$",
        "$1 + \\sigma = 10^{-3}$",
        "$1 - \\sigma = 10^{-3}$",
        "$T_R/T_L = 10^{3}$",
    ]
    assert "by at most 0.1 standard errors" in caption
    assert "it changes the energy by 1.0·10¹ as computed here, by 1.0·10² by the paper's formula" in caption


def test_model_is_a_picture_of_the_tabulated_flights() -> None:
    axes, table, _ = draw("model", [])
    ends = table[["start_time", "end_time"]].to_numpy()
    assert (ends[:, 1] >= ends[:, 0]).all()
    speeds = (table.end_position - table.start_position) / (table.end_time - table.start_time)
    moving = table.momentum != 0
    np.testing.assert_allclose(speeds[moving], table.momentum[moving], rtol=1e-9)
    assert len(axes) >= 2
