"""Numbers of the figures: draw() gets results of known laws, and table and plotted data have the numbers that
follow from them.

Errors are distinct for every value, so that an error in place of a value, a wrong column, a swapped series or
a wrong factor is seen.
"""

import importlib
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes
from matplotlib.container import ErrorbarContainer
from scipy.integrate import quad

from workflow.lib.load import Quantity, Result
from workflow.physics.fluxes import MEAN_FIELD

Law = tuple[Any, dict[str, Any]]  # values, and coordinates by axis
BATHS = {"nu-left": 220.0, "nu-right": 180.0, "temperature-left": 80.0, "temperature-right": 120.0}
CHAIN = {"cells": 8, "cell-length": "1/N", "sigma": 0.5, "gamma": "N", "rule": "elastic", **BATHS}
RING = {"cells": 11, "particles-per-cell": 20, "cell-length": 1.0, "sigma": 0.5, "gamma": "N", "rule": "elastic",
        "temperature": 500.0, "zero-total-momentum": False, "relaxation-time": 100.0}  # fmt: skip


def errors_of(values: np.ndarray) -> np.ndarray:
    """Distinct errors: 1 %, 1.1 %, 1.2 % ... of the mean magnitude."""
    size = np.nanmean(np.abs(values)) or 1.0
    errors: np.ndarray = 0.01 * size * (1 + 0.1 * np.arange(values.size)).reshape(values.shape)
    return np.where(np.isfinite(values), errors, np.nan)


def result(run: str, options: dict[str, Any], program: str = "sampled", **laws: Law | float) -> Result:
    """A result of a run with these quantities; of `boltzmann` without standard errors."""
    quantities = {}
    for name, law in laws.items():
        values, axes = law if isinstance(law, tuple) else (law, {})
        mean = np.asarray(values, dtype=float)
        coordinates = {axis: np.asarray(points, dtype=float) for axis, points in axes.items()}
        computed = program == "boltzmann"
        errors = (None, 0 * mean, None) if computed else (errors_of(mean), None, np.full(mean.shape, 64))
        quantities[name] = Quantity(mean, *errors, coordinates, "1", dict.fromkeys(axes, "1"), None)
    provenance = {
        "program": program,
        "converged": "no target",
        "events": 6400,
        "target_quantity": "",
        "achieved_error": 0.5,
    }
    return Result(Path(f"data/smoke/panel/{run}.h5"), {"seed": 1, **options}, provenance, quantities)


@pytest.fixture(autouse=True)
def close() -> Iterator[None]:
    yield
    plt.close("all")


def drawn(script: str, results: Sequence[Result]) -> tuple[list[Axes], pd.DataFrame, str]:
    figure, table, caption = importlib.import_module(f"workflow.figures.{script}").draw([*results])
    return figure.axes, table.reset_index(drop=True), " ".join(caption.split())


def points(axes: Axes) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Abscissa, ordinate and error bar, vertical or horizontal, of every series of points; 0 without bars."""
    found = []
    for container in (each for each in axes.containers if isinstance(each, ErrorbarContainer)):
        line, _, bars = container
        x, y = (np.ma.filled(np.ma.asarray(values, dtype=float), np.nan) for values in line.get_data())
        segments = bars[0].get_segments() if bars else [np.zeros((1, 2))] * len(x)
        ends = [np.ptp(segment, axis=0).max() if len(segment) else np.nan for segment in segments]
        found.append((x, y, np.array(ends) / 2))
    return found


def lines(axes: Axes) -> list[tuple[np.ndarray, np.ndarray]]:
    """Abscissa and ordinate of the lines that are no series of points."""
    of_points = [container[0] for container in axes.containers]
    free = [line for line in axes.get_lines() if line not in of_points]
    return [tuple(np.asarray(values, dtype=float) for values in line.get_data()) for line in free]


def assert_points(axes: Axes, *expected: tuple[Any, Any, Any]) -> None:
    """The series of points are these, in this order; NaN is not plotted."""
    found = points(axes)
    assert len(found) == len(expected)
    for series, wanted in zip(found, expected, strict=True):
        x, y, error = (
            np.atleast_1d(np.asarray(values, dtype=float)) for values in np.broadcast_arrays(*wanted)
        )
        seen = np.isfinite(y) & np.isfinite(error)
        for values, law in zip(series, (x, y, error), strict=True):
            np.testing.assert_allclose(
                values[np.isfinite(series[1]) & np.isfinite(series[2])], law[seen], rtol=1e-9, atol=1e-12
            )


def assert_line(axes: Axes, x: Any, y: Any) -> None:
    """One of the lines has these points."""
    assert any(
        len(a) == len(x) and np.allclose(a, x) and np.allclose(b, y, rtol=1e-9, equal_nan=True)
        for a, b in lines(axes)
    )


def both(quantity: Quantity) -> tuple[np.ndarray, np.ndarray]:
    return quantity.mean, quantity.error


def test_fig01() -> None:
    times, bins, speeds = [2.0, 5, 9], [-3.0, -1, 1, 3], [0.1, 1.0, 10.0]
    front = 1.3 / (8 * np.e * np.array(times))
    filling = result(
        "unit-chain", CHAIN | {"momentum-max": 4.0, "momentum-bins": 4},
        weighted_momentum_density=(np.outer(times, bins) ** 2, {"time": times, "p": bins}),
        weighted_speed_density=(np.outer(times, speeds), {"time": times, "speed": speeds}),
        plateau=([7.0, 8, 9], {"time": times}), front=(front, {"time": times}), front_exponent=-0.9,
    )  # fmt: skip
    (above, middle, below), table, caption = drawn("fig01", [filling])
    for k, time in enumerate(times):
        assert_line(above, bins, (time * np.array(bins)) ** 2)
        assert_line(middle, speeds, time * np.array(speeds))
        at = table[(table.time == time) & (table.bins == "speed")]
        np.testing.assert_allclose(at.weighted_density, time * np.array(speeds))
        np.testing.assert_allclose(at.error, filling["weighted_speed_density"].error[k])
        np.testing.assert_allclose(at.plateau, 7 + k)
    assert_points(below, (times, 1.3, filling["front"].error * 8 * np.e * times))
    assert_points(middle, (front, [7 / np.e, 8 / np.e, 9 / np.e], filling["front"].error))
    assert "from 7.000(80) to 9.000(96), and p_0 ∼ t^a with a = −0.9000(90)" in caption


def test_fig01_has_fewer_curves_where_they_coincide() -> None:
    """The last time in the upper row; first, middle and last time, whose fronts differ, below. Each keeps its
    colour."""
    times, bins, speeds = [2.0, 5, 9], [-3.0, -1, 1, 3], [0.1, 1.0, 10.0]
    chains = [
        result(
            name, CHAIN | {"cell-length": length, "momentum-max": 4.0, "momentum-bins": 4},
            weighted_momentum_density=(np.outer(times, bins), {"time": times, "p": bins}),
            weighted_speed_density=(np.outer(times, speeds), {"time": times, "speed": speeds}),
            plateau=(heights, {"time": times}), front=([0.1, 0.05, 0.02], {"time": times}), front_exponent=-0.9,
        )
        for name, length, heights in (("unit-chain", "1/N", [7.0, 9, 7.1]), ("unit-spacing", 1.0, [7.0, 8, 9]))
    ]  # fmt: skip
    (above, other, middle, other_middle, *_), table, caption = drawn("fig01", chains)
    curves = [
        [line for line in axes.get_lines() if line.get_label().startswith("$t")]
        for axes in (above, other, middle, other_middle)
    ]
    assert [[line.get_label() for line in found] for found in curves] == [
        ["$t = 9$"], ["$t = 2$", "$t = 5$", "$t = 9$"], ["$t = 2$", "$t = 5$", "$t = 9$"], ["$t = 2$", "$t = 5$", "$t = 9$"],
    ]  # fmt: skip
    assert curves[0][0].get_color() == curves[1][2].get_color()
    assert len(table) == 2 * 3 * (4 + 3)
    assert "Coinciding curves are left out." in caption


def test_fig01_inset() -> None:
    time = np.geomspace(1, 64, 7)
    filling = result(
        "unit-chain", CHAIN, total_number=(3 + 8 * np.log(time), {"time": time}), log_slope=8.0, log_curvature=0.0,
        plateau=([7.5, 7.6], {"time": [4.0, 64.0]}),
    )  # fmt: skip
    (above, below), table, _ = drawn("fig01_inset", [filling])
    number, error = both(filling["total_number"])
    assert_points(above, (time, number, error))
    np.testing.assert_allclose(table.number_fitted[time > 3.9], (3 + 8 * np.log(time))[time > 3.9])
    assert table.number_fitted[time < 3.9].isna().all()
    slopes = np.hypot(error[[3, 6]], error[[0, 3]]) / np.log(8)
    assert_points(below, ([8**0.5, 8**1.5], 8, slopes), ([4, 64], *both(filling["plateau"])))


def test_fig02_upper() -> None:
    cells = np.arange(8)
    x = (cells + 0.5) / 8
    runs = [
        result(run, CHAIN | {"gamma": gamma}, temperature_scatterer=(90 + s * cells, {"cell": cells}),
               temperature_particle=(91 + s * cells, {"cell": cells}), temperature_difference=(-1 - 0.1 * s * cells, {"cell": cells}))
        for run, gamma, s in (("deterministic", "N", 2.0), ("rare", 1, 1.0))
    ]  # fmt: skip
    (above, below), table, _ = drawn("fig02_upper", runs)
    assert_points(above, *((x, *both(run["temperature_scatterer"])) for run in runs))
    assert_points(
        below,
        *((x, -run["temperature_difference"].mean, run["temperature_difference"].error) for run in runs),
    )
    for run, gamma in zip(runs, ("N", "1"), strict=True):
        assert_line(above, x, run["temperature_particle"].mean)
        part = table[table.gamma == gamma]
        np.testing.assert_allclose(part.particle, run["temperature_particle"].mean)
        np.testing.assert_allclose(part.particle_error, run["temperature_particle"].error)


def test_fig02_lower() -> None:
    """The line goes through the middle half, 6 of 12 cells, as that of the programs does."""
    cells = np.arange(12)
    x, density = (cells + 0.5) / 12, 5 + np.array([3, 1, 0.4, 0.2, 0, 0.1, 0.3, 0, 0.1, 0.5, 1, 2])
    chain = result(
        "rare",
        CHAIN | {"gamma": 1},
        density=(density, {"cell": cells}),
        density_excess=([0.2, 0.3], {"end": [0, 1]}),
    )
    (above, below), table, caption = drawn("fig02_lower", [chain])
    bulk = slice(3, 9)
    line = density[bulk].mean() + np.cov(x[bulk], density[bulk])[0, 1] / np.var(x[bulk], ddof=1) * (x - 0.5)
    error = chain["density"].error
    assert_points(above, (x, density, error))
    assert_line(above, x, line)
    assert_points(below, (x, density / line, error / line))
    np.testing.assert_allclose(table.bulk, line)
    assert (
        "first and last cell exceed a line through the shaded half by 20.00(25) and 30.00(28) % at γ = 1"
        in caption
    )


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
    (above, below, *_), table, caption = drawn("fig03", [solution])
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
    assert "Here it is 0.25 at x = 0 and 0.75 at x = 1" in caption


def test_fig03_inset() -> None:
    """F_N - F is 0.2/N times a shape with the maximum 1, in units of max F = 10; mean field 0.3/N."""
    p = np.array([-3.0, -1, 1, 3])
    shape, exact = np.array([0.25, 0.5, 1, 0.5]), np.array([6.0, 10, 10, 6])
    where = {"momentum": p}

    def flux(height: float, cells: int) -> Law:
        bonds = np.arange(cells + 1.0)
        return np.tile(exact + 10 * height * shape, (cells + 1, 1)), {"bond": bonds} | where

    runs = [
        result(
            "continuum",
            CHAIN | {"cells": "continuum"},
            "boltzmann",
            flux=(np.tile(exact, (2, 1)), {"x": [0, 1]} | where),
        )
    ]
    for cells in (2, 4):
        for kind, program, factor in (("mean-field", "boltzmann", 0.3), ("simulation", "momentum_flux", 0.2)):
            chain = CHAIN | {"cells": cells}
            runs.append(result(f"{kind}_cells={cells}", chain, program, flux=flux(factor / cells, cells)))
    axes, table, _ = drawn("fig03_inset", runs)
    left, right, decay = axes[:3]
    outgoing = {cells: np.where(p < 0, (error := run["flux"].error)[0], error[-1]) / 10
                for cells, run in ((2, runs[2]), (4, runs[4]))}  # fmt: skip
    for panel, half in ((left, p < 0), (right, p > 0)):
        assert_points(panel, *((p[half], 200 * shape[half] / n, 1e3 * outgoing[n][half]) for n in (2, 4)))
        for n in (2, 4):
            assert_line(panel, p[half], 300 * shape[half] / n)
    scale = 1 / (shape @ shape)
    amplitude = [scale * np.sqrt(np.sum((shape * outgoing[n]) ** 2)) for n in (2, 4)]
    assert_points(decay, ([2, 4], [0.1, 0.05], amplitude))
    assert_line(decay, [2, 4], [0.15, 0.075])
    assert_line(decay, [2, 4], [0.3 / 2 * (1.5 - 0.25), 0.3 / 4 * (1.5 - 0.25)])  # extrapolated to p = 0
    np.testing.assert_allclose(table.absolute_as_printed, table.deviation * 10 / 400)
    assert {*table[table.kind == MEAN_FIELD].error} == {0}


def test_fig04() -> None:
    p = np.array([-3.0, -1, 1, 3])
    chain = CHAIN | {"momentum-max": 4}
    flux = 10 + np.arange(36.0).reshape(9, 4)
    jump = 1 + np.arange(9.0)
    runs = [
        result(run, chain | rates, "momentum_flux", flux=(flux + shift, {"bond": np.arange(9), "momentum": p}),
               jump=(jump + shift, {"bond": np.arange(9)}))
        for run, shift, rates in (("deterministic", 0, {}), ("equal", 2, {"nu-left": 200.0, "nu-right": 200.0}))
    ]  # fmt: skip
    runs += [
        result(run, chain | rates, "boltzmann", flux=(flux - 1, {"x": np.arange(9) / 8, "momentum": p}), jump=(jump - shift, {"x": np.arange(9) / 8}))
        for run, shift, rates in (("mean-field", 0.5, {}), ("mean-field-equal", 0.7, {"nu-left": 200.0, "nu-right": 200.0}))
    ]  # fmt: skip
    axes, table, _ = drawn("fig04", runs)
    main, near, residual, jumps = axes[:4]
    halves = (p < 0, p > 0)
    error = runs[0]["flux"].error
    expected = [(p[half], flux[bond][half], error[bond][half]) for bond in (1, -1) for half in halves]
    assert_points(main, *expected)
    assert_points(near, *expected)
    unit = (flux[-1] - 1).max() / 100
    assert_points(residual, *((x, 1 / unit, bars / unit) for x, _, bars in expected))
    rows = [(0, run, bond) for run, bond in ((runs[0], 1), (runs[0], -1))] + [
        (1, runs[1], bond) for bond in (1, -1)
    ]
    assert_points(
        jumps,
        *(
            (run["jump"].mean[bond], -row + (0.17 if bond == 1 else -0.17), run["jump"].error[bond])
            for row, run, bond in rows
        ),
    )
    for row, shift, bond in ((0, 0.5, 1), (0, 0.5, -1), (1, 0.7, 1), (1, 0.7, -1)):
        assert_line(jumps, [jump[bond] - shift], [-row + (0.17 if bond == 1 else -0.17)])
    np.testing.assert_allclose(table.kinetic_jump, table.jump - np.where(table.nu_left == 200, 2.7, 0.5))


def test_fig05() -> None:
    runs = [
        result(f"paper_sigma={sigma}", RING | {"sigma": sigma}, mu=np.arccos(sigma) / np.pi + 0.01, particle_energy=3.0, scatterer_energy=1.0)
        for sigma in (-0.5, 0.5)
    ]  # fmt: skip
    (above, below), table, caption = drawn("fig05", runs)
    mu, error = (
        np.array([float(values[k]) for values in map(both, (run["mu"] for run in runs))]) for k in (0, 1)
    )
    assert_points(above, ([-0.5, 0.5], mu, error))
    assert_points(below, ([-0.5, 0.5], 10, 1e3 * error))
    local = 0.5 - np.arctan(np.array([-0.5, 0.5]) / 0.75**0.5 * 3**0.5) / np.pi
    assert_line(below, [-0.5, 0.5], 1e3 * (local - np.arccos([-0.5, 0.5]) / np.pi))
    np.testing.assert_allclose(table.law, [2 / 3, 1 / 3])
    np.testing.assert_allclose(table.deviation, 0.01)
    assert "0.0100(" in caption


def test_fig06() -> None:
    """Densities 3 τ^-3 and 5 τ^-2: times these powers they are constants, to which the fit goes. The exact
    density is averaged over bins."""
    tau = np.geomspace(0.1, 1000, 9)
    fit = {"tail-from": 20.0, "temperature": 400.0}  # the tail begins at 1
    runs = [
        result(f"all_sigma={sigma}", RING | fit | {"sigma": sigma}, density=(height * tau**-power, {"tau": tau}), exponent=-power)
        for sigma, power, height in ((0.0, 3.0, 3.0), (0.5, 2.0, 5.0))
    ]  # fmt: skip
    for run in runs:
        run["density"].error[...] = 0.02 * run["density"].mean
    young = result("young", RING | fit | {"relaxation-time": 10.0}, exponent=-1.97)
    (above, *strips), table, caption = drawn("fig06", [*runs, young])
    for strip, run, height in zip(strips, runs, (3, 5), strict=True):
        assert_points(strip, (tau, height, 0.02 * height), ([], [], []))
        tail = np.where(tau > 1.001, 1, np.nan)
        assert_line(strip, tau, height * tail)
        assert_line(above, tau, run["density"].mean * tail)
    exact = table[table.sigma == 0].gaussian_start
    edges = np.geomspace(0.1 / 10**0.25, 1000 * 10**0.25, 10)
    averages = [
        quad(lambda t: t**-3 / 400 * np.exp(-1 / (800 * t**2)), *bin_, epsabs=0)[0] / (bin_[1] - bin_[0])
        for bin_ in pairwise(edges)
    ]
    np.testing.assert_allclose(exact, averages, rtol=1e-9)
    assert (
        "they are −3.000(30) and −2.000(20) in the shaded windows (10 times earlier: −1.970(20))" in caption
    )


def test_fig07() -> None:
    time = np.geomspace(0.1, 100, 4)
    runs = [
        result(run, RING | {"zero-total-momentum": zero, "fit-decades": 1.0}, variance=(factor * time**power, {"time": time}),
               centre_of_mass=(0.3 * time**2, {"time": time}), local_slope=(np.full(3, power), {"time": time[1:]}), alpha=power)
        for run, zero, power, factor in (("all", False, 1.8, 4.0), ("zero-momentum", True, 1.1, 5.0))
    ]  # fmt: skip
    (above, below), table, caption = drawn("fig07", runs)
    assert_points(above, *((time, *both(run["variance"])) for run in runs))
    assert_points(below, *((np.sqrt(time[1:] * time[:-1]), *both(run["local_slope"])) for run in runs))
    assert_line(above, time, 0.3 * time**2)
    random = table[~table.zero_total_momentum]
    np.testing.assert_allclose(random.fraction, 0.3 * time**2 / (4 * time**1.8))
    drift, spread = runs[0]["centre_of_mass"], runs[0]["variance"]
    np.testing.assert_allclose(
        random.fraction_error / random.fraction,
        np.hypot(drift.error / drift.mean, spread.error / spread.mean),
    )
    assert "is 1.800(18) at N = 11 and 1.100(11) with zero total momentum" in caption


def test_fig07_inset() -> None:
    def alpha(run: str, sigma: float, value: float, **options: Any) -> Result:
        return result(
            run,
            RING | {"sigma": sigma} | {name.replace("_", "-"): each for name, each in options.items()},
            alpha=value,
        )

    runs = [alpha(f"all_sigma={sigma}", sigma, 1.7 + 0.1 * sigma) for sigma in (-0.5, 0, 0.5)]
    runs += [
        alpha(f"zero-momentum_sigma={sigma}", sigma, 0.9 + 0.1 * sigma, zero_total_momentum=True)
        for sigma in (-0.5, 0, 0.5)
    ]
    runs += [
        alpha("random_sigma=0.5", 0.5, 0.99, rule="random-direction"),
        alpha("aged_sigma=0.5", 0.5, 9.0, relaxation_time=10.0),
    ]
    (above, below), table, caption = drawn("fig07_inset", runs)
    curves = [
        ([-0.5, 0, 0.5], [run["alpha"].mean for run in part], [run["alpha"].error for run in part])
        for part in (runs[:3], runs[3:6])
    ]
    random = ([0.5], [0.99], [0.0099])
    assert_points(above, *curves, random)
    assert_points(below, curves[1], random)
    assert len(table) == len(runs)
    assert (
        "it is at least 1.650(17), at most 0.9500(95) with zero total momentum and 0.9900(99) with random directions"
        in caption
    )


def test_fig08() -> None:
    """κ = 2 N^0.4 and 3 N in chains, and 7 N^0.2 in mean field, which it has from the current and the
    temperatures of the ends."""
    sizes = np.array([4, 8, 16, 32])
    runs = [
        result(f"{series}_cells={n}", CHAIN | {"cells": int(n), "gamma": gamma}, "conductivity", kappa=kappa(n), energy_current=-1.0 * n,
               stationary=float(n != 16), drift_p_value=0.5)
        for series, gamma, kappa in (("every", "N", lambda n: 2 * n**0.4), ("rare", 1, lambda n: 3.0 * n)) for n in sizes
    ]  # fmt: skip
    runs += [
        result(f"mean-field_cells={n}", CHAIN | {"cells": int(n)}, "boltzmann", kappa=7 * n**0.2)
        for n in sizes
    ]  # fmt: skip
    (above, below, *_), table, caption = drawn("fig08", runs)
    assert_points(
        above,
        *(
            (sizes, [run["kappa"].mean for run in part], [run["kappa"].error for run in part])
            for part in (runs[:4], runs[4:8])
        ),
    )
    sound, middle = np.array([4, 8, 32]), np.sqrt([32, 256])
    step, bars = np.log([2, 4]), 0.01 * 2**0.5
    assert_points(below, (middle, 0.4, bars / step), (middle, 1, bars / step))
    assert_line(above, sizes, 7 * sizes**0.2)
    deterministic = table[table.gamma == "N"]
    np.testing.assert_allclose(deterministic.mean_field_kappa, 7 * sizes**0.2)
    np.testing.assert_allclose(deterministic.mean_field_exponent_to_next.dropna(), 0.2)
    np.testing.assert_allclose(deterministic.exponent_to_next.dropna(), 0.4)
    assert [*sound[:2]] == [*deterministic.cells[deterministic.exponent_to_next.notna()]]
    assert "are 0.400(20) and 0.400(10) at γ = N" in caption


PULSE = RING | {"energy": 5000.0, "pulse-energy": 5e4, "scatterer-temperature": 0.0, "relaxation-time": 1.0}


def pulses() -> list[Result]:
    """Peaks of height 9000/t and 4000/t², at 5 + 300 t and 5 + 200 t, in octaves of the exponents 0.6 and
    0.8."""
    time, cells = np.array([0.01, 0.02, 0.04]), np.arange(11)
    middle = np.sqrt(time[1:] * time[:-1])
    return [
        result(run, PULSE | start, energy_difference=(np.outer(1 / time, 100 + cells) * factor, {"time": time, "cell": cells}),
               ring_closed=([0, 0, 0], {"time": time}), peak=(factor / time**factor, {"time": time}),
               peak_position=(5 + factor * 100 * time, {"time": time}), peak_speed=([100.0 * factor, 101.0 * factor], {"middle": middle}),
               local_damping_exponent=([0.6, 0.2 * factor], {"until": time[1:]}), damping_exponent_from=([0.7, 0.71], {"from": time[:-1]}))
        for run, start, factor in (("rest", {}, 3.0), ("gaussian", {"scatterer-temperature": "particles"}, 2.0))
    ]  # fmt: skip


def test_fig09() -> None:
    runs = pulses()
    axes, table, _ = drawn("fig09", runs)
    panels = dict(zip(("rest", "gaussian", "position", "speed"), axes, strict=False))
    distance = np.arange(11) - 5
    for run in runs:
        profiles = run["energy_difference"]
        for k, band in zip((1, 2), panels[run.run].collections, strict=False):
            assert_line(panels[run.run], distance, profiles.mean[k] / 1e3)
            edges = band.get_paths()[0].vertices[:, 1]
            assert edges.max() == pytest.approx((profiles.mean[k] + profiles.error[k]).max() / 1e3)
    time = runs[0]["peak"].axes["time"]
    assert_points(panels["position"], *((time, *both(run["peak_position"])) for run in runs))
    assert_points(
        panels["speed"], *((run["peak_speed"].axes["middle"], *both(run["peak_speed"])) for run in runs)
    )
    for run in runs:
        assert_line(panels["position"], time, run["peak_position"].mean[0] * time / time[0])
    part = table[(table.time == 0.04) & (table.scatterer_temperature == "0.0")]
    np.testing.assert_allclose(part.energy_difference, runs[0]["energy_difference"].mean[2])
    np.testing.assert_allclose(part.energy_difference_error, runs[0]["energy_difference"].error[2])


def test_fig10() -> None:
    """The exponent of an octave is at the geometric middle of its ends."""
    runs = pulses()
    (above, below), table, caption = drawn("fig10", runs)
    time = runs[0]["peak"].axes["time"]
    assert_points(above, *((time, run["peak"].mean / 1e3, run["peak"].error / 1e3) for run in runs))
    middles = np.sqrt([0.01 * 0.02, 0.02 * 0.04])
    assert_points(
        below,
        *(
            (
                [np.nan, *middles],
                [np.nan, *run["local_damping_exponent"].mean],
                [np.nan, *run["local_damping_exponent"].error],
            )
            for run in runs
        ),
    )
    rest = table[table.scatterer_temperature == "0.0"]
    np.testing.assert_allclose(rest.octave_middle.dropna(), middles)
    np.testing.assert_allclose(rest.octave_exponent.dropna(), [0.6, 0.6])
    np.testing.assert_allclose(rest.exponent_from_here.dropna(), [0.7, 0.71])
    np.testing.assert_allclose(rest.speed_to_next.dropna(), [300, 303])
    assert "from rest goes from 0.6000(60) to 0.6000(66)" in caption


def test_momentum() -> None:
    """κ/κ(16) is (N/16)^a with another a for every case, and β - 1 is a."""
    sizes, time = (16, 32, 64), np.array([2.0, 4, 8])
    cases = {
        "elastic": (0.3, {}),
        "passing": (0.2, {"gamma": 0.9}),
        "reversal": (0.05, {"rule": "reversal", "reversal-probability": 0.1}),
    }
    runs = []
    ring = {"cells": 100, "sigma": 0.5, "fugacity": 1.0, "temperature": 1.0, "cell-length": 1.0}
    for name, (a, options) in cases.items():
        gamma = options.get("gamma", 1)
        own = {key: value for key, value in options.items() if key != "gamma"}
        series = {"elastic": "light"}.get(name, name)
        runs += [result(series, RING | ring | own | {"gamma": "N" if gamma == 1 else gamma * 100}, "heat_current",
                        heat_variance=(time ** (1 + a), {"time": time}), local_exponent=([1 + a, 1 + a], {"middle": np.sqrt([8, 32])}))]  # fmt: skip
        runs += [result(f"chain-{name}_cells={n}", CHAIN | {"cell-length": 0.1, "cells": n} | own | {"gamma": "N" if gamma == 1 else gamma * n},
                        "conductivity", kappa=7 * n**a, stationary=1.0, drift_p_value=0.5) for n in sizes]  # fmt: skip
    (chains, rings), table, caption = drawn("momentum", runs)
    order = ("elastic", "reversal", "passing")  # by passing, then by ε
    bars = [0, *[0.01 * 2**0.5] * 2]
    assert_points(
        chains,
        *((sizes, growth := (np.array(sizes) / 16) ** cases[name][0], growth * bars) for name in order),
    )
    assert_points(
        rings,
        *(
            (
                [*np.sqrt([8, 32]), np.nan],
                [cases[name][0]] * 2 + [np.nan],
                [*errors_of(np.array([1, 1])) * (1 + cases[name][0]), np.nan],
            )
            for name in order
        ),
    )
    assert (
        "κ(64)/κ(16) is 1.516(21) for elastic collisions, 1.320(19) with 10 % passing, 1.072(15) with 10 % reversed"
        in caption
    )
    assert "β − 1 ends at 0.200(13) and 0.050(12)" in caption
    assert len(table) == 9 + 9


def test_accuracy(monkeypatch: pytest.MonkeyPatch) -> None:
    accuracy = importlib.import_module("workflow.figures.accuracy")
    monkeypatch.setattr(
        accuracy,
        "cpu_seconds",
        lambda path: {"persistence_replicas=32": 2.0, "persistence_replicas=128": 8.0}.get(path.stem, 1.0),
    )
    runs = [result(f"persistence_replicas={n}", RING, mu=value) for n, value in ((32, 0.3), (128, 0.33))]
    for run, count, error in zip(runs, (32, 128), (0.03, 0.0165), strict=True):
        run.provenance["target_quantity"] = "mu"
        run["mu"].error[...], run["mu"].replicas[...] = error, count
    runs += [
        result(f"kinetic_target-error={k}", CHAIN | {"gamma": 1.0}, "boltzmann", momentum_points=10.0 * k)
        for k in (1, 2)
    ]
    runs += [
        result(f"relaxation_relaxation-time={t}_start={start}", CHAIN | {"start": start, "relaxation-time": t}, kappa=k + t, stationary=1.0, drift_p_value=0.5)
        for k, start in ((10, "warm"), (20, "cold"), (30, "empty")) for t in (1.0, 10.0)
    ]  # fmt: skip
    runs += [
        result(f"first-time_fit-from={t}", RING | {"fit-from": t}, amplitude=t / 100) for t in (1.0, 2.0)
    ]
    axes, table, _ = drawn("accuracy", runs)
    against, distances, relaxation, first, kinetic = axes
    assert_points(against, ([2, 8], [0.1, 0.05], [0.1 / 62**0.5, 0.05 / 254**0.5]))
    assert_points(distances, ([32], [-0.03 / np.hypot(0.03, 0.0165)], [0]))
    assert_points(
        relaxation, *(([1, 10], [k + 1, k + 10], [0.01 * (k + 1), 0.01 * (k + 10)]) for k in (10, 20, 30))
    )
    assert_points(first, ([1, 2], [0.01, 0.02], [1e-4, 2e-4]))
    assert_line(kinetic, [10, 20], [0.5, 0.5])
    assert [*table.cpu_seconds] == [2, 8, 1, 1]


def test_stability() -> None:
    def drifts(run: str, factor: float, **options: Any) -> Result:
        given = RING | {name.replace("_", "-"): value for name, value in options.items()}
        return result(
            run, given, mu=0.3 + factor / 100, energy_drift=factor * 1e-14, momentum_drift=factor * 3e-14
        )

    runs = [drifts(f"collisions_observation-time={t:g}", t, observation_time=t) for t in (1.0, 2.0)]
    runs += [
        drifts(f"mass-ratio_sigma={sigma}", 3.0, sigma=sigma, observation_time=1.0) for sigma in (-0.9, 0.99)
    ]
    runs += [
        drifts(name, 4.0, cell_length=length, observation_time=1.0)
        for name, length in (("tiny", 1e-15), ("huge", 1e13))
    ]
    (left, middle, right), table, caption = drawn("stability", runs)
    energy, momentum = ([run[f"{name}_drift"] for run in runs[:2]] for name in ("energy", "momentum"))
    assert_points(
        left, *(([100, 100], [q.mean for q in part], [q.error for q in part]) for part in (energy, momentum))
    )
    assert_points(middle, *(([x], [y], [y / 100]) for x in (0.1, 0.01) for y in (3e-14, 9e-14)))
    assert_points(right, ([1e-15, 1e13], 0.34, 0.0034))
    assert [*table.collisions] == [100] * 6
    assert "by at most 4.0·10⁻¹⁴ of itself, their momentum (open symbols) by 1.2·10⁻¹³" in caption
    assert "28 orders of magnitude" in caption


def test_model_is_a_picture_of_the_tabulated_flights() -> None:
    axes, table, _ = drawn("model", [])
    ends = table[["start_time", "end_time"]].to_numpy()
    assert (ends[:, 1] >= ends[:, 0]).all()
    speeds = (table.end_position - table.start_position) / (table.end_time - table.start_time)
    moving = table.momentum != 0
    np.testing.assert_allclose(speeds[moving], table.momentum[moving], rtol=1e-9)
    assert len(axes) >= 2
