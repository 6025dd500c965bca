"""Fig. 9: energy difference after a pulse, at several times; a: gamma = N, b: gamma = 1.

Shown from the paper's start, in which scatterers are at rest, and from one in which they are as warm as the
particles; also position and speed of the moving peak. Faint: times at which both sides of the pulse have met
opposite to it; there is no peak from then on.
"""

import functools
from collections.abc import Sequence
from itertools import cycle

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, holds, plots
from workflow.lib.load import Result
from workflow.lib.text import format_quantity
from workflow.physics import run_parameters
from workflow.physics.closed import quasi_stationary
from workflow.physics.pulse import in_order, label, look, look_of, named_start, resolved, start
from workflow.physics.sound import Chain

TITLE = "Energy difference after a pulse, γ = {gamma}"
UNITS = {"distance": "1"}

FAINT = 0.45


def sound_speed(rest: Result) -> float:
    """Speed of sound [eq. 52] in cells per time, at gamma = N, from scatterers at rest, without the pulse: at
    the temperature and with the slow particles of eqs. 12 and 13 at the end of its relaxation."""
    options = rest.parameters
    particles, length = float(options["particles_per_cell"]), float(options["cell_length"])
    before = 2 * float(options["energy"])  # temperature of the particles at the start
    (temperature,), (slow,) = quasi_stationary(particles, before, length, options["relaxation_time"])
    return Chain(particles / (2 * slow), run_parameters.mass(rest), temperature, length).sound_speed_in_cells


def with_sound(result: Result) -> bool:
    """Whether the speed of sound is known: from scatterers at rest, where every particle scatters."""
    return holds([result], gamma="N", scatterer_temperature=0)


def draw_profiles(axes: Axes, result: Result, shown: np.ndarray) -> pd.DataFrame:
    """Plots the energy difference at the times `shown`. Returns the table."""
    difference = result["energy_difference"]
    times = difference.axes["time"]
    distance = difference.axes["cell"] - len(difference.axes["cell"]) // 2
    closed = result["ring_closed"].mean == 1
    parts = []
    indices = np.flatnonzero(np.isin(times, shown))
    for k, color, dashes in zip(indices, cycle(style.SEQUENCE), cycle(style.DASHES), strict=False):
        mean, error = difference.mean[k] / 1e3, difference.error[k] / 1e3
        alpha = FAINT if closed[k] else 1
        axes.plot(distance, mean, color=color, linestyle=dashes, label=f"$t = {times[k]:g}$", alpha=alpha)
        style.band(axes, distance, mean, error, color)
        columns = {"time": times[k], "distance": distance, "energy_difference": difference.mean[k]}
        part = pd.DataFrame({**columns, "energy_difference_error": difference.error[k]})
        parts.append(part.assign(ring_closed=closed[k]))
    axes.set_xlabel(r"distance from the central cell, $x/\lambda$")
    axes.set_title(label(result), size=style.label_size())
    return pd.concat(parts).assign(scatterer_temperature=str(start(result)))


def draw_motion(position: Axes, speed: Axes, result: Result) -> None:
    """Plots position and speed of the peak, and the line of constant speed since t = 0 through its first
    position."""
    where, rate = result["peak_position"], result["peak_speed"]
    time = where.axes["time"]
    first = next(iter(resolved(where.mean)), 0)
    position.errorbar(time, where.mean, where.error, label=label(result), **look_of(result))
    position.plot(time, where.mean[first] * time / time[first], **style.GUIDE | {"color": look(result)[1]})
    speed.errorbar(rate.axes["middle"], rate.mean, rate.error, **look_of(result))


def speeds(result: Result) -> tuple[str, str] | tuple[None, None]:
    """The first and the last speed of the peak that are known."""
    speed = result["peak_speed"]
    known = np.flatnonzero(np.isfinite(speed.mean) & (speed.error > 0))
    if not len(known):
        return None, None
    return format_quantity(speed, known[0]), format_quantity(speed, known[-1])


def caption(results: Sequence[Result], table: pd.DataFrame) -> str:
    rest = results[0]
    first, last = speeds(rest)
    peaks = "two peaks of almost constant" if rest.parameters["gamma"] == "N" else "peaks of constant"
    sound = "; (d) sound after a start at rest" if with_sound(rest) else ""
    faint = "Faint: after both sides of the pulse have met. " if table.ring_closed.any() else ""
    spike = "" if rest.parameters["gamma"] == "N" else "The spikes are the heated central scatterer. "
    text = f"""The paper finds {peaks} speed in the effect ΔE(x, t) of an energy pulse. {spike}(c), (d)
        Position and speed of the moving peak. If {named_start(rest)}, the speed is {{first}} cells per
        time at first and {{last}} at last. {faint}Dashed lines: (c) constant speed since t = 0{sound}."""
    return fill(text, first=first, last=last)


@plots("rest gaussian")
def draw(results: Sequence[Result]) -> Parts:
    results = in_order(results)
    size = (2 * style.COLUMN, 1.8 * style.HEIGHT)
    figure, panels = plt.subplot_mosaic([["rest", "gaussian"], ["position", "speed"]], figsize=size)
    position, speed, rest = (panels[name] for name in ("position", "speed", "rest"))
    panels["gaussian"].sharey(rest)
    common = functools.reduce(np.intersect1d, (result["peak"].axes["time"] for result in results))
    shown = common[np.linspace(min(1, len(common) - 1), len(common) - 1, 5).round().astype(int)]
    tables = []
    for result in results:
        tables.append(draw_profiles(panels[result.run], result, shown))
        draw_motion(position, speed, result)
    if with_sound(results[0]):
        style.guide_at(speed, sound_speed(results[0]), "sound (rest)", color=look(results[0])[1])
    rest.set_ylabel(rf"$\Delta E(x,t)\,/\,10^3$ ({style.UNIT_SYSTEM})")
    name = rf"$\gamma = {run_parameters.gamma(results[0])}$"
    rest.text(0.04, 0.95, name, transform=rest.transAxes, va="top")
    position.set(xlabel="time $t$", ylabel=r"peak $x_p/\lambda$", xlim=(0, None), ylim=(0, None))
    speed.set(xlabel="time $t$", ylabel=r"$dx_p/dt\,/\,\lambda$")
    position.legend(loc="upper left")
    position.set_ylim(top=1.35 * position.get_ylim()[1])
    figure.legend(*rest.get_legend_handles_labels(), loc="outside upper center", ncols=5)
    style.letter(*panels.values())
    table = pd.concat(tables)
    return figure, table, caption(results, table)
