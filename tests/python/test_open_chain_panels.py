"""Numbers of the panels of open chains, and of those with and without conserved momentum (plotted.py)."""

import numpy as np

from tests.python.plotted import CHAIN, assert_line, assert_points, both, draw, result
from workflow.figures.fig08 import APART


def test_fig01() -> None:
    times, bins, speeds = [2.0, 5, 9], [-3.0, -1, 1, 3], [0.1, 1.0, 10.0]
    front = 1.3 / (8 * np.e * np.array(times))
    filling = result(
        "unit-chain", CHAIN | {"momentum_max": 4.0, "momentum_bins": 4},
        weighted_momentum_density=(np.outer(times, bins) ** 2, {"time": times, "p": bins}),
        weighted_speed_density=(np.outer(times, speeds), {"time": times, "speed": speeds}),
        plateau=([7.0, 8, 9], {"time": times}), front=(front, {"time": times}), front_exponent=-0.9,
    )  # fmt: skip
    (_, middle, below), _, _ = draw("fig01", [filling])
    assert_points(below, (times, 1.3, filling["front"].error * 8 * np.e * times))
    assert_points(middle, (front, [7 / np.e, 8 / np.e, 9 / np.e], filling["front"].error))


def test_fig01_inset() -> None:
    time = np.geomspace(1, 64, 7)
    filling = result(
        "unit-chain",
        CHAIN,
        total_number=(3 + 8 * np.log(time), {"time": time}),
        log_slope=8.0,
        log_curvature=0.0,
        plateau=([7.5, 7.6], {"time": [4.0, 64.0]}),
    )
    (_, below), table, _ = draw("fig01_inset", [filling])
    error = filling["total_number"].error
    np.testing.assert_allclose(table.number_fitted[time > 3.9], (3 + 8 * np.log(time))[time > 3.9])
    assert table.number_fitted[time < 3.9].isna().all()
    slopes = np.hypot(error[[3, 6]], error[[0, 3]]) / np.log(8)
    assert_points(below, ([8**0.5, 8**1.5], 8, slopes), ([4, 64], *both(filling["plateau"])))


def test_fig02_lower() -> None:
    """The line goes through the middle half, 6 of 12 cells, as that of the programs does."""
    cells = np.arange(12)
    x, density = (cells + 0.5) / 12, 5 + np.array([3, 1, 0.4, 0.2, 0, 0.1, 0.3, 0, 0.1, 0.5, 1, 2])
    laws = {"density": (density, {"cell": cells}), "density_excess": ([0.2, 0.3], {"end": [0, 1]})}
    chain = result("rare", CHAIN | {"gamma": 1}, **laws)
    (above, below), _, caption = draw("fig02_lower", [chain])
    bulk = slice(3, 9)
    line = density[bulk].mean() + np.cov(x[bulk], density[bulk])[0, 1] / np.var(x[bulk], ddof=1) * (x - 0.5)
    error = chain["density"].error
    assert_points(above, (x, density, error))
    assert_line(above, x, line)
    assert_points(below, (x, density / line, error / line))
    assert "by 20.00(25) % and 30.00(28) % at γ = 1." in caption


def test_fig08() -> None:
    """κ = 2 N^0.4 and 3 N in chains, that of the heat N^0.3 and N^0.9, and 7 N^0.2 in mean field, which it
    has from the current and the temperatures of the ends. Particles carry 100 × 0.02 N of an energy N
    backwards, or 0.03 N."""
    sizes = np.array([4, 8, 16, 32])
    laws = {
        "deterministic": ("N", lambda n: 2 * n**0.4, 0.3, 0.02),
        "rare": (1, lambda n: 3.0 * n, 0.9, 0.03),
    }
    baths = {"temperature_left": 80.0, "temperature_right": 120.0}
    runs = [
        result(
            f"{series}_cells={n}",
            CHAIN | baths | {"cells": int(n), "gamma": gamma},
            "conductivity",
            kappa=kappa(n),
            kappa_heat=n**heat,
            energy_current=-1.0 * n,
            particle_current=flow * n,
            temperature_first=90.0,
            temperature_last=110.0,
            stationary=float(n != 16),
            stationarity_p_value=0.5,
        )
        for series, (gamma, kappa, heat, flow) in laws.items()
        for n in sizes
    ]
    of_size = {int(n): CHAIN | baths | {"cells": int(n)} for n in sizes}
    runs += [
        result(f"mean-field_cells={n}", chain, "boltzmann", kappa=7 * n**0.2) for n, chain in of_size.items()
    ]
    (above, below, *_), table, caption = draw("fig08", runs)
    sound, middle = np.array([4, 8, 32]), np.sqrt([32, 256])
    step, bars = np.log([2, 4]), 0.01 * 2**0.5
    found = ((x * middle, law, bars / step) for law, x in ((0.4, 1), (0.3, APART), (1, 1), (0.9, APART)))
    assert_points(below, *found)
    assert_line(above, sizes, 7 * sizes**0.2)
    deterministic = table[table.gamma == "N"]
    np.testing.assert_allclose(deterministic.mean_field_exponent_to_next.dropna(), 0.2)
    assert [*sound[:2]] == [*deterministic.cells[deterministic.exponent_to_next.notna()]]
    assert "at γ = N at most 0.400(20), and 0.400(10) in the end" in caption
