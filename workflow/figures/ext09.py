"""Ext. 9: heat conductivity against the number of cells at the paper's spacing 1/N and at fixed spacings.

At 1/N the gas thins out as the chain grows; at a fixed spacing the particles per cell are the same for every N, so
that N goes to infinity in the thermodynamic limit.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from workflow.lib import style
from workflow.lib.caption import ERRORS, baths, listed, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import with_error
from workflow.lib.growth import POWER, Growth, fits, widest
from workflow.lib.load import Result

LOOKS = {
    "thinning": ("o", style.BLACK),
    "dilute": ("s", style.VERMILLION),
    "dense": ("^", style.BLUE),
}  # by gas
LEVEL = 0.01  # p-value below which a law is rejected
CUBE_ROOT = "N^(1/3)"
LAWS = {
    "constant": "$a + bN^{-1/3}$",
    "logarithm": r"$a + b\,\ln N$",
    POWER: "$aN^b$",
}  # beside the cube root
LINES = dict(zip(LAWS, style.DASHES[4:1:-1], strict=True))
ABOVE = 14  # points that the axis of N takes above (b)


def gas(result: Result) -> str:
    """How the gas behaves as the chain grows, by the name of the run."""
    return result.run.partition("_")[0].partition("-")[0]


def spacings(results: Sequence[Result]) -> dict[str, str]:
    """Spacing of every gas, as in the configuration."""
    return {gas(result): style.spacing(result)[1] for result in results}


def by_spacing(table: pd.DataFrame, spacing: Mapping[str, str]) -> pd.DataFrame:
    """The published table, with the spacing in place of the name of the gas."""
    return table.assign(gas=table.gas.map(spacing)).rename(columns={"gas": "spacing"})


def drop_per_cell(result: Result) -> float:
    """Drop of the temperature per cell, from the left bath to the right one."""
    left, right = result.ends("temperature")
    return (left - right) / int(result.parameters["cells"])


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, sorted by N. kappa_baths has the temperatures of the baths in place of T_1 and T_N."""
    rows = []
    for result in results:
        row: dict[str, Any] = {"gas": gas(result), "cells": int(result.parameters["cells"])}
        row |= result.columns("kappa", "kappa_particle", "energy_current", "particle_current")
        per_current = 1 / drop_per_cell(result)
        row["kappa_baths"] = per_current * row["energy_current"]
        row["kappa_baths_error"] = abs(per_current) * row["energy_current_error"]
        row["usable"] = result.sound
        rows.append(row)
    return pd.DataFrame(rows).sort_values("cells", ignore_index=True)


def laws(part: pd.DataFrame) -> pd.DataFrame:
    """Every law fitted to the sizes of one spacing from every size on that leaves a degree of freedom."""
    found = [
        one for first in part.cells for one in fits(part.cells, part.kappa, part.kappa_error, float(first))
    ]
    return pd.DataFrame([vars(one) | {"p_value": one.p_value, "criterion": one.criterion} for one in found])


def cube_root(part: pd.DataFrame) -> Growth | None:
    """a + b N^(1/3) over the sizes for which it is not rejected."""
    return widest(part.cells, part.kappa, part.kappa_error, CUBE_ROOT, LEVEL)


def rival(part: pd.DataFrame, first: float) -> str:
    """What the sizes from the first on say of a power law."""
    (power,) = (one for one in fits(part.cells, part.kappa, part.kappa_error, first) if one.law == POWER)
    if power.p_value < LEVEL:
        return "is"
    return f"with exponent {with_error(power.exponent, power.exponent_error)} is not either"


def draw_powers(axes: Axes, table: pd.DataFrame, spacing: Mapping[str, str]) -> None:
    for name, part in table.groupby("gas", sort=False):
        look = style.points(*LOOKS[name], label=rf"$\lambda = {spacing[name]}$")
        axes.errorbar(part.cells, part.kappa, part.kappa_error, **look)
        style.cross_out(axes, part.cells, part.kappa, ~part.usable)
    size = np.array([table.cells.min(), table.cells.max()], dtype=float)
    guide = 0.5 * table.kappa.min() * (size / size[0]) ** (1 / 3)
    axes.plot(size, guide, **style.GUIDE)
    axes.text(size[1], 0.86 * guide[1], "$N^{1/3}$", size=8, ha="right", va="top")
    style.against_size(axes)
    axes.set(yscale="log", ylabel=rf"conductivity $\kappa$ ({style.UNITS})")
    style.label_within_decades(axes.yaxis)
    axes.legend(loc="upper left")


def draw_departures(axes: Axes, table: pd.DataFrame) -> None:
    """kappa over a + b N^(1/3), minus 1, over the sizes for which that is not rejected; the other laws, fitted to the same sizes."""
    for name, part in table.groupby("gas", sort=False):
        if (held := cube_root(part)) is None:
            continue
        used, expected = part[part.cells >= held.first], np.array(held.predicted)
        size = np.cbrt(used.cells)
        departure, error = 100 * (used.kappa / expected - 1), 100 * used.kappa_error / expected
        axes.errorbar(size, departure, error, **style.points(*LOOKS[name]))
        for one in fits(part.cells, part.kappa, part.kappa_error, held.first):
            if one.law in LAWS:
                rival = 100 * (np.array(one.predicted) / expected - 1)
                axes.plot(size, rival, color=LOOKS[name][1], linestyle=LINES[one.law], linewidth=0.8)
    axes.axhline(0, **style.GUIDE)
    axes.set(xlabel="$N^{1/3}$", ylabel="deviation / %")
    handles = [Line2D([], [], color="grey", linestyle=LINES[law], label=name) for law, name in LAWS.items()]
    axes.legend(handles=handles, loc="lower left")


def draw_cube_roots(axes: Axes, table: pd.DataFrame) -> None:
    """kappa against N^(1/3), with a + b N^(1/3) over the sizes for which that is not rejected."""
    for name, part in table.groupby("gas", sort=False):
        size = np.cbrt(part.cells)
        axes.errorbar(size, part.kappa, part.kappa_error, **style.points(*LOOKS[name]))
        if held := cube_root(part):
            axes.plot(size[part.cells >= held.first], held.predicted, color=LOOKS[name][1])
    above = axes.secondary_xaxis("top", functions=(lambda x: np.power(x, 3), np.cbrt))
    above.set_xticks([size for size in (16, 64, 256, 1024, 8192) if size <= table.cells.max()])
    axes.tick_params(axis="x", which="both", top=False)
    axes.set(ylabel=r"conductivity $\kappa$", ylim=(0, None))
    above.set_xlabel("$N$", labelpad=1)


def caption(table: pd.DataFrame, results: Sequence[Result], spacing: Mapping[str, str]) -> str:
    found = [
        f"from N = {law.first:.0f} on at λ = {spacing[name]}, where a power law {rival(part, law.first)}"
        for name, part in table.groupby("gas", sort=False)
        if (law := cube_root(part))
    ]
    held = f"It is not rejected {listed(found)}" if found else "It is rejected everywhere"
    return f"""
        Heat conductivity κ = −J_U N/(T_N − T_1) of open chains at the paper's spacing λ = 1/N, where the gas thins out, and at
        fixed λ; {parameters(results, "gamma", "sigma")}, {baths(results[0])}, {replicas(results)}.
        (b) Lines: a + b N^(1/3) where it is not rejected at the
        {100 * LEVEL:.0f} % level. (c) Deviation from it; lines: other laws fitted to these sizes. {held}. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    table, spacing = tabulate(results), spacings(results)
    figure, panels = plt.subplot_mosaic(
        [["powers", "roots"], ["powers", "departures"]],
        figsize=(1.9 * style.COLUMN, 1.4 * style.HEIGHT),
        height_ratios=[1.2, 1],
    )
    panels["departures"].sharex(panels["roots"])
    panels["roots"].tick_params(labelbottom=False)
    draw_powers(panels["powers"], table, spacing)
    draw_cube_roots(panels["roots"], table)
    draw_departures(panels["departures"], table)
    style.letter(panels["powers"], panels["roots"], lift=ABOVE)
    style.letter(panels["departures"], start="c")
    fitted = [laws(part).assign(gas=name) for name, part in table.groupby("gas", sort=False)]
    rows = pd.concat(fitted).drop(columns="predicted").rename(columns={"first": "fitted_from"})
    return figure, by_spacing(pd.concat([table, rows]), spacing), caption(table, results, spacing)


if __name__ == "__main__":
    names = ("fitted_from", "chi_square", "freedom", "parameters", "exponent", "p_value", "criterion")
    units = dict.fromkeys(names, "1") | {"kappa_baths": "energy/(time temperature)"}
    run(draw, "Heat conductivity at fixed spacing and at the spacing 1/N", **units)
