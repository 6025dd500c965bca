"""Quantities that are functions of others in the same file, calculated again from these, in chains of N, n
and γ that are no powers of two. Errors in the others are found by reference simulators and exact results."""

import numpy as np
import pandas as pd
import pytest

from tests.python.conftest import Measure

RING = {"cells": 7, "particles_per_cell": 3, "gamma": 2.6, "cell_length": 0.7, "replicas": 10}
CHAIN = {"cells": 7, "gamma": 2.6, "cell_length": 0.7, "replicas": 20}


def slope(x: np.ndarray, y: np.ndarray) -> float:
    return float(np.polyfit(np.log(x), y, 1)[0])


def middles(times: np.ndarray) -> np.ndarray:
    return np.sqrt(times[1:] * times[:-1])


def test_slopes_of_a_displacement(measure: Measure) -> None:
    """The last of the times is nearer to the one before than the others. Detected mistakes: the middles are
    those of equal steps; alpha is fitted in another range of times."""
    run = {"decades": 1.94, "fit_decades": 1, "relaxation_time": 3, "observation_time": 50}
    result = measure("displacement", **RING, **run)
    variance, local = result["mean_square_displacement"], result["local_slope"]
    time = variance.axes["time"]
    assert time[-1] == 50
    np.testing.assert_allclose(local.axes["time"], middles(time), rtol=1e-14)
    np.testing.assert_allclose(local.mean, np.diff(np.log(variance.mean)) / np.diff(np.log(time)), rtol=1e-9)
    late = time >= 4.999
    assert result["alpha"].mean == pytest.approx(slope(time[late], np.log(variance.mean[late])), rel=1e-9)


@pytest.mark.parametrize("times", ["3,10,30,90", "0.01,0.5,90"])
def test_slopes_of_a_filling_chain(measure: Measure, times: str) -> None:
    """Detected mistakes: slopes begin later than the first time; the curvature is that of n; the front's
    bins are those of another time."""
    result = measure("particle_count", **CHAIN | {"cell_length": 0.07}, times=times)
    number, speeds = result["total_number"], result["weighted_speed_density"]
    time, first = number.axes["time"], float(times.partition(",")[0])
    assert time[0] <= first * (1 + 1e-9)
    late = time > first * (1 - 1e-9)
    assert result["log_slope"].mean == pytest.approx(slope(time[late], number.mean[late]), rel=1e-9)
    slopes = np.diff(number.mean) / np.diff(np.log(time))
    curvature = slope(middles(time)[late[:-1]], slopes[late[:-1]])
    assert result["log_curvature"].mean == pytest.approx(curvature, rel=1e-9)
    front, at = result["front"].mean, result["front"].axes["time"]
    plateau = first > 1  # long enough for one at all times
    assert np.isfinite(front).all() == plateau
    assert not plateau or result["front_exponent"].mean == pytest.approx(slope(at, np.log(front)), rel=1e-9)
    path, speed = 0.07 * 7 / 2.6, speeds.axes["speed"]
    thermal = np.sqrt(result.parameters["temperature_left"])
    for k, each in enumerate(at):
        used = (speed >= 10 * path / each) & (speed <= 0.2 * thermal)
        if used.any():
            assert result["plateau"].mean[k] == pytest.approx(speeds.mean[k, used].mean(), rel=1e-9)


def test_exponent_spread_is_that_of_its_cuts(measure: Measure) -> None:
    """The exponents of runs with one seed whose cut is each edge of the bins within a factor of three.
    Detected mistakes: a cut is left out; the spread is that of neighbours."""
    run = RING | {"relaxation_time": 3, "observation_time": 70, "cell_length": 1.3}
    cuts = 10 ** (np.arange(8, 18) / 10)  # edges from 20/3 to 60, ten per decade
    assert cuts[0] < 20 / 3 < cuts[1]
    assert cuts[-1] < 60 < cuts[-1] * 10**0.1
    found = [
        float(measure("waiting_time", **run, tail_from=cut * (1 + 1e-9))["exponent"].mean) for cut in cuts
    ]
    spread = float(measure("waiting_time", **run, tail_from=20)["exponent_spread"].mean)
    assert spread == pytest.approx(max(found) - min(found), rel=1e-9)
    assert spread > 1.5 * np.abs(np.diff(found)).max()


def test_waiting_times_of_hot_scatterers_have_bins(measure: Measure) -> None:
    """Particles that were hit by scatterers of 10^6 times their temperature wait a thousandth as long.
    Detected mistake: all of them are in the first bin, whose density is then not that of its neighbours."""
    run = RING | {
        "temperature": 1e-6,
        "scatterer_temperature": 1,
        "relaxation_time": 0,
        "observation_time": 30,
    }
    density = measure("waiting_time", **run)["density"]
    tau = density.axes["tau"]
    edge = 10**0.05
    share = density.mean * tau * (edge - 1 / edge)
    assert tau[0] == pytest.approx(0.7e-3 * edge)
    assert share.sum() == pytest.approx(1, abs=1e-6)
    assert share[tau < 0.02].max() == 0
    assert share.max() < 0.3


def test_a_kurtosis_of_few_crossings_is_not_defined(measure: Measure) -> None:
    """Detected mistake: its error, which the few fastest particles determine, is taken for known. Hardly any
    particle comes from the right."""
    baths = {"nu_left": 30, "nu_right": 1e-3, "temperature_left": 50, "temperature_right": 50}
    run = CHAIN | baths | {"cell_length": "1/N", "relaxation_time": 3, "observation_time": 7, "replicas": 10}
    result = measure("momentum_flux", **run)
    flux, kurtosis = result["flux"], result["kurtosis"]
    p = flux.axes["momentum"]
    halves = [flux.mean[:, np.sign(p) == sign].sum(axis=1) for sign in (-1, 1)]
    crossings = np.stack(halves, axis=1) * (p[1] - p[0]) * 7 * 10
    assert (np.abs(crossings - 1000) > 30).all()
    np.testing.assert_array_equal(np.isnan(kurtosis.mean), crossings < 1000)
    assert np.isnan(kurtosis.mean).any()
    assert np.isfinite(kurtosis.mean).any()


@pytest.mark.parametrize("gamma", ["N", 7.3])
def test_a_ring_is_closed_once_both_sides_of_the_pulse_have_met(measure: Measure, gamma: str | float) -> None:
    """The mean energy of the four cells opposite to it exceeds 2 % of the largest, or the last peak, at its
    speed, would have passed half the ring; and from then on. Detected mistakes: the ring is closed too late,
    or opens again."""
    ring = {"cells": 61, "particles_per_cell": 30, "gamma": gamma, "replicas": 8, "pairs_per_replica": 20}
    result = measure("energy_pulse", **ring, times="0.013,0.017,0.021,0.027,0.033,0.041,0.09,0.3,0.7")
    energy, position = result["energy_difference"].mean, result["peak_position"]
    time = position.axes["time"]
    opposite = energy[:, [0, 1, -2, -1]].mean(axis=1) > 0.02 * energy.max(axis=1)
    speed = pd.Series(position.mean / time).ffill().shift(fill_value=0).to_numpy()
    closed = np.maximum.accumulate(opposite | (speed * time > 61 / 2))
    assert result["ring_closed"].mean.tolist() == closed.tolist()
    assert not closed[0]
    assert closed[-1]
    assert np.isnan(result["peak"].mean[closed]).all()


OPEN = CHAIN | {"cell_length": 0.07, "relaxation_time": 3, "observation_time": 13}


def test_differences_deviations_and_lines_of_a_profile(measure: Measure) -> None:
    """Eleven cells, of which seven are in the middle half. Detected mistakes: lines through other cells,
    or not relative; means over cells in place of bonds."""
    result = measure("steady_profile", **OPEN | {"cells": 11})
    mean = {name: quantity.mean for name, quantity in result.quantities.items()}
    cells = np.arange(11)
    np.testing.assert_allclose(
        mean["temperature_difference"],
        mean["temperature_scatterer"] - mean["temperature_particle"],
        rtol=1e-9,
    )
    line = np.polyfit(cells[2:9], mean["density"][2:9], 1)
    assert mean["density_slope"] == pytest.approx(line[0] * 11 / np.polyval(line, 5), rel=1e-9)
    ends = mean["density"][[0, -1]] / np.polyval(line, [0, 10]) - 1
    np.testing.assert_allclose(mean["density_excess"], ends, rtol=1e-9)
    assert mean["energy_current_mean"] == pytest.approx(mean["energy_current"].mean(), rel=1e-12)
    current = mean["particle_current"]
    np.testing.assert_allclose(mean["particle_current_deviation"], current - current.mean(), atol=1e-9)
    for side in ("right", "left"):
        rate = mean[f"rate_{side}"]
        np.testing.assert_allclose(
            mean[f"rate_{side}_deviation"], rate - np.polyval(np.polyfit(cells, rate, 1), cells), atol=1e-9
        )


def test_moments_and_jump_of_the_flux(measure: Measure) -> None:
    """With narrow bins, and too few replicas for control variates. Detected mistakes: moments of the
    density, or of both directions; a jump between the middles of the bins."""
    result = measure("momentum_flux", **OPEN | {"momentum_bins": 6000, "momentum_max": 90, "replicas": 10})
    flux, p = result["flux"].mean, result["flux"].axes["momentum"]
    sides = [np.sign(p) == sign for sign in (-1, 1)]

    def moment(power: int) -> np.ndarray:
        return np.stack([(flux * p**power)[:, side].sum(axis=1) for side in sides], axis=1)

    square = moment(2) / moment(0)
    np.testing.assert_allclose(result["square"].mean, square, rtol=1e-4)
    np.testing.assert_allclose(result["kurtosis"].mean, moment(4) / moment(0) / square**2, rtol=1e-4)
    assert result["crossings"].mean == pytest.approx(moment(0).sum(axis=1).mean() * (p[1] - p[0]), rel=1e-6)
    zero = len(p) // 2
    at = [
        np.array([np.polyval(np.polyfit(p[part], row[part], 1), 0) for row in flux])
        for part in (slice(zero, zero + 2), slice(zero - 2, zero))
    ]
    np.testing.assert_allclose(result["jump"].mean, at[0] - at[1], atol=1e-9 * flux.max())
