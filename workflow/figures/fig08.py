"""Fig. 8: heat conductivity against the number of cells, and local exponents d ln kappa / d ln N between neighbouring sizes,
which are constant where a power law holds.

Beside the paper's drive a stronger one at the same spacing, whose errors are smaller (ext. 9). The mean field is the kinetic
equation of N scatterers. Points whose window is not stationary, or whose run stopped before its target, are crossed out and
not used.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.figures.ext09 import gas
from workflow.lib import style
from workflow.lib.caption import ERRORS, baths, number, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import with_error
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result

BELOW = 0.7  # factor by which guides lie below the lowest point
GUIDES = {"N": (1 / 3, r"$N^{1/3}$", "1/3"), 1: (1, "$N$", "1")}  # the paper's exponents by gamma
STRONG = style.points("^", style.ORANGE, "white")


def drive(result: Result) -> float:
    """Ratio of the baths' temperatures."""
    left, right = result.ends("temperature")
    return round(right / left, 2)


def mean_field(results: Sequence[Result]) -> pd.DataFrame:
    """kappa in mean field, sorted by N."""
    rows = []
    for result in results:
        if result.provenance["program"] == "boltzmann":
            cells, temperature = int(result.parameters["cells"]), result["temperature_scatterer"].mean
            kappa = -float(result["energy_current"].mean) * cells / (temperature[-1] - temperature[0])
            row = {"gamma": "N", "cells": cells, "drive": drive(result), "mean_field_kappa": kappa}
            rows.append(row)
    return pd.DataFrame(rows).sort_values("cells")


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, sorted by N, with the local exponent from every sound size to the next; neighbours share a size."""
    rows = []
    for result in results:
        row = {"gamma": result.parameters["gamma"], "cells": result.parameters["cells"]}
        row["drive"] = drive(result)
        row |= result.columns("kappa", "kappa_particle", "kappa_plain", "kappa_printed", "energy_current")
        row["usable"] = result.sound
        rows.append(row)
    table = pd.DataFrame(rows).sort_values("cells", ignore_index=True)
    columns = ["between", "exponent_to_next", "exponent_to_next_error"]
    table[columns] = np.nan  # where fewer than two sizes are usable
    for _, part in table[table.usable].groupby(["gamma", "drive"]):
        local = local_exponents(part.cells, part.kappa, part.kappa_error)
        for column, values in zip(columns, local, strict=True):
            table.loc[part.index[:-1], column] = values
    return table


def draw_guide(axes: Axes, part: pd.DataFrame, slope: float, name: str) -> None:
    """The paper's power law, below the points."""
    power = part.cells**slope
    guide = BELOW * (part.kappa / power).min() * power
    axes.plot(part.cells, guide, **style.GUIDE)
    end = (part.cells.iloc[-1], guide.iloc[-1])
    axes.annotate(name, end, (4, 0), textcoords="offset points", size=8, va="center")


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    weak = [one for one in results if drive(one) == table.drive.min()]
    slopes = table.dropna(subset="between")
    pairs = zip(slopes.exponent_to_next, slopes.exponent_to_next_error, strict=True)
    texts = pd.Series([with_error(*pair) for pair in pairs], slopes.index, dtype=str)
    rare, often = (texts[(slopes.gamma == gamma) & (slopes.drive == table.drive.min())] for gamma in (1, "N"))
    strong = texts[slopes.drive > table.drive.min()]

    def one(found: pd.Series, index: int) -> str:
        return str(found.iloc[index]) if len(found) else "an unknown value"

    return f"""
        Heat conductivity κ = −J_U N/(T_N − T_1) of open chains against the number of cells N, {parameters(weak, "cell-length", "sigma")},
        {baths(weak[0])}, {replicas(results)}. Triangles: stronger drive, T_R/T_L = {number(table.drive.max())} (ext. 9). (a) κ; dashed
        grey: the paper's powers of N, blue: mean field, the kinetic equation of N scatterers. (b) Local exponents between neighbouring
        sizes. For γ = 1 the exponent tends to {one(rare, -1)}. For γ = N no single power holds, as the gas thins out: from {one(often, 0)} at the
        smallest sizes the exponent rises above 1/2 and falls to {one(often, -1)} at the largest; {one(strong, -1)} at stronger drive. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    runs = [one for one in results if one.provenance["program"] == "conductivity"]
    runs = [one for one in runs if gas(one) not in ("dilute", "dense")]  # of a fixed spacing
    table, theory = tabulate(runs), mean_field(results)
    size = (2 * style.COLUMN, 1.1 * style.HEIGHT)
    figure, (left, right) = plt.subplots(1, 2, figsize=size, sharex=True)
    weak = table[table.drive == table.drive.min()]
    for gamma, shape in style.BY_GAMMA.items():
        part, look = weak[weak.gamma == gamma], style.points(*shape)
        left.errorbar(part.cells, part.kappa, part.kappa_error, label=rf"$\gamma = {gamma}$", **look)
        right.errorbar(part.between, part.exponent_to_next, part.exponent_to_next_error, **look)
        slope, power, name = GUIDES[gamma]
        draw_guide(left, part, slope, power)
        style.guide_at(right, slope, name)
    strong = table[table.drive > table.drive.min()]
    label = rf"$\gamma = N$, $T_R/T_L = {table.drive.max():g}$"
    left.errorbar(strong.cells, strong.kappa, strong.kappa_error, label=label, **STRONG)
    right.errorbar(strong.between, strong.exponent_to_next, strong.exponent_to_next_error, **STRONG)
    look = {"color": style.BY_GAMMA["N"][1], "linestyle": "dashed", "label": r"$\gamma = N$, mean field"}
    left.plot(theory.cells, theory.mean_field_kappa, **look)
    style.cross_out(left, table.cells, table.kappa, ~table.usable)
    left.set(xscale="log", yscale="log", xlabel="number of cells $N$")
    left.set_ylabel(rf"conductivity $\kappa$ ({style.UNITS})")
    right.set(xlabel="number of cells $N$", ylabel=r"$d\ln\kappa/d\ln N$")
    low, high = left.get_xlim()
    left.set_xlim(low, 1.6 * high)  # room for the names of the guides
    left.legend(loc="upper left")
    style.letter(left, right)
    columns = ["gamma", "cells", "drive"]
    whole = table.drop(columns="between").merge(theory, how="left", on=columns)
    return figure, whole, caption(table, runs)


if __name__ == "__main__":
    units = {"drive": "1", "exponent_to_next": "1", "mean_field_kappa": "energy/(time temperature)"}
    run(draw, "Heat conductivity against the size of the chain", **units)
