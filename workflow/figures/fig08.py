"""Fig. 8: heat conductivity against the number of cells, and local exponents d ln kappa / d ln N between
neighbouring sizes, which are constant where a power law holds.

Line: mean field, the Boltzmann equation of N scatterers. Points whose window is not stationary, or whose run
stopped before its target, are crossed out and not used.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, holds, plots
from workflow.lib.fit import local_exponents
from workflow.lib.load import Result
from workflow.lib.text import format_with_error
from workflow.physics import run_parameters

TITLE = "Heat conductivity against the size of the chain"
COLUMNS = (
    "kappa",
    "kappa_heat",
    "energy_current",
    "particle_current",
    "temperature_first",
    "temperature_last",
)
EXPONENTS = {"kappa": "exponent_to_next", "kappa_heat": "heat_exponent_to_next"}
UNITS = dict.fromkeys((*EXPONENTS.values(), "mean_field_exponent_to_next"), "1")
UNITS |= {"mean_field_kappa": "energy/(time temperature)"}

APART = 1.06  # factor of N between filled and open symbols
BELOW = 0.7  # ratio of a guide to the lowest point
GUIDES = {"N": (1 / 3, "$N^{1/3}$", "1/3"), "1": (1, "$N$", "1")}  # the paper's exponents by gamma


def mean_field(results: Sequence[Result]) -> pd.DataFrame:
    """kappa in mean field and its local exponents, one row per size, sorted by N."""
    rows = []
    for result in results:
        row = {"gamma": run_parameters.gamma(result), "cells": int(result.parameters["cells"])}
        rows.append(row | {"mean_field_kappa": float(result["kappa"].mean)})
    columns = ["gamma", "cells", "mean_field_kappa"]
    table = pd.DataFrame(rows, columns=columns).sort_values("cells", ignore_index=True)
    middle, slope, _ = local_exponents(table.cells, table.mean_field_kappa, 0 * table.cells)
    return table.assign(middle=middle, mean_field_exponent_to_next=slope)


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, sorted by N, with the local exponent from every sound size to the next.
    Neighbouring exponents have a size in common."""
    rows: list[dict[str, Any]] = []
    for result in results:
        row = {"gamma": run_parameters.gamma(result), "cells": int(result.parameters["cells"])}
        rows.append(row | {"usable": result.usable} | result.columns(*COLUMNS))
    table = pd.DataFrame(rows).sort_values("cells", kind="stable", ignore_index=True)
    for name, exponent in EXPONENTS.items():
        columns = ["between", exponent, f"{exponent}_error"]
        table[columns] = np.nan  # stays NaN if fewer than two sizes are usable
        for _, part in table[table.usable].groupby("gamma", sort=False):
            local = local_exponents(part.cells, part[name], part[f"{name}_error"])
            table.loc[part.index, columns] = np.transpose(local)
    return table


def draw_guide(axes: Axes, part: pd.DataFrame, slope: float, name: str) -> None:
    """Plots the paper's power law below the points."""
    power = part.cells**slope
    guide = BELOW * (part.kappa / power).min() * power
    axes.plot(part.cells, guide, **style.GUIDE)
    style.name_point(axes, name, (part.cells.iloc[-1], guide.iloc[-1]), (4, 0), va="center")


def caption(table: pd.DataFrame) -> str:
    """With the largest and the last local exponent of the largest gamma."""
    gamma = max(table.gamma, default="N")  # N is after any digit
    known = table[table.gamma == gamma].dropna(subset="exponent_to_next")
    texts = [*map(format_with_error, known.exponent_to_next, known.exponent_to_next_error)]
    text = """The paper finds that κ grows as N^(1/3) at γ = N and as N at γ = 1 (grey, not fits). Here κ
        is −J_U N/(T_N − T_1), with convection. Mean field: without correlations. (b) Local exponents; at
        γ = {gamma} at most {largest}, and {last} in the end. Open symbols, shifted: heat J_U − T J_n
        alone."""
    largest = texts[int(known.exponent_to_next.argmax())] if texts else None
    return fill(text, gamma=gamma, largest=largest, last=texts[-1] if texts else None)


@plots("deterministic deterministic-large rare rare-small mean-field")
def draw(results: Sequence[Result]) -> Parts:
    shown = [result for result in results if result.provenance["program"] == "conductivity"]
    table = tabulate(shown)
    elastic = holds(shown)
    theory = mean_field([one for one in results if elastic and one.provenance["program"] == "boltzmann"])
    figure, (above, below) = style.stacked(2, 1.2, height=1.6)
    looks = style.by_gamma(table.gamma)
    for gamma, part in table.groupby("gamma", sort=False):
        look = style.points(*looks[gamma])
        if gamma in GUIDES:
            slope, power, text = GUIDES[gamma]
            draw_guide(above, part, slope, power)
            style.guide_at(below, slope, text)
        above.errorbar(part.cells, part.kappa, part.kappa_error, label=rf"$\gamma = {gamma}$", **look)
        below.errorbar(part.between, part.exponent_to_next, part.exponent_to_next_error, **look)
        heat, error = part.heat_exponent_to_next, part.heat_exponent_to_next_error
        below.errorbar(APART * part.between, heat, error, **style.points(*looks[gamma], "white"))
    for gamma, line in theory.groupby("gamma"):
        color, label = looks.get(gamma, ("", style.BLACK))[1], rf"$\gamma = {gamma}$, mean field"
        above.plot(line.cells, line.mean_field_kappa, "--", color=color, label=label)
        below.plot(line.middle, line.mean_field_exponent_to_next, "--", color=color)
    style.cross_out(above, table.cells, table.kappa, ~table.usable)
    style.against_size(below, table.cells)
    above.set(yscale="log", ylabel=rf"conductivity $\kappa$ ({style.UNIT_SYSTEM})")
    below.set_ylabel(r"$d\ln\kappa/d\ln N$")
    above.margins(x=0.13)  # room for the names of the guides
    above.plot([], [], "o", color="grey", markerfacecolor="white", label="open (b): heat alone")
    handles, labels = above.get_legend_handles_labels()
    figure.legend(handles[::-1], labels[::-1], loc="outside upper left", ncols=2)
    whole = table.drop(columns="between").merge(theory.drop(columns="middle"), "left", ["gamma", "cells"])
    return figure, whole, caption(table)
