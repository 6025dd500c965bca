"""Fig. 10: height of the moving peak of an energy pulse against time; a: gamma = N, b: gamma = 1.

Below, exponents fitted over octaves of time. Beside the runs of fig. 9: pulses in longer rings until later
times. Times without a moving peak, whose height is NaN, are left out.
"""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, holds
from workflow.lib.load import Result
from workflow.lib.text import format_with_error, listed
from workflow.physics import run_parameters
from workflow.physics.pulse import in_order, label, look_of, named_start, resolved, start

TITLE = "Damping of the moving peak of an energy pulse, γ = {gamma}"
UNITS = dict.fromkeys(("exponent_from_here", "octave_exponent"), "1")
UNITS |= {"speed_to_next": "1/time", "octave_middle": "time"}

# By gamma: slopes of the guides, the paper's first, with their labels.
Guides = dict[float, tuple[str, str]]
SLOPES: dict[str, Guides] = {
    "N": {-2 / 3: ("$t^{-2/3}$", "2/3"), -1 / 2: ("$t^{-1/2}$", "1/2")},
    "1": {-1: ("$t^{-1}$", "1")},
}
SPAN = 0.15  # range of exponents shown on either side of the guides and of exponents with smaller errors
UNSURE = 0.5  # relative error above which a height is not shown
ABOVE = 1.2  # smallest ratio of a guide to a point


def tabulate(result: Result) -> pd.DataFrame:
    """One row per time; the exponent of an octave is in the row of its last time."""
    peak = result["peak"]
    part = pd.DataFrame({"time": peak.axes["time"], **result.columns("peak")})
    part = part.assign(**result.columns("peak_position"))
    later = {"exponent_from_here": "damping_exponent_from", "speed_to_next": "peak_speed"}
    for column, name in later.items():  # defined at all times but the last
        part[column] = pd.Series(result[name].mean)
        part[f"{column}_error"] = pd.Series(result[name].error)
    # The last time of an octave is a copy of one of the times.
    part = part.merge(by_octave(result).rename(columns={"until": "time"}), on="time", how="left")
    part.insert(0, "scatterer_temperature", str(start(result)))
    part.insert(1, "cells", result.parameters["cells"])
    return part


def by_octave(result: Result) -> pd.DataFrame:
    """Local exponents, with the last times and the geometric middles of the octaves over which they are
    fitted: those with a peak."""
    local, peak = result["local_damping_exponent"], result["peak"]
    times, until, rows = peak.axes["time"], local.axes["until"], []
    known = times[resolved(peak.mean)]
    for k, first in enumerate([times[0], *until[:-1]]):
        octave = known[(known >= first) & (known <= until[k])]
        ends = octave[[0, -1]] if len(octave) > 1 else np.array([np.nan, until[k]])
        rows.append((ends[1], np.sqrt(ends.prod()), local.mean[k], local.error[k]))
    return pd.DataFrame(rows, columns=["until", "octave_middle", "octave_exponent", "octave_exponent_error"])


def draw_guides(above: Axes, below: Axes, slopes: Guides, table: pd.DataFrame) -> None:
    """Plots powers of t from one point on, above those of the longest times, and their exponents."""
    seen = table[table.cells == table.cells.max()].dropna(subset="peak")
    time = seen.time / seen.time.min()
    start = ABOVE * max(((seen.peak / time**slope).max() for slope in slopes), default=0) / 1e3
    for slope, (name, exponent) in slopes.items():
        if len(seen):
            law = start * time**slope
            above.plot(seen.time, law, **style.GUIDE)
            style.name_point(above, name, (seen.time.iloc[-1], law.iloc[-1]), (2, 0), va="center")
        style.guide_at(below, -slope, exponent)
    precise = table[table.octave_exponent_error < SPAN].octave_exponent
    if values := [*(-slope for slope in slopes), *precise]:
        below.set_ylim(min(values) - SPAN, max(values) + SPAN)
    above.set_xlim(right=1.35 * above.get_xlim()[1])  # room for the names of the guides


def guides(results: Sequence[Result]) -> Guides:
    """The laws of elastic collisions."""
    return SLOPES.get(run_parameters.gamma(results[0]), {}) if holds(results) else {}


def exponents(result: Result) -> list[str]:
    """The exponents of all octaves with a moving peak."""
    found = by_octave(result).dropna(subset="octave_exponent")
    return [*map(format_with_error, found.octave_exponent, found.octave_exponent_error)]


def caption(results: Sequence[Result]) -> str:
    rest = results[0]
    law = "t^(−2/3)" if run_parameters.gamma(rest) == "N" else "t^(−1)"
    found = exponents(rest)
    names = {-2 / 3: "2/3 (sound)", -1 / 2: "1/2 (shock)", -1: "1"}
    laws = listed(names[slope] for slope in guides(results)) if guides(results) else None
    name = "exponents" if len(guides(results)) > 1 else "exponent"
    text = f"""The paper finds that the height of the moving peak of an energy pulse falls as {law}. (b)
        Exponents fitted over about an octave of time each; if {named_start(rest)}: {{found}}. Dashed guides,
        not fits: {name} {{laws}}."""
    return fill(text, found=listed(found) if found else None, laws=laws)


def draw(results: Sequence[Result]) -> Parts:
    figure, (above, below) = style.stacked(1.7, 1, height=1.7)
    results = in_order(results)
    tables = [tabulate(result) for result in results]
    for result, table in zip(results, tables, strict=True):
        look = look_of(result)
        sure = table[table.peak_error < UNSURE * table.peak]
        above.errorbar(sure.time, sure.peak / 1e3, sure.peak_error / 1e3, label=label(result), **look)
        below.errorbar(table.octave_middle, table.octave_exponent, table.octave_exponent_error, **look)
    table = pd.concat(tables)
    above.set(xscale="log", yscale="log", ylabel=rf"peak of $\Delta E\,/\,10^3$ ({style.UNIT_SYSTEM})")
    draw_guides(above, below, guides(results), table)
    below.set(xlabel="time $t$", ylabel=r"$-d\ln\,\mathrm{peak}/d\ln t$")
    for axis in (above.yaxis, below.xaxis):
        style.label_within_decades(axis)
    corner: style.Look = {"transform": above.transAxes, "ha": "right", "va": "top"}
    above.text(0.95, 0.95, rf"$\gamma = {run_parameters.gamma(results[0])}$", **corner)
    figure.legend(*above.get_legend_handles_labels(), loc="outside upper left")
    return figure, table, caption(results)
