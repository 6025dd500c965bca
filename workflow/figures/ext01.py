"""Ext. 1: spreading of a tagged particle with the paper's random total momentum, with none, and with random directions.

Local slopes of <x^2>(t): 2 is ballistic, 1 diffusive. The table also has alpha of the runs with other relaxation times and numbers of
particles.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, RULE_PHRASES, format_number, parameters, rule
from workflow.lib.figure import Parts, main, plots
from workflow.lib.fit import format_with_error
from workflow.lib.load import Result

PAPER, ZERO, RANDOM = (
    "random total momentum, as in the paper",
    "zero total momentum",
    RULE_PHRASES["random-direction"],
)
LOOKS: dict[str, style.Look] = {
    PAPER: style.points("o", style.BLUE),
    ZERO: style.points("s", style.VERMILLION, "white"),
    RANDOM: style.points("D", style.GREEN, "white"),
}
OTHER = style.points("P", style.BLACK, "white")  # a rule that the figure does not expect
LABELS = ("sigma", "particles-per-cell", "relaxation-time", "zero-total-momentum", "rule")
KEYS = [name.replace("-", "_") for name in LABELS]


def kind(result: Result) -> str:
    if rule(result) != "elastic":
        return rule(result)
    return ZERO if result.parameters["zero-total-momentum"] else PAPER


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run and time, for unequal masses."""
    parts = []
    for result in results:
        slope = result["local_slope"]
        columns = {"time": slope.axes["time"], "slope": slope.mean, "slope_error": slope.error}
        labels = dict(zip(KEYS, (result.parameters[name] for name in LABELS), strict=True))
        parts.append(pd.DataFrame(columns).assign(kind=kind(result), **labels, **result.columns("alpha")))
    table = pd.concat(parts, ignore_index=True)
    return table[table.sigma != 0]


def of_the_paper(table: pd.DataFrame) -> pd.DataFrame:
    """Rows with the fewest particles per cell, the paper's number, after the longest relaxation."""
    few = table[table.particles_per_cell == table.particles_per_cell.min()]
    return few[few.relaxation_time == few.relaxation_time.max()]


def draw_slopes(axes: Axes, table: pd.DataFrame) -> None:
    """Plots every third local slope, as neighbouring slopes have a time in common."""
    for name, part in table.groupby("kind"):
        every = part.iloc[::3]
        look = LOOKS.get(name, OTHER) | {"linestyle": "-", "label": name}
        axes.errorbar(every.time, every.slope, every.slope_error, **look)
    for value in (1, 2):
        axes.axhline(value, **style.GUIDE)
    axes.set(xscale="log", xlabel=f"time $t$ ({style.UNITS})", ylim=(0.6, 2.4))


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    runs = table.drop_duplicates(["kind", *KEYS])
    ordered = {name: part.sort_values("alpha") for name, part in runs.groupby("kind")}
    least = format_with_error(*ordered[PAPER][["alpha", "alpha_error"]].iloc[0])
    none, random = (
        format_with_error(*ordered[name][["alpha", "alpha_error"]].iloc[-1]) for name in (ZERO, RANDOM)
    )
    relaxed = format_number(of_the_paper(table).relaxation_time.iloc[0])
    return f"""
        Local exponents of ⟨x²⟩ of a tagged particle in a closed chain, {parameters(results, "cells", "temperature", "gamma")}, n =
        {table.particles_per_cell.min()}, relaxed for {relaxed}; dashed: ballistic, diffusive. Random directions do not conserve momentum. α, fitted in the
        shaded window of all runs, is at least {least} with random total momentum, at most {none} with none and {random} with random directions. {ERRORS}"""


@plots("paper dense dense-drift random random-dense")
def draw(results: Sequence[Result]) -> Parts:
    table = tabulate(results)
    sigmas = sorted(table.sigma.unique())
    figure, row = plt.subplots(1, len(sigmas), sharey=True, figsize=(2 * style.COLUMN, style.HEIGHT))
    until, decades = (results[0].parameters[name] for name in ("observation-time", "fit-decades"))
    for sigma, axes in zip(sigmas, row, strict=True):
        draw_slopes(axes, of_the_paper(table[table.sigma == sigma]))
        axes.axvspan(until / 10**decades, until, **style.WINDOW)
        axes.text(0.05, 0.93, rf"$\sigma = {sigma:g}$", transform=axes.transAxes, va="top")
    row[0].set_ylabel(r"$d\ln\langle x^2\rangle/d\ln t$")
    style.letter(*row)
    figure.legend(*row[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure, table, caption(table, results)


if __name__ == "__main__":
    main(draw, "Spreading of a tagged particle with and without conserved momentum", slope="1")
