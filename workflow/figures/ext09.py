"""Ext. 9: heat conductivity against the number of cells at the paper's spacing 1/N and at fixed spacings.

At 1/N the gas thins out as the chain grows; at a fixed spacing the particles per cell are the same for every N, so
that N goes to infinity in the thermodynamic limit.
"""

from collections.abc import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from workflow.lib import style
from workflow.lib.caption import BATHS, WINDOW, goodness, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import with_error
from workflow.lib.growth import LAWS, POWER, Growth, fits, widest
from workflow.lib.load import Result

LOOKS = {
    "thinning": ("o", style.BLACK),
    "dilute": ("s", style.VERMILLION),
    "dense": ("^", style.BLUE),
}  # by gas
LEVEL = 0.01  # p-value below which a law is rejected
CUBE_ROOT = "N^(1/3)"
LINES = dict(zip((CUBE_ROOT, POWER, "logarithm", "constant"), style.DASHES[1:], strict=True))
WORDS = {"constant": "a + b N^(-1/3)", "logarithm": "a + b ln N", CUBE_ROOT: "a + b N^(1/3)"}
MATHS = {
    "constant": "$a + bN^{-1/3}$",
    "logarithm": r"$a + b\,\ln N$",
    CUBE_ROOT: "$a + bN^{1/3}$",
    POWER: "$aN^b$",
}
ABOVE = 14  # points that the axis of N takes above (b)


def gas(result: Result) -> str:
    """How the gas behaves as the chain grows, by the name of the run."""
    return result.path.stem.partition("_")[0].partition("-")[0]


def spacings(results: Sequence[Result]) -> dict[str, str]:
    """By gas, as in the configuration."""
    return {gas(result): style.spacing(result)[1] for result in results}


def by_spacing(table: pd.DataFrame, spacing: Mapping[str, str]) -> pd.DataFrame:
    """As it is published: with the spacing in place of the name of the gas."""
    return table.assign(gas=table.gas.map(spacing)).rename(columns={"gas": "spacing"})


def drop_per_cell(result: Result) -> float:
    """Of the temperature, from the left bath to the right one."""
    left, right = (float(result.parameters[f"temperature-{side}"]) for side in ("left", "right"))
    return (left - right) / int(result.parameters["cells"])


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, sorted by N. kappa_baths has the temperatures of the baths in place of T_1 and T_N."""
    rows = []
    for result in results:
        row = {"gas": gas(result), "cells": int(result.parameters["cells"])}
        for name in ("kappa", "kappa_particle", "energy_current", "particle_current"):
            row[name], row[f"{name}_error"] = float(result[name].mean), float(result[name].error)
        per_current = 1 / drop_per_cell(result)
        row["kappa_baths"] = per_current * float(result["energy_current"].mean)
        row["kappa_baths_error"] = abs(per_current) * float(result["energy_current"].error)
        row["usable"] = result.sound
        rows.append(row)
    return pd.DataFrame(rows).sort_values("cells", ignore_index=True)


def laws(part: pd.DataFrame) -> pd.DataFrame:
    """Every law fitted to the sizes of one spacing from every size on that leaves a degree of freedom."""
    found = [
        one for first in part.cells for one in fits(part.cells, part.kappa, part.kappa_error, float(first))
    ]
    return pd.DataFrame([vars(one) | {"p_value": one.p_value, "criterion": one.criterion} for one in found])


def range_of(part: pd.DataFrame, law: str) -> Growth | None:
    return widest(part.cells, part.kappa, part.kappa_error, law, LEVEL)


def sentence(spacing: str, part: pd.DataFrame) -> str:
    """What the fits say about one spacing, in words."""
    held = {law: one for law in (*LAWS, POWER) if (one := range_of(part, law))}
    if not held:
        whole = [one for one in fits(part.cells, part.kappa, part.kappa_error, 0) if one.law == POWER]
        rejected = "; ".join(f"power law: {goodness(one.chi_square, one.freedom)}" for one in whole)
        return f"Spacing {spacing}: no law holds with two degrees of freedom or more ({rejected})."
    start = min(one.first for one in held.values())
    best = min((one for one in held.values() if one.first == start), key=lambda one: one.criterion)
    shown = [best, *(one for one in held.values() if one.law == CUBE_ROOT and one is not best)]
    text = f"Spacing {spacing}: " + ", ".join(
        f"{written(one)} from N = {one.first:.0f} on ({goodness(one.chi_square, one.freedom)})"
        for one in shown
    )
    # The sizes from which on the law of the widest range holds, and every law that holds over any range.
    firsts = sorted({best.first, max(one.first for one in held.values())})
    return "; ".join([text, *(rivals(part, first) for first in firsts)]) + "."


def rivals(part: pd.DataFrame, first: float) -> str:
    """How well every law describes the sizes from the first on, in words."""
    found = fits(part.cells, part.kappa, part.kappa_error, first)
    return f"from N = {first:.0f} on {compared(found)}; not rejected: {', '.join(map(written, kept(found))) or 'none'}"


def kept(found: Sequence[Growth]) -> list[Growth]:
    """Those that are not rejected."""
    return [one for one in found if not one.p_value < LEVEL]


def compared(found: Sequence[Growth]) -> str:
    """chi^2 of laws with as many parameters, fitted to the same sizes, in words."""
    against = ", ".join(f"{one.chi_square:.1f} for {written(one)}" for one in found)
    return f"χ² is, with {found[0].freedom} degrees of freedom, {against}"


def written(growth: Growth) -> str:
    return WORDS.get(growth.law) or f"N^{with_error(growth.exponent, growth.exponent_error)}"


def draw_powers(axes: Axes, table: pd.DataFrame, spacing: Mapping[str, str]) -> None:
    for name, part in table.groupby("gas", sort=False):
        marker, color = LOOKS[name]
        label = rf"$\lambda = {spacing[name]}$"
        look = {"marker": marker, "color": color, **style.POINTS}
        axes.errorbar(part.cells, part.kappa, part.kappa_error, label=label, **look)
        style.cross_out(axes, part.cells.to_numpy(), part.kappa.to_numpy(), ~part.usable.to_numpy())
    size = np.array([table.cells.min(), table.cells.max()], dtype=float)
    guide = 0.5 * table.kappa.min() * (size / size[0]) ** (1 / 3)
    axes.plot(size, guide, **style.GUIDE)
    axes.text(size[1], 0.86 * guide[1], "$N^{1/3}$", size=8, ha="right", va="top")
    axes.set(xscale="log", yscale="log", xlabel="number of cells $N$")
    axes.set(ylabel=rf"conductivity $\kappa$ ({style.UNITS})")
    style.label_sizes(axes.xaxis)
    style.label_within_decades(axes.yaxis)
    axes.legend(loc="upper left")


def draw_departures(axes: Axes, table: pd.DataFrame) -> None:
    """kappa over a + b N^(1/3), minus 1, over the sizes for which that holds; the other laws, fitted to the same sizes."""
    for name, part in table.groupby("gas", sort=False):
        if (held := range_of(part, CUBE_ROOT)) is None:
            continue
        marker, color = LOOKS[name]
        used, expected = part[part.cells >= held.first], np.array(held.predicted)
        size = np.cbrt(used.cells)
        departure, error = 100 * (used.kappa / expected - 1), 100 * used.kappa_error / expected
        axes.errorbar(size, departure, error, marker=marker, color=color, **style.POINTS)
        for one in fits(part.cells, part.kappa, part.kappa_error, held.first):
            if one.law != CUBE_ROOT:
                rival = 100 * (np.array(one.predicted) / expected - 1)
                axes.plot(size, rival, color=color, linestyle=LINES[one.law], linewidth=0.8)
    axes.axhline(0, **style.GUIDE)
    axes.set(xlabel="$N^{1/3}$", ylabel="off " + MATHS[CUBE_ROOT] + " / %")


def draw_cube_roots(axes: Axes, table: pd.DataFrame) -> None:
    """kappa against N^(1/3): straight where it grows as N^(1/3) beside a constant. Every law over the sizes for which it holds."""
    for name, part in table.groupby("gas", sort=False):
        marker, color = LOOKS[name]
        axes.errorbar(
            np.cbrt(part.cells), part.kappa, part.kappa_error, marker=marker, color=color, **style.POINTS
        )
        for law, line in LINES.items():
            if held := range_of(part, law):
                size = part.cells[part.cells >= held.first]
                axes.plot(np.cbrt(size), held.predicted, color=color, linestyle=line)
    above = axes.secondary_xaxis("top", functions=(lambda x: np.power(x, 3), np.cbrt))
    above.set_xticks([size for size in (64, 256, 1024, 2048, 8192) if size <= table.cells.max()])
    axes.tick_params(axis="x", which="both", top=False)
    axes.set(ylabel=r"conductivity $\kappa$", ylim=(0, None))
    above.set_xlabel("$N$", labelpad=1)
    axes.legend(
        handles=[
            Line2D([], [], color=style.BLACK, linestyle=line, label=MATHS[law]) for law, line in LINES.items()
        ],
        loc="upper left",
    )


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table = tabulate(results)
    figure, panels = plt.subplot_mosaic(
        [["powers", "roots"], ["powers", "departures"]],
        figsize=(1.9 * style.COLUMN, 1.4 * style.HEIGHT),
        height_ratios=[1.8, 1],
    )
    panels["departures"].sharex(panels["roots"])
    panels["roots"].tick_params(labelbottom=False)
    spacing = spacings(results)
    draw_powers(panels["powers"], table, spacing)
    draw_cube_roots(panels["roots"], table)
    draw_departures(panels["departures"], table)
    style.letter(panels["powers"], panels["roots"], lift=ABOVE)
    panels["departures"].set_title("(c)", loc="left")
    sentences, tables = [], []
    for name, part in table.groupby("gas", sort=False):
        sentences.append(sentence(spacing[name], part))
        tables.append(laws(part).drop(columns="predicted").assign(gas=name))
    fitted = pd.concat(tables).rename(columns={"first": "fitted_from"})
    options = results[0].parameters
    times = "; ".join(
        f"at spacing {spacing[name]} {parameters([one for one in results if gas(one) == name], *WINDOW)}"
        for name in spacing
    )
    caption = (
        f"Heat conductivity κ = −J_U N/(T_N − T_1) at γ = N, σ = {options['sigma']:g}, between baths "
        f"({parameters(results, *BATHS)}) that press equally hard, {replicas(results)}, started near the stationary profile, {times}: the "
        "largest chains at fixed spacing relax for less than a wrong profile would take, so that they rest on the start (ext. 12 "
        "compares starts and drives; errors here are statistical, and the report's bounds add what a start could still change). At the spacing 1/N the gas thins out as the chain grows; at fixed spacings the "
        "number of particles per cell is the same for every N, but for slow ones, which gather as ln t. (a) Logarithmic axes. (b) Against the cube root of N: "
        "a straight line is growth as N^(1/3) beside a constant. Lines: each law over the sizes for which it is not "
        f"rejected at {LEVEL:.0%}, with two degrees of freedom or more. (c) What κ and the other laws, fitted to the same sizes, are off a + b N^(1/3), where that "
        f"holds; a + b N^(-1/3) has a finite limit. {' '.join(sentences)} What is said of laws is said of this drive alone, and at the largest sizes of this start alone, as "
        "ext. 12 has other starts in shorter chains only. Error bars: standard errors over replicas."
    )
    return figure, by_spacing(pd.concat([table, fitted]), spacing), caption


if __name__ == "__main__":
    pure = dict.fromkeys(
        (
            "fitted_from",
            "chi_square",
            "freedom",
            "parameters",
            "exponent",
            "exponent_error",
            "p_value",
            "criterion",
        ),
        "1",
    )
    baths = dict.fromkeys(("kappa_baths", "kappa_baths_error"), "energy/(time temperature)")
    run(draw, "Heat conductivity at fixed spacing and at the spacing 1/N", **pure, **baths)
