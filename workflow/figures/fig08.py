"""Fig. 8: heat conductivity against the number of cells, and local exponents d ln kappa / d ln N between neighbouring sizes,
which are constant where a power law holds.

The runs have the paper's drive, and a stronger one at the same spacing with smaller errors (ext. 9). Control runs have random directions
after collisions, which do not conserve momentum, at the paper's spacing 1/N and at a fixed one. The mean field is the kinetic equation
of N scatterers. Points whose window is not stationary, or whose run stopped before its target, are crossed out and not used.
"""

from collections.abc import Sequence
from itertools import cycle

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, RULES, baths, listed, number, parameters, replicas, rule
from workflow.lib.conductivity import drive, gas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import with_error
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result

BELOW = 0.7  # ratio of a guide to the lowest point
SERIES = ["rule", "gamma", "fixed_spacing", "drive"]  # columns that identify a curve
GUIDES = {"N": (1 / 3, r"$N^{1/3}$", "1/3"), 1: (1, "$N$", "1")}  # the paper's exponents by gamma
STRONG = style.points("^", style.ORANGE, "white")
RANDOM = RULES["random-direction"]
CONTROLS = [
    style.points(marker, color, face)
    for marker, color in (("D", style.GREEN), ("P", style.BLACK))
    for face in ("white", None)
]  # of other rules, at the spacing 1/N and at a fixed one; random directions are first


def mean_field(results: Sequence[Result]) -> pd.DataFrame:
    """kappa in mean field, one row per size, sorted by N."""
    rows = []
    for result in results:
        if result.provenance["program"] == "boltzmann":
            cells, temperature = int(result.parameters["cells"]), result["temperature_scatterer"].mean
            kappa = -float(result["energy_current"].mean) * cells / (temperature[-1] - temperature[0])
            row = {"gamma": "N", "cells": cells, "drive": drive(result), "mean_field_kappa": kappa}
            rows.append(row)
    return pd.DataFrame(rows).sort_values("cells")


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, sorted by N, with the local exponent from every sound size to the next. Neighbouring exponents have a
    size in common."""
    rows = []
    for result in results:
        row = {"rule": rule(result)} | {name: result.parameters[name] for name in ("gamma", "cells")}
        row |= {
            "spacing": style.spacing(result)[1],
            "fixed_spacing": "dense" in result.run,
            "drive": drive(result),
        }
        row |= result.columns("kappa", "kappa_particle", "kappa_plain", "kappa_printed", "energy_current")
        row["usable"] = result.sound
        rows.append(row)
    table = pd.DataFrame(rows).sort_values("cells", kind="stable", ignore_index=True)
    columns = ["between", "exponent_to_next", "exponent_to_next_error"]
    table[columns] = np.nan  # stays NaN if fewer than two sizes are usable
    for _, part in table[table.usable].groupby(SERIES):
        local = local_exponents(part.cells, part.kappa, part.kappa_error)
        for column, values in zip(columns, local, strict=True):
            table.loc[part.index[:-1], column] = values
    return table


def draw_guide(axes: Axes, part: pd.DataFrame, slope: float, name: str) -> None:
    """Plots the paper's power law below the points."""
    power = part.cells**slope
    guide = BELOW * (part.kappa / power).min() * power
    axes.plot(part.cells, guide, **style.GUIDE)
    end = (part.cells.iloc[-1], guide.iloc[-1])
    axes.annotate(name, end, (4, 0), textcoords="offset points", size=8, va="center")


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    elastic = [result for result in results if result.parameters["rule"] == "elastic"]
    weak = [result for result in elastic if drive(result) == table.drive.min()]
    slopes = table.dropna(subset="between")
    pairs = zip(slopes.exponent_to_next, slopes.exponent_to_next_error, strict=True)
    texts = pd.Series([with_error(*pair) for pair in pairs], slopes.index, dtype=str)
    own = slopes.rule == "elastic"
    rare, often = (
        texts[own & (slopes.gamma == gamma) & (slopes.drive == table.drive.min())] for gamma in (1, "N")
    )
    strong = texts[own & (slopes.drive > table.drive.min())]
    random = [
        f"{with_error(*last[['kappa', 'kappa_error']])} at N = {last.cells} (λ = {last.spacing})"
        for _, part in table[table.rule == RANDOM].groupby("fixed_spacing")
        for last in [part.iloc[-1]]
    ]

    def text_at(index: int, values: pd.Series) -> str:
        return str(values.iloc[index]) if len(values) else "an unknown value"

    return f"""
        Heat conductivity κ = −J_U N/(T_N − T_1) of open chains of N cells, {parameters(weak, "cell-length", "sigma")},
        {baths(weak[0])}, {replicas(results)}. Triangles, diamonds: T_R/T_L = {number(table.drive.max())}. (a) κ; grey: the paper's
        powers of N, blue: mean field. (b) Exponents between neighbouring
        sizes: for γ = 1 in the end {text_at(-1, rare)}; for γ = N no single power, {text_at(0, often)} at first, above 1/2 later and
        {text_at(-1, often)} in the end, {text_at(-1, strong)} at the stronger drive. Diamonds: without conserved momentum (random
        directions) κ tends to a constant, {listed(random)}. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    runs = [result for result in results if result.provenance["program"] == "conductivity"]
    runs = [result for result in runs if gas(result) not in ("dilute", "dense")]  # gases at a fixed spacing
    table, theory = tabulate(runs), mean_field(results)
    size = (2 * style.COLUMN, 1.1 * style.HEIGHT)
    figure, (left, right) = plt.subplots(1, 2, figsize=size, sharex=True)

    def draw_points(part: pd.DataFrame, look: style.Look, label: str) -> None:
        left.errorbar(part.cells, part.kappa, part.kappa_error, label=label, **look)
        right.errorbar(part.between, part.exponent_to_next, part.exponent_to_next_error, **look)

    elastic = table[table.rule == "elastic"]
    weak, strong = elastic[elastic.drive == table.drive.min()], elastic[elastic.drive > table.drive.min()]
    for gamma, shape in style.BY_GAMMA.items():
        part = weak[weak.gamma == gamma]
        draw_points(part, style.points(*shape), rf"$\gamma = {gamma}$")
        slope, power, name = GUIDES[gamma]
        draw_guide(left, part, slope, power)
        style.guide_at(right, slope, name)
    draw_points(strong, STRONG, rf"$\gamma = N$, $T_R/T_L = {table.drive.max():g}$")
    look = {"color": style.BY_GAMMA["N"][1], "linestyle": "dashed", "label": r"$\gamma = N$, mean field"}
    left.plot(theory.cells, theory.mean_field_kappa, **look)
    control = table[table.rule != "elastic"].groupby(["rule", "fixed_spacing"])
    for ((name, _), part), look in zip(control, cycle(CONTROLS), strict=False):
        draw_points(part, look, rf"$\gamma = N$, {name}, $\lambda = {part.spacing.iloc[0]}$")
    style.guide_at(right, 0, "0")
    style.cross_out(left, table.cells, table.kappa, ~table.usable)
    left.set(xscale="log", yscale="log", xlabel="number of cells $N$")
    left.set_ylabel(rf"conductivity $\kappa$ ({style.UNITS})")
    right.set(xlabel="number of cells $N$", ylabel=r"$d\ln\kappa/d\ln N$")
    low, high = left.get_xlim()
    left.set_xlim(low, 1.6 * high)  # room for the names of the guides
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    style.letter(left, right)
    columns = ["gamma", "cells", "drive"]
    whole = table.drop(columns="between").merge(theory, how="left", on=columns)
    return figure, whole, caption(table, runs)


if __name__ == "__main__":
    units = {"drive": "1", "exponent_to_next": "1", "mean_field_kappa": "energy/(time temperature)"}
    run(draw, "Heat conductivity against the size of the chain", **units)
