"""Fig. 3, inset: finite chains against the Boltzmann equation, for the particles that leave the chain.

F_N(p, 0) for p < 0 and F_N(p, 1) for p > 0, both averaged over the bins, minus F, which integrates to 1 in a
chain without correlations. Lines: the mean field, the Boltzmann equation of N scatterers.
"""

from collections.abc import Sequence
from itertools import cycle

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, plots, require
from workflow.lib.load import Result
from workflow.lib.text import format_with_error, listed
from workflow.physics.fluxes import MEAN_FIELD, SIMULATION, amplitudes, at_centre, deviations, reach

TITLE = "Deviation of finite chains from the Boltzmann equation"
UNITS = dict.fromkeys(("deviation", "error", "amplitude", "amplitude_error", "centre"), "1/momentum")

BOUND, OF_LONGEST = 0.1, 0.01  # of the deviation in the paper, in %
UNIT = r"%, at $\int F\,dp = 1$"


def draw_end(axes: Axes, table: pd.DataFrame, sign: int, shown: float, title: str) -> None:
    """Plots the particles that leave at one end: points from simulations, lines from the mean field."""
    half = table[(np.sign(table.momentum) == sign) & (table.momentum.abs() < shown)]
    looks = zip(cycle(style.SEQUENCE), cycle(style.DASHES), cycle(style.LOOKS), strict=False)
    for (size, rows), (color, dashes, (marker, _)) in zip(half.groupby("cells"), looks, strict=False):
        points, line = (rows[rows.kind == kind] for kind in (SIMULATION, MEAN_FIELD))
        look = style.points(marker, color, markersize=2.5, capsize=0, label=f"$N = {size}$")
        axes.errorbar(points.momentum, 100 * points.deviation, 100 * points.error, **look)
        axes.plot(line.momentum, 100 * line.deviation, color=color, linestyle=dashes, linewidth=0.8)
    axes.axhline(0, **style.GUIDE)
    axes.set(xlabel="momentum $p$", title=title, xlim=sorted((0, sign * shown)))


def draw_decay(axes: Axes, table: pd.DataFrame) -> None:
    """Plots the amplitude of the deviation against N, with the paper's bounds."""
    points, line = amplitudes(table), at_centre(table)
    look = style.points("o", style.BLUE, label=SIMULATION)
    axes.errorbar(points.cells, 100 * points.amplitude, 100 * points.error, **look)
    axes.plot(line.index, 100 * line, color=style.BLACK, label=MEAN_FIELD)
    style.against_size(axes, points.cells)
    axes.set_yscale("log")
    axes.margins(y=0.2)  # room for the legend
    style.guide_at(axes, BOUND, "bound")
    style.guide_at(axes, OF_LONGEST, f"bound,\n$N = {points.cells.max()}$")
    axes.set(ylabel=f"$|F_N - F|$ in {UNIT}")
    axes.legend(loc="lower left", bbox_to_anchor=(0, 0.2))


def caption(table: pd.DataFrame) -> str:
    largest = listed(
        f"{format_with_error(100 * row.amplitude, 100 * row.error)} % at N = {row.cells}"
        for row in amplitudes(table).iloc[[0, -1]].itertuples()
    )
    text = f"""The paper finds F_N − F, chain minus Boltzmann equation, below {BOUND} %, and {OF_LONGEST} % in
        the longest chain, if F integrates to 1. (a), (b) Outgoing particles (points); lines: mean field.
        (c) As p → 0: {{largest}}."""
    return fill(text, largest=largest)


@plots("simulation continuum mean-field")
def draw(results: Sequence[Result]) -> Parts:
    require("the Boltzmann equation", results)
    table = deviations(results)
    size = (1.1 * style.COLUMN, 1.8 * style.HEIGHT)
    figure, panels = plt.subplot_mosaic([["left", "right"], ["decay", "decay"]], figsize=size)
    shown = reach(next(result["flux"] for result in results if result.parameters["cells"] == "continuum"))
    draw_end(panels["left"], table, -1, shown, "left end, $x = 0$")
    draw_end(panels["right"], table, 1, shown, "right end, $x = 1$")
    panels["left"].set_ylabel(f"$F_N - F$ in {UNIT}")
    panels["left"].legend(loc="upper left", handletextpad=0.2)
    draw_decay(panels["decay"], table)
    style.letter(*panels.values())
    whole = amplitudes(table).rename(columns={"error": "amplitude_error"})
    return figure, table.merge(whole, on="cells").join(at_centre(table), on="cells"), caption(table)
