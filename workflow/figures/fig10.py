"""Fig. 10: height of the moving peak of an energy pulse against time; a: gamma = N, b: gamma = 1.

Below, local exponents from pairs of times of which no two share one. An exponent stands in the legend only where these agree.
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
from workflow.lib.fit import mean_of, rejected, with_error
from workflow.lib.load import Result

SLOPES = {"N": (-2 / 3, r"$t^{-2/3}$"), 1: (-1, r"$t^{-1}$")}  # the paper's guides


def tabulate(result: Result) -> pd.DataFrame:
    """One row per time."""
    peak = result["peak"]
    part = pd.DataFrame({"time": peak.axes["time"], "peak": peak.mean, "peak_error": peak.error}).assign(
        ring_closed=ring_closed(result)
    )
    part["peak_raw"], part["peak_position"] = result["peak_raw"].mean, result["peak_position"].mean
    part["peak_position_error"] = result["peak_position"].error
    for column, name in {
        "exponent_from_here": "damping_exponent_from",
        "exponent_to_next": "local_damping_exponent",
        "speed_to_next": "peak_speed",
    }.items():  # all but the last time have them
        part[column] = pd.Series(result[name].mean)
        part[f"{column}_error"] = pd.Series(result[name].error)
    part.insert(0, "scatterer_temperature", str(start(result)))
    return part


def disjoint(table: pd.DataFrame) -> pd.DataFrame:
    """Every other pair of neighbouring times, with the exponent between them."""
    pairs = table.assign(
        middle=np.sqrt(table.time * table.time.shift(-1)),
        closed=table.ring_closed.shift(-1, fill_value=False),
    )
    return pairs.iloc[:-1:2].dropna(subset="exponent_to_next")


def before_closing(table: pd.DataFrame) -> pd.DataFrame:
    pairs = disjoint(table)
    return pairs[~pairs.closed.astype(bool)]


def drift(table: pd.DataFrame) -> tuple[bool, str]:
    """Whether the disjoint exponents before the ring closes differ by more than chance, and chi^2 about their mean."""
    pairs = before_closing(table)
    if len(pairs) < 2:
        return False, "fewer than two exponents before the ring closes"
    *_, chi_square = mean_of(pairs.exponent_to_next, pairs.exponent_to_next_error)
    freedom = len(pairs) - 1
    return rejected(chi_square, freedom), goodness(chi_square, freedom)


def draw_peaks(axes: Axes, result: Result, table: pd.DataFrame) -> None:
    drifts, _ = drift(table)
    law = "" if drifts else rf": $t^{{-{style.with_error(result['damping_exponent'])}}}$"
    values = (table.peak.to_numpy() / 1e3, table.peak_error.to_numpy() / 1e3)
    closed = table.ring_closed.to_numpy()
    label = STARTS[start(result)][3] + law
    draw_marked(axes, table.time.to_numpy(), values, closed, label=label, **look_of(result))


def draw_exponents(axes: Axes, result: Result, table: pd.DataFrame) -> None:
    pairs = disjoint(table)
    values = (pairs.exponent_to_next.to_numpy(), pairs.exponent_to_next_error.to_numpy())
    draw_marked(axes, pairs.middle.to_numpy(), values, pairs.closed.to_numpy(dtype=bool), **look_of(result))


def caption(tables: Sequence[pd.DataFrame], results: Sequence[Result]) -> str:
    said = []
    for result, table in zip(results, tables, strict=True):
        drifts, spread = drift(table)
        pairs = before_closing(table)
        exponents = [
            with_error(one.exponent_to_next, one.exponent_to_next_error) for one in pairs.itertuples()
        ]
        verdict = (
            f"no power law, local exponents {listed(exponents)} one after another"
            if drifts
            else f"exponent {style.with_error(result['damping_exponent'])}"
        )
        said.append(f"{STARTS[start(result)][3]}: {verdict} ({spread})")
    slope = SLOPES[results[0].parameters["gamma"]][0]
    return f"""
        Height of the moving peak of the energy difference after a pulse against time, from the runs of fig. 9;
        {parameters(results, *CHAIN, "particles-per-cell", "energy", "pulse-energy")} per degree of freedom, {replicas(results)}. (a) The
        top of a smooth peak fitted to the profile above half of its height, from Gaussian momenta (circles) and from
        scatterers at rest that have relaxed, as in the paper (squares); faint once the ring has closed. (b) -d ln(peak)/d ln t between two times; no
        two of these pairs have a time in common. Dashed: the paper's {number(slope)}. {ERRORS}. {"; ".join(said)}."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    figure, (above, below) = plt.subplots(
        2, 1, sharex=True, figsize=(style.COLUMN, 1.6 * style.HEIGHT), height_ratios=[1.7, 1]
    )
    tables = [tabulate(result) for result in results]
    for result, table in zip(results, tables, strict=True):
        draw_peaks(above, result, table)
        draw_exponents(below, result, table)
    slope, guide = SLOPES[results[0].parameters["gamma"]]
    seen = tables[0].dropna(subset="peak")
    if len(seen):
        law = seen.peak.iloc[0] / 1e3 * (seen.time / seen.time.iloc[0]) ** slope
        above.plot(seen.time, law, **style.GUIDE, label=guide)
    below.axhline(-slope, **style.GUIDE)
    above.set(xscale="log", yscale="log", ylabel=rf"peak of $\Delta E\,/\,10^3$ ({style.UNITS})")
    below.set(xlabel="time $t$", ylabel=r"$-d\ln\,\mathrm{peak}/d\ln t$")
    for axis in (above.yaxis, below.xaxis):
        style.label_within_decades(axis)
    place = {"transform": above.transAxes, "ha": "right", "va": "top"}
    above.text(0.95, 0.95, rf"$\gamma = {style.gamma(results[0])}$", **place)
    figure.legend(*above.get_legend_handles_labels(), loc="outside upper left", ncols=1)
    style.letter(above, below)
    figure.align_ylabels()
    return figure, pd.concat(tables), caption(tables, results)


if __name__ == "__main__":
    units = {"exponent_from_here": "1", "exponent_to_next": "1", "speed_to_next": "1/time"}
    errors = {f"{column}_error": unit for column, unit in units.items()}
    run(draw, "Damping of the moving peak of an energy pulse", **units, **errors)
