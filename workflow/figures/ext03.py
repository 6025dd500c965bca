"""Ext. 3: how sound is damped: correlations of the momenta of two cells, and the pulses of fig. 9a.

In a chain that conserves number, energy and momentum, sound peaks widen as t^(2/3) (Spohn, J. Stat. Phys. 154, 1191,
2014); damped by diffusion, as t^(1/2).
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.figures.fig09 import gaussian_start
from workflow.figures.fig10 import by_octave
from workflow.lib import style
from workflow.lib.caption import CHAIN, GAS, WINDOW, goodness, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import PowerLaw, fit_power, mean_of, with_error
from workflow.lib.load import Quantity, Result

SOUND, DIFFUSION = 2 / 3, 1 / 2
LARGEST_ERROR = 0.1  # of what is shown, absolute for exponents and relative for speeds
BESIDE = (3, 5)  # half widths of the peak between which C_g beside it is background
REACH = 0.6  # of the first peak from the centre, over which profiles are compared


def folded(profile: np.ndarray) -> np.ndarray:
    """Mean of both sides, by distance from the centre."""
    centre = len(profile) // 2
    mean: np.ndarray = 0.5 * (profile[centre:] + profile[centre::-1])
    return mean


def draw_collapse(axes: Axes, result: Result) -> pd.DataFrame:
    """The peak at several times, rescaled with the exponent of sound."""
    correlation, positions = result["momentum_correlation"], result["peak_position"].mean
    parts, times = [], correlation.axes["time"]
    shown = [k for k in range(len(positions)) if np.isfinite(positions[k])][1:]
    for k, color, dashes in zip(shown, style.SEQUENCE, style.DASHES, strict=False):
        stretch = (times[k] / times[shown[0]]) ** SOUND
        profile = folded(correlation.mean[k])
        x = (np.arange(len(profile)) - positions[k]) / stretch
        near = np.abs(x) < REACH * positions[shown[0]]
        y = profile * stretch
        error = np.sqrt(folded(correlation.error[k] ** 2) / 2) * stretch
        axes.plot(x[near], y[near] / 1e4, color=color, linestyle=dashes, label=f"$t = {times[k]:g}$")
        low, high = (y[near] - error[near]) / 1e4, (y[near] + error[near]) / 1e4
        axes.fill_between(x[near], low, high, color=color, alpha=0.3, linewidth=0)
        columns = {"time": times[k], "x": x[near], "y": y[near], "y_error": error[near]}
        parts.append(pd.DataFrame(columns))
    axes.axhline(0, **style.GUIDE)
    axes.set(xlabel=r"$(r - ct)\,(t_1/t)^{2/3}$")
    axes.set(ylabel=rf"$(t/t_1)^{{2/3}}\,C_g(r, t)\,/\,10^4$ ({style.UNITS})")
    axes.legend(loc="upper left", handlelength=1.6)
    return pd.concat(parts) if parts else pd.DataFrame(columns=["time", "x", "y", "y_error"])


def draw_exponents(axes: Axes, fluctuations: Result, pulse: Result) -> pd.DataFrame:
    parts = []
    for result, marker, color, text in (
        (fluctuations, "o", style.BLUE, f"correlations, $N = {fluctuations.parameters['cells']}$"),
        (pulse, "s", style.VERMILLION, f"pulse, $N = {pulse.parameters['cells']}$"),
    ):
        local = (
            by_octave(result).drop(columns="until").set_axis(["time", "exponent", "exponent_error"], axis=1)
        )
        used = local[local.exponent_error < LARGEST_ERROR]
        axes.errorbar(
            used.time,
            used.exponent,
            used.exponent_error,
            marker=marker,
            color=color,
            label=text,
            **style.POINTS,
        )
        parts.append(local.assign(source=text))
    for value, text in ((SOUND, "2/3"), (DIFFUSION, "1/2")):
        style.guide_at(axes, value, text)
    axes.set(xscale="log", xlabel="time $t$", ylabel="local damping exponent", ylim=(0.3, 1))
    style.label_within_decades(axes.xaxis)
    axes.legend(loc="upper left")
    return pd.concat(parts)


def draw_heat(axes: Axes, centre: Quantity) -> pd.DataFrame:
    time = centre.axes["time"]
    axes.errorbar(time, centre.mean, centre.error, marker="o", color=style.BLACK, **style.POINTS)
    axes.set(xscale="log", xlabel="time $t$", ylabel="$C_n(0, t)$", ylim=(0, None))
    style.label_within_decades(axes.xaxis)
    return pd.DataFrame({"time": time, "centre": centre.mean, "centre_error": centre.error})


def known(quantity: Quantity) -> tuple[np.ndarray, np.ndarray]:
    """Values and errors where there are any and they are known well enough to be shown."""
    used = quantity.error < LARGEST_ERROR * np.maximum(1, np.abs(quantity.mean))
    return quantity.mean[used], quantity.error[used]


def deviation(values: np.ndarray, errors: np.ndarray, expected: float) -> tuple[float, int]:
    """chi^2 of differences between neighbouring times against one value, with their number. Neighbours share a time and
    its error with opposite signs: their correlation is taken as -1/2."""
    pull = (values - expected) / errors
    size = len(values)
    covariance = np.eye(size) - 0.5 * (np.eye(size, k=1) + np.eye(size, k=-1))
    return float(pull @ np.linalg.solve(covariance, pull)), size


def background(result: Result) -> np.ndarray:
    """Mean of C_g at the distances BESIDE from the peak, on both sides, at every time; NaN without a peak."""
    heights, positions = result["peak"].mean, result["peak_position"].mean
    found = np.full(len(heights), np.nan)
    for k in np.flatnonzero(np.isfinite(heights)):
        profile = folded(result["momentum_correlation"].mean[k])
        distance = np.arange(len(profile)) - positions[k]
        half_width = distance[(distance > 0) & (profile < heights[k] / 2)].min(initial=np.inf)
        near, far = (factor * half_width for factor in BESIDE)
        beside = profile[(np.abs(distance) > near) & (np.abs(distance) < far)]
        found[k] = beside.mean() if len(beside) else np.nan
    return found


def damping(result: Result, above: bool = False) -> PowerLaw:
    """Power of time by which the peak falls, or by which it falls above its background; NaN where there are not two heights."""
    peak = result["peak"]
    height = peak.mean - background(result) if above else peak.mean
    there = np.isfinite(height)
    if there.sum() < 2:
        return PowerLaw(np.nan, np.nan, np.nan, np.nan, 0)
    return fit_power(peak.axes["time"][there], height[there], peak.error[there])


def between(times: np.ndarray) -> str:
    return f"between t = {times[0]:g} and {times[-1]:g}" if len(times) else "at no time"


def of_peak(result: Result) -> str:
    """What the height and the speed of the sound peak say."""
    speed = known(result["peak_speed"])
    law, above = damping(result), damping(result, above=True)
    seen = result["peak"].axes["time"][np.isfinite(result["peak"].mean)]
    tests = []
    for expected, name in ((SOUND, "2/3"), (DIFFUSION, "1/2")):
        found = goodness(*deviation(*known(result["local_damping_exponent"]), expected))
        tests.append(f"{name}: {found}")
    mean, *_ = mean_of(*speed)
    value, size = deviation(*speed, mean)
    octaves = by_octave(result).octave_exponent.dropna()
    return (
        f"Between octaves the exponent lies between {octaves.min():.3f} and {octaves.max():.3f}: the local exponents, whose errors are correlated, "
        f"against {tests[0]}; against {tests[1]}. A straight line through the logarithms of all heights {between(seen)} has the mean slope "
        f"{with_error(-law.exponent, law.error)}, and {with_error(-above.exponent, above.error)} above the background beside the "
        f"peak. The peak moves at {with_error(speed[0][0], speed[1][0])} cells per unit time at first and {with_error(speed[0][-1], speed[1][-1])} at "
        f"last ({goodness(value, size - 1)}, about a constant speed)."
    )


def of_heat(result: Result) -> str:
    """How the local exponent of C_n(0, t) changes."""
    values, errors = known(result["local_centre_exponent"])
    first, last = (with_error(values[k], errors[k]) for k in (0, -1))
    return f"The height at the centre falls with a local exponent that goes from {first} at the first times to {last} at the last"


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    rings = [one for one in results if one.provenance["program"] == "correlation"]
    largest = max(rings, key=lambda one: one.parameters["cells"])
    pulse = gaussian_start([one for one in results if one.provenance["program"] == "energy_pulse"])
    figure, row = plt.subplots(1, 3, figsize=(2.1 * style.COLUMN, style.HEIGHT))
    tables = [
        draw_collapse(row[0], largest),
        draw_exponents(row[1], largest, pulse),
        draw_heat(row[2], largest["centre"]),
    ]
    style.letter(*row)
    caption = (
        f"Sound in a ring, {parameters([largest], *CHAIN, *GAS)}, with scatterers at {largest.parameters['scatterer-temperature']:g}, to "
        f"which they heat up anyway, {parameters([largest], *WINDOW)}, {replicas([largest])}, from the fluctuations of what has then formed. (a) C_g, the "
        "covariance of the momenta of two cells at distance r and times t apart, about the peak that moves with the speed c, "
        "rescaled with the exponent 2/3 to the first time shown, t_1. (b) Local exponents of the peak's "
        f"height, over octaves of time, beside those of the energy pulse of fig. 10a from Gaussian momenta. {of_peak(largest)} (c) "
        f"Covariance of the numbers of particles in one cell at two times. {of_heat(largest)}; heat would keep one exponent, and "
        "slow particles that have not left their cell make C_n fall as the logarithm of t. Bands and bars: standard errors over replicas."
    )
    return figure, pd.concat(tables), caption


if __name__ == "__main__":
    run(
        draw,
        "Sound in the fluctuations of a ring, and the number of particles in a cell",
        x="1",
        y="momentum^2",
        y_error="momentum^2",
        exponent="1",
        exponent_error="1",
    )
