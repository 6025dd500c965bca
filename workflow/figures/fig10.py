"""Fig. 10: height of the moving peak of an energy pulse against time; a: gamma = N, b: gamma = 1.

Below, exponents fitted over octaves of time.
Times without a moving peak, whose height is NaN, are left out.
"""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import listed, number, parameters
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import with_error
from workflow.lib.load import Result
from workflow.lib.pulse import STARTS, look_of, paper_first, pulse, start

SLOPES = {"N": (-2 / 3, r"$t^{-2/3}$", "2/3"), 1: (-1, r"$t^{-1}$", "1")}  # the paper's guides
SPAN = 0.12  # smallest range of exponents shown on either side of the paper's
ABOVE = 1.2  # ratio of a guide to the first point


def tabulate(result: Result) -> pd.DataFrame:
    """One row per time; the exponent of an octave is in the row of its last time."""
    peak = result["peak"]
    part = pd.DataFrame({"time": peak.axes["time"], **result.columns("peak")})
    part = part.assign(peak_raw=result["peak_raw"].mean, **result.columns("peak_position"))
    later = {"exponent_from_here": "damping_exponent_from", "speed_to_next": "peak_speed"}
    for column, name in later.items():  # defined at all times but the last
        part[column] = pd.Series(result[name].mean)
        part[f"{column}_error"] = pd.Series(result[name].error)
    part = part.merge(by_octave(result).rename(columns={"until": "time"}), on="time", how="left")
    part.insert(0, "scatterer_temperature", str(start(result)))
    return part


def by_octave(result: Result) -> pd.DataFrame:
    """Local exponents, with the last times and the geometric middles of the octaves over which they are fitted."""
    local, times = result["local_damping_exponent"], result["peak"].axes["time"]
    until = local.axes["until"]
    middle = np.sqrt(until * np.append(times[0], until[:-1]))
    columns = {"octave_exponent": local.mean, "octave_exponent_error": local.error}
    return pd.DataFrame({"until": until, "octave_middle": middle, **columns})


def draw_peaks(axes: Axes, result: Result, table: pd.DataFrame) -> None:
    label = STARTS[start(result)][3]
    axes.errorbar(table.time, table.peak / 1e3, table.peak_error / 1e3, label=label, **look_of(result))


def draw_exponents(axes: Axes, result: Result) -> None:
    octaves = by_octave(result)
    exponents = octaves.octave_exponent, octaves.octave_exponent_error
    axes.errorbar(octaves.octave_middle, *exponents, **look_of(result))


def caption(results: Sequence[Result]) -> str:
    octaves = by_octave(results[0]).dropna()
    pairs = zip(octaves.octave_exponent, octaves.octave_exponent_error, strict=True)
    exponents = listed(with_error(*pair) for pair in pairs) if len(octaves) else "not resolved"
    slope, _, name = SLOPES[results[0].parameters["gamma"]]
    return f"""
        Damping of the moving peak of an energy pulse, runs of fig. 9: {pulse(results)}. (a) Height of the peak, from a smooth fit above
        half of it. (b) Exponents over octaves of time. Dashed: the paper's {number(slope)}. From rest the {"exponents of the octaves are" if len(octaves) > 1 else "exponent of the octave is"} {exponents};
        the paper has {name}. Error bars, where larger than the symbols: standard errors over replicas."""


def draw(results: Sequence[Result]) -> Drawn:
    figure, (above, below) = style.stacked(1.7, 1, height=1.6)
    results = paper_first(results)
    tables = [tabulate(result) for result in results]
    for result, table in zip(results, tables, strict=True):
        draw_peaks(above, result, table)
        draw_exponents(below, result)
    slope, guide, exponent = SLOPES[results[0].parameters["gamma"]]
    seen = tables[-1].dropna(subset="peak")  # the start with the highest peaks
    if len(seen):
        law = ABOVE * seen.peak.iloc[0] / 1e3 * (seen.time / seen.time.iloc[0]) ** slope
        above.plot(seen.time, law, **style.GUIDE, label=guide)
    style.guide_at(below, -slope, exponent)
    low, high = below.get_ylim()
    below.set_ylim(min(low, -slope - SPAN), max(high, -slope + SPAN))
    above.set(xscale="log", yscale="log", ylabel=rf"peak of $\Delta E\,/\,10^3$ ({style.UNITS})")
    below.set(xlabel="time $t$", ylabel=r"$-d\ln\,\mathrm{peak}/d\ln t$")
    for axis in (above.yaxis, below.xaxis):
        style.label_within_decades(axis)
    corner: style.Look = {"transform": above.transAxes, "ha": "right", "va": "top"}
    above.text(0.95, 0.95, rf"$\gamma = {style.gamma(results[0])}$", **corner)
    figure.legend(*above.get_legend_handles_labels(), loc="outside upper left", ncols=1)
    return figure, pd.concat(tables), caption(results)


if __name__ == "__main__":
    units = {
        "exponent_from_here": "1",
        "octave_exponent": "1",
        "speed_to_next": "1/time",
        "octave_middle": "time",
    }
    title = "Damping of the moving peak of an energy pulse, {}"
    run(draw, lambda pulses: title.format(parameters(pulses[:1], "gamma")), **units)
