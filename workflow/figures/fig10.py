"""Fig. 10: height of the moving peak of an energy pulse against time; a: gamma = N, b: gamma = 1.

Below, exponents fitted over octaves of time. The legend says where these drift.
Times without a moving peak, whose height is NaN, are left out; faint: times at which the ring has closed.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.figures.fig09 import STARTS, draw_marked, look_of, ring_closed, start
from workflow.lib import style
from workflow.lib.caption import CHAIN, ERRORS, goodness, listed, number, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import rejected, with_error
from workflow.lib.load import Result

SLOPES = {"N": (-2 / 3, r"$t^{-2/3}$", "2/3"), 1: (-1, r"$t^{-1}$", "1")}  # the paper's guides
SPAN = 0.12  # of the exponents that are shown on either side of the paper's, at least
ABOVE = 1.2  # factor by which these lie above the first point


def tabulate(result: Result) -> pd.DataFrame:
    """One row per time; the exponent of an octave stands at its last time."""
    peak = result["peak"]
    part = pd.DataFrame({"time": peak.axes["time"], "peak": peak.mean, "peak_error": peak.error}).assign(
        ring_closed=ring_closed(result)
    )
    part["peak_raw"], part["peak_position"] = result["peak_raw"].mean, result["peak_position"].mean
    part["peak_position_error"] = result["peak_position"].error
    for column, name in {
        "exponent_from_here": "damping_exponent_from",
        "speed_to_next": "peak_speed",
    }.items():  # all but the last time have them
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


def drift(result: Result) -> tuple[bool, str]:
    """Whether the exponent changes with ln t by more than chance, and what to say of it."""
    if ring_closed(result).any():
        return False, "may change unseen, as the ring has closed"
    change = result["damping_drift"]
    value, error = float(change.mean), float(change.error)
    if not np.isfinite(value):
        return False, "may change unseen, over too few octaves"
    chi_square = (value / error) ** 2
    told = f"changes by {with_error(value, error)} per unit of ln t, {goodness(chi_square, 1)}"
    return rejected(chi_square, 1), told


def draw_peaks(axes: Axes, result: Result, table: pd.DataFrame) -> None:
    drifts, _ = drift(result)
    law = ", exponent drifts" if drifts else ""
    values = (table.peak.to_numpy() / 1e3, table.peak_error.to_numpy() / 1e3)
    closed = table.ring_closed.to_numpy()
    label = STARTS[start(result)][3] + law
    draw_marked(axes, table.time.to_numpy(), values, closed, label=label, **look_of(result))


def draw_exponents(axes: Axes, result: Result) -> None:
    octaves = by_octave(result)
    closed = ring_closed(result)[np.isin(result["peak"].axes["time"], octaves.until)]
    values = (octaves.octave_exponent.to_numpy(), octaves.octave_exponent_error.to_numpy())
    draw_marked(axes, octaves.octave_middle.to_numpy(), values, closed, **look_of(result))


def caption(results: Sequence[Result]) -> str:
    said = []
    for result in results:
        drifts, change = drift(result)
        exponents = [
            with_error(one.octave_exponent, one.octave_exponent_error)
            for one in by_octave(result).dropna().itertuples()
        ]
        verdict = (
            f"the exponent drifts, {listed(exponents)} in one octave after another, so that its mean over all times, {style.with_error(result['damping_exponent'])}, belongs to these times"
            if drifts
            else f"exponent {style.with_error(result['damping_exponent'])}"
        )
        said.append(f"{STARTS[start(result)][3]}: {verdict}; it {change}")
    slope = SLOPES[results[0].parameters["gamma"]][0]
    return f"""
        Height of the moving peak of the energy difference after a pulse against time, from the runs of fig. 9;
        {parameters(results, *CHAIN, "particles-per-cell", "energy", "pulse-energy")} per degree of freedom, {replicas(results)}. (a) The
        top of a smooth peak fitted to the profile above half of its height, from Gaussian momenta (circles) and from
        scatterers at rest that have relaxed, as in the paper (squares); faint once the ring has closed. (b) −d ln(peak)/d ln t, fitted over
        octaves of time, to the nearest times recorded. Dashed: the paper's {number(slope)}. {ERRORS}. {". ".join(said)}."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    figure, (above, below) = plt.subplots(
        2, 1, sharex=True, figsize=(style.COLUMN, 1.6 * style.HEIGHT), height_ratios=[1.7, 1]
    )
    tables = [tabulate(result) for result in results]
    for result, table in zip(results, tables, strict=True):
        draw_peaks(above, result, table)
        draw_exponents(below, result)
    slope, guide, exponent = SLOPES[results[0].parameters["gamma"]]
    seen = tables[0].dropna(subset="peak")
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
    place = {"transform": above.transAxes, "ha": "right", "va": "top"}
    above.text(0.95, 0.95, rf"$\gamma = {style.gamma(results[0])}$", **place)
    figure.legend(*above.get_legend_handles_labels(), loc="outside upper left", ncols=1)
    style.letter(above, below)
    figure.align_ylabels()
    return figure, pd.concat(tables), caption(results)


if __name__ == "__main__":
    units = {"exponent_from_here": "1", "octave_exponent": "1", "speed_to_next": "1/time"}
    errors = {f"{column}_error": unit for column, unit in units.items()}
    run(
        draw,
        lambda pulses: f"Damping of the moving peak of an energy pulse, {parameters(pulses, 'gamma')}",
        octave_middle="time",
        **units,
        **errors,
    )
