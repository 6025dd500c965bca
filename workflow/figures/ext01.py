"""Ext. 1: spreading of a tagged particle with the paper's random total momentum, with none, and with random directions.

Above, local slopes of <x^2>(t): 2 is ballistic, 1 diffusive. Below, the exponent alpha of the runs without drift. The table
has alpha of all runs, and of those without drift the power b of t ln(t/tau)^b, which is 0 for t and -1 for t/ln t.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, RULES, number, parameters, replicas, rule
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import with_error
from workflow.lib.load import Result

PAPER, ZERO, RANDOM = (
    "random total momentum, as in the paper",
    "zero total momentum",
    RULES["random-direction"],
)
LOOKS: dict[str, style.Look] = {
    PAPER: style.points("o", style.BLUE),
    ZERO: style.points("s", style.VERMILLION, "white"),
    RANDOM: style.points("D", style.GREEN, "white"),
}
OTHER = style.points("P", style.BLACK, "white")  # a rule that the figure does not expect
LABELS = ("sigma", "particles-per-cell", "relaxation-time", "zero-total-momentum", "rule")
APART = 0.1  # distance of a kind from the middle of its slot, in units of the slot


def kind(result: Result) -> str:
    if rule(result) != "elastic":
        return rule(result)
    return ZERO if result.parameters["zero-total-momentum"] else PAPER


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run and time."""
    parts = []
    for result in results:
        slope = result["local_slope"]
        columns = {"time": slope.axes["time"], "slope": slope.mean, "slope_error": slope.error}
        part = pd.DataFrame(columns).assign(kind=kind(result))
        for name in LABELS:
            part[name.replace("-", "_")] = result.parameters[name]
        for name in ("alpha", "logarithmic_power", "momentum_drift"):
            if name not in result.quantities or np.isnan(result[name].mean):
                continue  # no logarithmic power where the chain drifts, no momentum where directions are random
            part = part.assign(**result.columns(name))
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def draw_slopes(axes: Axes, table: pd.DataFrame) -> None:
    """Plots local slopes at the paper's number of particles, after the longest relaxation; every third time, as neighbouring
    slopes have a time in common."""
    few = table[table.particles_per_cell == table.particles_per_cell.min()]
    for name, part in few[few.relaxation_time == few.relaxation_time.max()].groupby("kind"):
        every = part.iloc[::3]
        look = LOOKS.get(name, OTHER) | {"linestyle": "-", "label": name}
        axes.errorbar(every.time, every.slope, every.slope_error, **look)
    axes.set(xscale="log", xlabel="time $t$")


def draw_exponents(axes: Axes, runs: pd.DataFrame) -> None:
    """Plots alpha without drift, with one slot per number of particles and relaxation time."""
    slots = sorted(set(zip(runs.particles_per_cell, runs.relaxation_time, strict=True)))
    for name, part in runs[runs.kind != PAPER].groupby("kind"):
        pairs = zip(part.particles_per_cell, part.relaxation_time, strict=True)
        x = [slots.index(pair) + (-APART if name == ZERO else APART) for pair in pairs]
        axes.errorbar(x, part.alpha, part.alpha_error, **LOOKS.get(name, OTHER))
    names = [f"$n = {n}$\n$t_r = {relaxed:g}$" for n, relaxed in slots]
    axes.set_xticks(range(len(slots)), names)
    axes.tick_params(axis="x", length=0)
    axes.set_xlim(-0.5, len(slots) - 0.5)


def extremes(runs: pd.DataFrame) -> str:
    """Smallest and largest alpha for unequal masses."""
    unequal = runs[runs.sigma != 0].sort_values("alpha")
    return " to ".join(with_error(*unequal[["alpha", "alpha_error"]].iloc[k]) for k in (0, -1))


def caption(runs: pd.DataFrame, results: Sequence[Result]) -> str:
    options = results[0].parameters
    fitted = options["observation-time"] / 10 ** options["fit-decades"]
    ranges = {name: extremes(part) for name, part in runs.groupby("kind")}
    return f"""
        Spreading of a tagged particle in a closed chain, {parameters(results, "cells", "cell-length", "temperature", "gamma")}, n particles per
        cell, relaxed for t_r, {replicas(results)}. (a)–(c) Local slopes of ⟨x²⟩ for the paper's n and the longest t_r; random directions,
        new in every collision, do not conserve momentum. Dashed: ballistic, diffusive. (d)–(f) Exponent α fitted in the shaded window, from t = {number(fitted)} on. For σ ≠ 0, α is {ranges[PAPER]} in the
        paper's ensemble, {ranges[ZERO]} with zero total momentum and {ranges[RANDOM]} with random directions: the superdiffusion is drift. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    table = tabulate(results)
    runs = table.drop_duplicates(["kind", *(name.replace("-", "_") for name in LABELS)])
    sigmas = sorted(table.sigma.unique())
    size = (style.COLUMN * (0.4 + 0.6 * len(sigmas)), 1.5 * style.HEIGHT)
    figure, rows = plt.subplots(2, len(sigmas), sharey="row", figsize=size, height_ratios=[1.6, 1])
    options = results[0].parameters
    until = options["observation-time"]
    for sigma, (above, below) in zip(sigmas, rows.T, strict=True):
        draw_slopes(above, table[table.sigma == sigma])
        draw_exponents(below, runs[runs.sigma == sigma])
        above.axvspan(until / 10 ** options["fit-decades"], until, **style.WINDOW)
        above.text(0.05, 0.92, rf"$\sigma = {sigma:g}$", transform=above.transAxes, va="top")
        for axes, value in ((above, 1), (above, 2), (below, 1)):
            axes.axhline(value, **style.GUIDE)
    rows[0, 0].set(
        xlabel=f"time $t$ ({style.UNITS})", ylabel=r"$d\ln\langle x^2\rangle/d\ln t$", ylim=(0.6, 2.4)
    )
    rows[1, 0].set_ylabel(r"$\alpha$ without drift")
    style.letter(*rows.flat)
    figure.legend(*rows[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    figure.align_ylabels()
    return figure, table, caption(runs, results)


if __name__ == "__main__":
    run(draw, "Spreading of a tagged particle with and without conserved momentum", slope="1")
