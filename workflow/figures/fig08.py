"""Fig. 8: heat conductivity against the number of cells, and local exponents d ln kappa / d ln N between neighbouring sizes,
which are constant where a power law holds.

The runs have the paper's drive at its spacing 1/N, and a stronger one there and at a fixed spacing (ext. 9); at the latter also with the
control, in which a fraction of the collisions reverses the momentum of the scatterer. Line: mean field, the kinetic equation of N
scatterers. Points whose window is not stationary, or whose run stopped before its target, are crossed out and not used.
"""

from collections.abc import Sequence
from itertools import cycle
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, format_number, parameters, rule
from workflow.lib.figure import Parts, main, plots
from workflow.lib.fit import format_with_error
from workflow.lib.load import Result
from workflow.physics import setting
from workflow.physics.conductivity import drive, gas
from workflow.physics.growth import local_exponents

BELOW = 0.7  # ratio of a guide to the lowest point
CURVE = ["curve", "rule", "epsilon"]  # columns that identify a curve
PAPERS = {"deterministic": "N", "rare": 1}  # γ of the curves at the paper's drive
LONGER = {"large": "deterministic"}  # runs that continue a curve to longer chains
GUIDES = {"N": (1 / 3, r"$N^{1/3}$", "1/3"), 1: (1, "$N$", "1")}  # the paper's exponents by gamma
DRIVEN = {"thinning": style.points("^", style.ORANGE, "white"), "dense": style.points("P", style.BLACK)}
CONTROLS = [
    style.points("D", style.GREEN, "white"),
    style.points("D", style.GREEN),
    style.points("v", style.SKY),
]


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
        row: dict[str, Any] = {"curve": LONGER.get(gas(result), gas(result)), "rule": rule(result)}
        row |= {name: result.parameters[name] for name in ("gamma", "cells")}
        row |= {"spacing": setting.spacing(result)[1], "drive": drive(result), "usable": result.usable}
        rows.append(
            row
            | {"epsilon": setting.epsilon(result)}
            | result.columns("kappa", "kappa_particle", "kappa_plain", "kappa_printed", "energy_current")
        )
    table = pd.DataFrame(rows).sort_values("cells", kind="stable", ignore_index=True)
    columns = ["between", "exponent_to_next", "exponent_to_next_error"]
    table[columns] = np.nan  # stays NaN if fewer than two sizes are usable
    for _, part in table[table.usable].groupby(CURVE):
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


def compared(table: pd.DataFrame, control: float) -> str:
    """Exponents at fixed density with and without conserved momentum, between the largest neighbouring sizes that both have."""
    known = table.dropna(subset="between").set_index(["cells", "between"])
    exponents = [
        known[known.curve == "dense"],
        known[(known.curve == "reversal") & (known.epsilon == control)],
    ]
    common = exponents[0].index.intersection(exponents[1].index)
    if not len(common):
        return "at no common sizes"
    cells, between = common.max()
    elastic, broken = (
        format_with_error(*rows.loc[(cells, between), ["exponent_to_next", "exponent_to_next_error"]])
        for rows in exponents
    )
    return f"{elastic} and {broken} between N = {cells} and {between**2 / cells:.0f}"


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    control = table[table.curve == "reversal"].epsilon.min()
    return f"""
        Conductivity κ = −J_U N/(T_N − T_1) of open chains, {parameters(results, "sigma")}, the paper's baths at λ = 1/N, else T_R/T_L =
        {format_number(table.drive.max())}. (a) Grey: the paper's powers. (b) Exponents between neighbouring sizes. At fixed density (λ =
        {table[table.curve == "dense"].spacing.iloc[0]}), without and with a fraction ε = {format_number(control)} of collisions that break conservation of
        momentum (reversal), {compared(table, control)}. {ERRORS}"""


@plots("deterministic large rare rare-small reversal mean-field thinning thinning-large dense dense-large")
def draw(results: Sequence[Result]) -> Parts:
    shown = [result for result in results if result.provenance["program"] == "conductivity"]
    table, theory = tabulate(shown), mean_field(results)
    size = (2 * style.COLUMN, 1.2 * style.HEIGHT)
    figure, (left, right) = plt.subplots(1, 2, figsize=size, sharex=True)
    controls = cycle(CONTROLS)
    for (curve, name, epsilon), part in table.groupby(CURVE, sort=False):
        first = part.iloc[0]
        if curve in PAPERS:
            look, label = (
                style.points(*style.BY_GAMMA[first.gamma]),
                rf"$\gamma = {PAPERS[curve]}$",
            )
            slope, power, text = GUIDES[first.gamma]
            draw_guide(left, part, slope, power)
            style.guide_at(right, slope, text)
        elif name == "elastic":
            look, label = DRIVEN[curve], rf"$T_R/T_L = {first.drive:g}$, $\lambda = {first.spacing}$"
        else:
            look, label = (
                next(controls),
                rf"$\lambda = {first.spacing}$, $\epsilon = {format_number(epsilon)}$",
            )
        left.errorbar(part.cells, part.kappa, part.kappa_error, label=label, **look)
        right.errorbar(part.between, part.exponent_to_next, part.exponent_to_next_error, **look)
    color = style.BY_GAMMA["N"][1]
    left.plot(
        theory.cells,
        theory.mean_field_kappa,
        color=color,
        linestyle="dashed",
        label=r"$\gamma = N$, mean field",
    )
    style.guide_at(right, 0, "0")
    style.cross_out(left, table.cells, table.kappa, ~table.usable)
    left.set(xscale="log", yscale="log", xlabel="number of cells $N$")
    left.set_ylabel(rf"conductivity $\kappa$ ({style.UNITS})")
    right.set(xlabel="number of cells $N$", ylabel=r"$d\ln\kappa/d\ln N$")
    low, high = left.get_xlim()
    left.set_xlim(low, 1.6 * high)  # room for the names of the guides
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    style.letter(left, right)
    whole = table.drop(columns=["between", "epsilon"]).merge(
        theory, how="left", on=["gamma", "cells", "drive"]
    )
    return figure, whole, caption(table, shown)


if __name__ == "__main__":
    units = {"drive": "1", "exponent_to_next": "1", "mean_field_kappa": "energy/(time temperature)"}
    main(draw, "Heat conductivity against the size of the chain", **units)
