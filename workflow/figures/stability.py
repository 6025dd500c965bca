"""Numerical stability: drift of energy and momentum against the number of collisions and towards |σ| = 1, and
persistence over thirty orders of magnitude of the spacing.

The drifts are those of closed chains, which conserve both: relative changes from the start to the end of a
replica, mean of the magnitudes over replicas. Independent rounding errors grow as the square root of the
number of collisions.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, format_number, parameters, scientific
from workflow.lib.figure import Parts, plots
from workflow.lib.load import Result

TITLE = "Numerical stability"
UNITS = {"collisions": "1"}

COLLISIONS, MASSES = "collisions", "mass-ratio"
SCALES = ("tiny", "small", "one", "large", "huge")
LOOKS = [("o", style.BLACK), ("s", style.BLUE), ("^", style.VERMILLION), ("v", style.ORANGE)]
DRIFTS = ["energy_drift", "momentum_drift"]


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run. collisions: mean number in a replica."""
    rows = []
    for result in results:
        row = {name: result.parameters[name] for name in ("sigma", "cell-length", "observation-time")}
        row |= {"part": result.series, "collisions": result.provenance["events"] / result.replicas}
        rows.append(row | result.columns("mu", *DRIFTS))
    return pd.DataFrame(rows)


def draw_drifts(axes: Axes, x: pd.Series, part: pd.DataFrame, look: tuple[str, str], label: str) -> None:
    """Plots the drift of energy as full symbols and that of momentum as open ones."""
    for drift, face, text in zip(DRIFTS, (None, "white"), (label, None), strict=True):
        axes.errorbar(x, part[drift], part[f"{drift}_error"], **style.points(*look, face, label=text))


def draw_collisions(axes: Axes, table: pd.DataFrame) -> None:
    for (sigma, part), look in zip(table.groupby("sigma"), LOOKS, strict=False):
        ordered = part.sort_values("collisions")
        draw_drifts(axes, ordered.collisions, ordered, look, rf"$\sigma = {sigma:g}$")
    through = np.exp(np.mean(np.log(table.energy_drift / np.sqrt(table.collisions))))
    ends = np.array([table.collisions.min(), table.collisions.max()])
    axes.plot(ends, through * np.sqrt(ends), **style.GUIDE)
    axes.set(xscale="log", yscale="log", xlabel="collisions in a replica", ylabel="relative drift")
    axes.legend(loc="upper left")


def draw_masses(axes: Axes, table: pd.DataFrame) -> None:
    for (above, part), look in zip(table.groupby(table.sigma > 0), LOOKS[1:3], strict=True):
        draw_drifts(axes, 1 - part.sigma.abs(), part, look, rf"$\sigma {'>' if above else '<'} 0$")
    axes.set(xscale="log", yscale="log", xlabel=r"$1 - |\sigma|$", ylabel="relative drift")
    axes.legend(loc="upper right")


def draw_scales(axes: Axes, table: pd.DataFrame) -> None:
    axes.errorbar(table["cell-length"], table.mu, table.mu_error, **style.points("o", style.BLACK))
    axes.axhline(table.mu.mean(), **style.GUIDE)
    axes.set(xscale="log", xlabel=r"spacing $\lambda$", ylabel=r"persistence $\mu$")
    axes.margins(y=1)


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    scales = table[table.part.isin(SCALES)]
    orders = np.log10(scales["cell-length"].max() / scales["cell-length"].min())
    return f"""
        In up to {scientific(table.collisions.max())} collisions rounding errors change the conserved energy (full symbols) of closed chains ({parameters(results, "cells", "particles-per-cell")}) by at
        most {scientific(table.energy_drift.max())} of itself, their momentum (open symbols) by {scientific(table.momentum_drift.max())}. (a) The dashed line shows a square root. (b) Scatterers
        become infinitely light or heavy towards σ = ±1. (c) The spacing covers {orders:.0f} orders of magnitude, at σ = {format_number(scales.sigma.iloc[0])}. {ERRORS}"""


@plots("collisions mass-ratio tiny small one large huge")
def draw(results: Sequence[Result]) -> Parts:
    table = tabulate(results)
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(3 * style.COLUMN, style.HEIGHT))
    draw_collisions(left, table[table.part == COLLISIONS])
    draw_masses(middle, table[table.part == MASSES])
    draw_scales(right, table[table.part.isin(SCALES)])
    style.letter(left, middle, right)
    return figure, table, caption(table, results)
