"""Numbers of the panels of the flux against the Boltzmann equation (plotted.py)."""

import numpy as np
import pytest

from tests.python.plotted import (
    CHAIN,
    Law,
    assert_line,
    assert_points,
    draw,
    lines,
    result,
    right_scale,
)
from workflow.lib.load import Result
from workflow.physics.fluxes import MEAN_FIELD


def test_fig03() -> None:
    """Halves of a Gaussian, one of them with a bump: the ratio has the rate and the second moment of the
    flux itself."""
    p = np.arange(-40, 40, 0.5) + 0.25
    bump = 1 + 0.2 * np.exp(-((p - 15) ** 2) / 20)
    flux = np.stack([9 * np.exp(-(p**2) / 200) * np.where(p < 0, 2, 1) * part for part in (1, bump)])
    solution = result(
        "paper", CHAIN | {"gamma": 1.0}, "boltzmann", flux_density=(flux, {"x": [0, 1], "momentum": p}),
        kurtosis=([[3, 3.1], [3.2, 3.3]], {"x": [0, 1], "half": [-1, 1]}), jump=([0.25, 0.75], {"x": [0, 1]}),
    )  # fmt: skip
    (above, below, *_), table, caption = draw("fig03", [solution])
    for index, sign in ((0, -1), (0, 1), (1, -1), (1, 1)):
        half = np.sign(p) == sign
        rate, square = 0.5 * flux[index][half].sum(), np.average(p[half] ** 2, weights=flux[index][half])
        gaussian = rate * np.sqrt(2 / np.pi / square) * np.exp(-(p[half] ** 2) / 2 / square)
        assert_line(above, p[half], flux[index][half])
        often = flux[index][half] > 0.01 * flux.max()
        assert any(
            len(x) == half.sum()
            and np.allclose(y[often], 100 * (flux[index][half] / gaussian - 1)[often], atol=1e-9)
            for x, y in lines(below)
        )
    at_end = table[table.x == "x = 1"]
    np.testing.assert_allclose(at_end["kurtosis"], np.where(p > 0, 3.3, 3.2))
    np.testing.assert_allclose(at_end.jump, 0.75)
    assert right_scale(above) == pytest.approx(1 / 400)  # both rates
    assert "At the ends it jumps by 0.25 and 0.75." in caption


def test_fig03_inset() -> None:
    """F_N - F is 0.2/N times a shape with the maximum 1.25 as p -> 0, in units of max F = 10, and 10/400 of
    that if F integrates to 1; mean field 0.3/N, in bins of half the width."""
    p = np.array([-3.0, -1, 1, 3])
    fine = np.arange(-3.5, 4)

    def shape(p: np.ndarray) -> np.ndarray:
        return np.where(p < 0, 0.625 + 0.125 * p, 1.25 - 0.25 * p)

    def exact(p: np.ndarray) -> np.ndarray:
        return np.where(abs(p) < 2, 10.0, 6.0)

    def flux(height: float, p: np.ndarray, cells: int) -> Law:
        axes = {"bond": np.arange(cells + 1.0), "momentum": p}
        return np.tile(exact(p) + 10 * height * shape(p), (cells + 1, 1)), axes

    limit = np.tile(exact(fine), (2, 1)), {"x": [0, 1], "momentum": fine}
    runs = [result("continuum", CHAIN | {"cells": "continuum"}, "boltzmann", flux=limit)]
    for cells in (2, 4):
        chain = CHAIN | {"cells": cells}
        runs.append(
            result(f"mean-field_cells={cells}", chain, "boltzmann", flux=flux(0.3 / cells, fine, cells))
        )
        runs.append(
            result(f"simulation_cells={cells}", chain, "momentum_flux", flux=flux(0.2 / cells, p, cells))
        )
    axes, table, _ = draw("fig03_inset", runs)
    left, right, decay = axes[:3]
    outgoing = {cells: np.where(p < 0, (error := run["flux"].error)[0], error[-1]) / 4
                for cells, run in ((2, runs[2]), (4, runs[4]))}  # fmt: skip
    for panel, side in ((left, -1), (right, 1)):
        half, narrow = p[p * side > 0], fine[fine * side > 0]
        errors = {n: outgoing[n][p * side > 0] for n in (2, 4)}
        assert_points(panel, *((half, 0.5 * shape(half) / n, errors[n]) for n in (2, 4)))
        for n in (2, 4):
            assert_line(panel, narrow, 0.75 * shape(narrow) / n)
    scale = 1.25 / (shape(p) @ shape(p))
    amplitude = [scale * np.sqrt(np.sum((shape(p) * outgoing[n]) ** 2)) for n in (2, 4)]
    assert_points(decay, ([2, 4], [0.3125, 0.15625], amplitude))
    assert_line(decay, [2, 4], [0.75 / 2 * 1.25, 0.75 / 4 * 1.25])
    assert {*table[table.kind == MEAN_FIELD].error} == {0}


def test_fig04() -> None:
    """Fluxes of the Boltzmann equation are 1 lower. Its jumps are 0.5 lower, with equal rates 2 + 0.7."""
    p, bonds = np.array([-9.0, -1, 1, 3]), np.arange(9)
    chain, equal = CHAIN | {"momentum_max": 4}, {"nu_left": 200.0, "nu_right": 200.0}
    flux, jump = 10 + np.arange(36.0).reshape(9, 4), 1 + np.arange(9.0)

    def run(name: str, program: str, options: dict[str, float], lower: float, lower_jump: float) -> Result:
        along = {"bond": bonds} if program == "momentum_flux" else {"x": bonds / 8}
        laws = {"flux": (flux - lower, along | {"momentum": p}), "jump": (jump - lower_jump, along)}
        return result(name, chain | options, program, **laws)

    runs = [
        run("deterministic", "momentum_flux", {}, 0, 0), run("equal", "momentum_flux", equal, -2, -2),
        run("mean-field", "boltzmann", {}, 1, 0.5), run("mean-field-equal", "boltzmann", equal, 1, 0.7),
    ]  # fmt: skip
    (main, _, residual, *_), table, _ = draw("fig04", runs)
    assert right_scale(main) == pytest.approx(1 / 400)
    unit, error = (flux[-1] - 1).max() / 100, runs[0]["flux"].error
    halves = [(bond, half) for bond in (1, -1) for half in (p < 0, p > 0)]
    assert_points(residual, *((p[half], 1 / unit, error[bond][half] / unit) for bond, half in halves))
    np.testing.assert_allclose(table.theory_jump, table.jump - np.where(table.nu_left == 200, 2.7, 0.5))
