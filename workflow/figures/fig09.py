"""Fig. 9: energy difference after a pulse, at several times; a: gamma = N, b: gamma = 1.

Shown from the paper's start, in which scatterers at rest have relaxed, and from a start in which all momenta are Gaussian; also position
and speed of the moving peak. Faint: times at which both sides of the pulse have met opposite to it; there is no peak from then on.
"""

import functools
from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, parameters
from workflow.lib.figure import Drawn, run
from workflow.lib.load import Result
from workflow.lib.pulse import STARTS, look_of, paper_first, pulse, start

FAINT = 0.45


def draw_profiles(axes: Axes, result: Result, shown: np.ndarray) -> pd.DataFrame:
    """Plots the energy difference at the times `shown`. Returns the table."""
    difference = result["energy_difference"]
    times = difference.axes["time"]
    distance = difference.axes["cell"] - len(difference.axes["cell"]) // 2
    closed = result["ring_closed"].mean == 1
    parts = []
    indices = np.flatnonzero(np.isin(times, shown))
    for k, color, dashes in zip(indices, style.SEQUENCE, style.DASHES, strict=False):
        mean, error = difference.mean[k] / 1e3, difference.error[k] / 1e3
        alpha = FAINT if closed[k] else 1
        label = f"$t = {times[k]:g}$"
        axes.plot(distance, mean, color=color, linestyle=dashes, label=label, alpha=alpha)
        style.band(axes, distance, mean, error, color)
        columns = {"time": times[k], "distance": distance, "energy_difference": difference.mean[k]}
        part = pd.DataFrame({**columns, "energy_difference_error": difference.error[k]})
        parts.append(part.assign(ring_closed=closed[k]))
    axes.set_xlabel(r"distance from the central cell, $x/\lambda$")
    axes.legend(loc="upper right", title=STARTS[start(result)][3])
    return pd.concat(parts).assign(scatterer_temperature=str(start(result)))


def draw_position(axes: Axes, result: Result) -> None:
    """Plots the position of the peak, and the line of constant speed through its first position."""
    position, label = result["peak_position"], STARTS[start(result)][3]
    time = position.axes["time"]
    axes.errorbar(time, position.mean, position.error, label=label, **look_of(result))
    guide = style.GUIDE | {"color": STARTS[start(result)][1]}
    axes.plot(time, position.mean[0] * time / time[0], **guide)


def draw_speed(axes: Axes, result: Result) -> None:
    speed = result["peak_speed"]
    axes.errorbar(speed.axes["middle"], speed.mean, speed.error, **look_of(result))


def caption(results: Sequence[Result]) -> str:
    rest = results[0]["peak_speed"]
    resolved = np.flatnonzero(np.isfinite(rest.mean))
    ends = [style.with_error(rest, k) for k in resolved[[0, -1]]] if len(resolved) else []
    speed = "changes from {} to {}".format(*ends) if ends else "is not resolved"
    closed = any(result["ring_closed"].mean.any() for result in results)
    faint = " Faint: the two sides have met opposite to the pulse." if closed else ""
    near = "Spike: central scatterer; dips beside it: particles that would still be there without the pulse. "
    spike = near if results[0].parameters["gamma"] == 1 else ""
    return f"""
        Energy ΔE(x, t) per cell of a ring with a central pulse minus without; {pulse(results)}. (a), (b) ΔE.
        {spike}(c) Position of the moving peak; dashed: constant initial speed. (d) Speed between neighbouring times.{faint} As in the paper two peaks move apart; from rest
        their speed {speed}. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    results = paper_first(results)
    figure, panels = plt.subplot_mosaic(
        [[0, "particles", "position"], [0, "particles", "speed"]],
        figsize=(3 * style.COLUMN, 1.2 * style.HEIGHT),
        width_ratios=[1.15, 1.15, 1],
        height_ratios=[1.4, 1],
    )
    panels["particles"].sharey(panels[0])
    panels["speed"].sharex(panels["position"])
    tables = []
    common = functools.reduce(np.intersect1d, (result["peak"].axes["time"] for result in results))
    shown = common[np.linspace(min(1, len(common) - 1), len(common) - 1, 5).round().astype(int)]
    for result in results:
        tables.append(draw_profiles(panels[start(result)], result, shown))
        draw_position(panels["position"], result)
        draw_speed(panels["speed"], result)
    panels[0].set_ylabel(rf"$\Delta E(x,t)\,/\,10^3$ ({style.UNITS})")
    name = rf"$\gamma = {style.gamma(results[0])}$"
    panels[0].text(0.04, 0.95, name, transform=panels[0].transAxes, va="top")
    panels["position"].set(ylabel=r"peak $x_p/\lambda$", xlim=(0, None), ylim=(0, None))
    panels["speed"].set(xlabel="time $t$", ylabel=r"$dx_p/dt\,/\,\lambda$")
    panels["position"].legend(loc="upper left")
    panels["position"].set_ylim(top=1.35 * panels["position"].get_ylim()[1])
    style.letter(*panels.values())
    return figure, pd.concat(tables), caption(results)


if __name__ == "__main__":
    title = "Energy difference after a pulse, {}"
    run(draw, lambda pulses: title.format(parameters(pulses[:1], "gamma")), distance="1")
