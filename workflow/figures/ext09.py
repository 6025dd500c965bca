"""Ext. 9: heat conductivity against the number of cells at the paper's spacing 1/N and at fixed spacings.

At 1/N the gas thins out as the chain grows; at a fixed spacing the particles per cell are the same for every N, so
that N goes to infinity in the thermodynamic limit.
"""

from collections.abc import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.typing import LineStyleType

from workflow.lib import style
from workflow.lib.caption import ERRORS, baths, listed, parameters, replicas
from workflow.lib.conductivity import LOOKS, by_spacing, spacings, tabulate
from workflow.lib.figure import Drawn, run
from workflow.lib.growth import POWER, Growth, fits, widest
from workflow.lib.load import Result

THINNING = "thinning"  # the gas that has no thermodynamic limit
LEVEL = 0.01  # p-value below which a law is rejected
CUBE_ROOT = "N^(1/3)"
# Name of each law in captions, and its label in the legend of panel (c), where no power law is plotted.
LAWS = {
    CUBE_ROOT: ("cube root", "$a + bN^{1/3}$"),
    "logarithm": ("logarithm", r"$a + b\,\ln N$"),
    "constant": ("saturation", "saturation, $a + bN^{-1/3}$"),
    POWER: ("power law", ""),
}
LINES: dict[str, LineStyleType] = {CUBE_ROOT: "solid", "logarithm": "dashed", "constant": "dotted"}
ABOVE = 14  # height in points of the axis of N above panel (b)


def laws(part: pd.DataFrame) -> pd.DataFrame:
    """Fits of all laws to the sizes of one spacing: one row per law and smallest size in the fit."""
    growths = [
        growth
        for first in part.cells
        for growth in fits(part.cells, part.kappa, part.kappa_error, float(first))
    ]
    return pd.DataFrame(
        [vars(growth) | {"p_value": growth.p_value, "criterion": growth.criterion} for growth in growths]
    )


def cube_root(part: pd.DataFrame) -> Growth | None:
    """a + b N^(1/3) over the sizes for which it is not rejected."""
    return widest(part.cells, part.kappa, part.kappa_error, CUBE_ROOT, LEVEL)


def rejected(part: pd.DataFrame, first: float) -> str:
    """Text with the laws that are rejected by the sizes from `first` on."""
    names = [
        LAWS[growth.law][0]
        for growth in fits(part.cells, part.kappa, part.kappa_error, first)
        if growth.p_value < LEVEL
    ]
    return listed(names) if names else "no other law"


def slopes(part: pd.DataFrame) -> pd.DataFrame:
    """dκ/d(N^(1/3)) between neighbouring sizes, at their geometric mean, with the slopes of the laws fitted to all sizes."""
    size, value, error = (part[name].to_numpy(dtype=float) for name in ("cells", "kappa", "kappa_error"))
    step = np.diff(np.cbrt(size))
    columns = {"between": np.sqrt(size[1:] * size[:-1]), "slope": np.diff(value) / step}
    columns["slope_error"] = np.hypot(error[1:], error[:-1]) / step
    for growth in fits(size, value, error, size[0]):
        if growth.law in LINES:
            columns[f"slope_{growth.law}"] = np.diff(growth.predicted) / step
    return pd.DataFrame(columns, part.index[:-1])


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


def draw_slopes(axes: Axes, table: pd.DataFrame) -> None:
    """Plots the slope of kappa against N^(1/3), which is constant for a + b N^(1/3). Lines: slopes of the laws fitted at the fixed spacings."""
    for name, part in table.groupby("gas", sort=False):
        local = slopes(part)
        axes.errorbar(local.between, local.slope, local.slope_error, **style.points(*LOOKS[name]))
        for law, dashes in LINES.items():
            if name != THINNING and f"slope_{law}" in local:
                look: style.Look = {"color": LOOKS[name][1], "linestyle": dashes, "linewidth": 0.8}
                axes.plot(local.between, local[f"slope_{law}"], zorder=1, **look)
    style.against_size(axes)
    axes.set(yscale="log", ylabel=r"$d\kappa/d(N^{1/3})$")
    axes.set_ylim(bottom=0.3 * axes.get_ylim()[0])  # space for the legend
    style.label_within_decades(axes.yaxis)
    handles = [
        Line2D([], [], color="grey", linestyle=dashes, label=LAWS[law][1]) for law, dashes in LINES.items()
    ]
    axes.legend(handles=handles, loc="lower left")


def draw_cube_roots(axes: Axes, table: pd.DataFrame) -> None:
    """Plots kappa against N^(1/3), with a + b N^(1/3) over the sizes for which this law is not rejected."""
    for name, part in table.groupby("gas", sort=False):
        size = np.cbrt(part.cells)
        axes.errorbar(size, part.kappa, part.kappa_error, **style.points(*LOOKS[name]))
        if held := cube_root(part):
            axes.plot(size[part.cells >= held.first], held.predicted, color=LOOKS[name][1])
    above = axes.secondary_xaxis("top", functions=(lambda x: np.power(x, 3), np.cbrt))
    above.set_xticks([size for size in (16, 64, 256, 1024, 8192) if size <= table.cells.max()])
    axes.tick_params(axis="x", which="both", top=False)
    axes.set(xlabel="$N^{1/3}$", ylabel=r"conductivity $\kappa$", ylim=(0, None))
    above.set_xlabel("$N$", labelpad=1)


def caption(table: pd.DataFrame, results: Sequence[Result], spacing: Mapping[str, str]) -> str:
    ranges = [
        f"from N = {law.first:.0f} on at λ = {spacing[name]} ({rejected(part, law.first)} rejected)"
        for name, part in table.groupby("gas", sort=False)
        if (law := cube_root(part))
    ]
    held = listed(ranges) if ranges else "nowhere"
    return f"""
        Heat conductivity κ = −J_U N/(T_N − T_1) of open chains at the paper's λ = 1/N, where the gas thins out, and at
        fixed λ; {parameters(results, "gamma", "sigma")}, {baths(results[0])}, {replicas(results)}.
        (b) Lines: a + bN^(1/3) where it is not rejected at the {100 * LEVEL:.0f} % level: {held}. (c) Slope of (b) between neighbouring
        sizes, constant if κ = a + bN^(1/3); lines: laws fitted to all sizes. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    table, spacing = tabulate(results), spacings(results)
    figure, panels = plt.subplot_mosaic(
        [["powers", "roots"], ["powers", "slopes"]],
        figsize=(1.9 * style.COLUMN, 1.5 * style.HEIGHT),
        height_ratios=[1, 1.3],
    )
    draw_powers(panels["powers"], table, spacing)
    draw_cube_roots(panels["roots"], table)
    draw_slopes(panels["slopes"], table)
    style.letter(panels["powers"], panels["roots"], lift=ABOVE)
    style.letter(panels["slopes"], start="c")
    local = pd.concat([slopes(part) for _, part in table.groupby("gas")])
    fitted = [laws(part).assign(gas=name) for name, part in table.groupby("gas", sort=False)]
    rows = pd.concat(fitted).drop(columns="predicted").rename(columns={"first": "fitted_from"})
    return figure, by_spacing(pd.concat([table.join(local), rows]), spacing), caption(table, results, spacing)


if __name__ == "__main__":
    names = ("fitted_from", "chi_square", "freedom", "parameters", "exponent", "p_value", "criterion")
    conductivities = ("kappa_baths", "slope", *(f"slope_{law}" for law in LINES))
    units = dict.fromkeys((*names, "between"), "1")
    units |= dict.fromkeys(conductivities, "energy/(time temperature)")
    run(draw, "Heat conductivity at fixed spacing and at the spacing 1/N", **units)
