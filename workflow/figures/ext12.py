"""Ext. 12: how the local exponents of ext. 9 depend on the drive, and kappa and the particle current on the start."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.figures.ext09 import by_spacing, spacings, tabulate
from workflow.figures.fig08 import drive
from workflow.lib import style
from workflow.lib.caption import ERRORS, listed, number, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import mean_of
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result

APART = 0.15  # of a place, by which starts are plotted beside each other
WARM = "warm"
LOOKS = [("o", style.BLACK), ("s", style.SKY), ("^", style.VERMILLION)]  # by pair of sizes
STARTS = {
    WARM: ("s", style.BLACK),
    "cold": ("v", style.BLUE),
    "hot": ("^", style.VERMILLION),
    "empty": ("o", style.GREEN),
}
COMPARED = {"kappa": r"\kappa", "particle_current": "J_n"}


def read(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, with its start and its drive, the ratio of the baths' temperatures."""
    rows = [tabulate([one]).assign(start=one.parameters["start"], drive=drive(one)) for one in results]
    return pd.concat(rows).sort_values("cells", ignore_index=True)


def exponents(table: pd.DataFrame) -> pd.DataFrame:
    """Local exponents of every drive between the sizes that all drives have."""
    parts = []
    for name, part in table[table.start == WARM].groupby("gas", sort=False):
        common = set.intersection(*(set(one.cells) for _, one in part.groupby("drive")))
        for ratio, one in part[part.cells.isin(common)].groupby("drive"):
            size, slope, error = local_exponents(one.cells, one.kappa, one.kappa_error)
            smaller, larger = one.cells.to_numpy()[:-1], one.cells.to_numpy()[1:]
            columns = {"size": size, "smaller": smaller, "larger": larger}
            columns |= {"exponent": slope, "exponent_error": error}
            parts.append(pd.DataFrame({"gas": name, "drive": ratio, **columns}))
    return pd.concat(parts, ignore_index=True)


def deviations(table: pd.DataFrame, quantity: str) -> pd.DataFrame:
    """A quantity from every start relative to the mean over the starts, minus 1, at the drive that has several."""
    driven = table[table.drive.isin(table[table.start != WARM].drive)]
    parts = []
    for (name, cells), part in driven.groupby(["gas", "cells"], sort=False):
        if len(part) > 1:
            value, error = part[quantity], part[f"{quantity}_error"]
            mean, *_ = mean_of(value, error)
            found = {"deviation": value / mean - 1, "deviation_error": error / abs(mean)}
            parts.append(part[["start"]].assign(gas=name, cells=cells, quantity=quantity, **found))
    return pd.concat(parts, ignore_index=True)


def draw_exponents(axes: Axes, found: pd.DataFrame, spacing: str) -> None:
    """Of one spacing, against the drive, between each two neighbouring sizes."""
    for (sizes, one), shape in zip(found.groupby(["smaller", "larger"]), LOOKS, strict=False):
        look = style.points(*shape, linestyle=":", label="$N = {:g}$ to {:g}".format(*sizes))
        axes.errorbar(one.drive, one.exponent, one.exponent_error, **look)
    drives = sorted(found.drive.unique())
    axes.set(
        title=rf"$\lambda = {spacing}$", xscale="log", xlim=(drives[0] / 1.4, drives[-1] * 1.4), ylim=(0, 0.7)
    )
    axes.set_xticks(drives, [f"{ratio:g}" for ratio in drives])
    axes.set_xticks([], minor=True)
    axes.set_xlabel("$T_R/T_L$")
    style.guide_at(axes, 1 / 3, "")


def draw_starts(axes: Axes, found: pd.DataFrame, symbol: str) -> None:
    """Of one spacing, one place per size."""
    sizes = sorted(found.cells.unique())
    for rank, (start, shape) in enumerate(STARTS.items()):
        one = found[found.start == start]
        place = np.searchsorted(sizes, one.cells) + APART * (rank - 1.5)
        look = style.points(*shape, label=start)
        axes.errorbar(place, 100 * one.deviation, 100 * one.deviation_error, **look)
    axes.axhline(0, **style.GUIDE)
    axes.set_xticks(range(len(sizes)), [f"{size}" for size in sizes])
    axes.tick_params(axis="x", which="both", length=0)
    axes.set(xlim=(-0.5, len(sizes) - 0.5), ylabel=rf"$\delta {symbol}$ (%)")


def caption(slopes: pd.DataFrame, starts: pd.DataFrame, results: Sequence[Result]) -> str:
    drives = listed(number(ratio) for ratio in sorted(slopes.drive.unique()))
    largest = {name: 100 * part.deviation.abs().max() for name, part in starts.groupby("quantity")}
    kappa, current = (f"{largest[name]:.1f}" for name in COMPARED)
    return f"""
        Heat conductivity κ and particle current J_n of the open chains of ext. 9 for other drives and starts, {parameters(results, "gamma", "sigma")},
        {replicas(results)}. Top: local exponents of κ between neighbouring sizes against the ratio of the baths' temperatures, {drives} at
        equal pressures; dashed: 1/3. At these sizes they depend on the drive. Middle and bottom: κ and J_n from several
        starts, relative to the mean over them: in equilibrium with the mean of the baths (warm), with the colder or the hotter one, and empty. They
        differ by up to {kappa} % in κ and {current} % in J_n. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    table, spacing = read(results), spacings(results)
    slopes = exponents(table)
    starts = pd.concat([deviations(table, name) for name in COMPARED])
    figure, rows = plt.subplots(
        3,
        len(spacing),
        sharey="row",
        figsize=(0.7 * len(spacing) * style.COLUMN, 2.1 * style.HEIGHT),
        height_ratios=[1.4, 1, 1],
    )
    for column, gas in zip(rows.T, spacing, strict=True):
        draw_exponents(column[0], slopes[slopes.gas == gas], spacing[gas])
        for axes, (quantity, symbol) in zip(column[1:], COMPARED.items(), strict=True):
            draw_starts(axes, starts[(starts.gas == gas) & (starts.quantity == quantity)], symbol)
        column[-1].set_xlabel("number of cells $N$")
    for axes in rows[:, 1:].flat:
        axes.set_ylabel("")
    rows[0, 0].set_ylabel(r"$d\ln\kappa/d\ln N$")
    rows[0, 0].legend(loc="lower left", handletextpad=0.2)
    figure.legend(
        *rows[1, 0].get_legend_handles_labels(), title="start", loc="outside lower center", ncols=len(STARTS)
    )
    style.letter(*rows.flat)
    figure.align_ylabels()
    return figure, by_spacing(pd.concat([slopes, starts]), spacing), caption(slopes, starts, results)


if __name__ == "__main__":
    pure = ("size", "smaller", "larger", "exponent", "drive", "deviation")
    run(draw, "Heat conductivity for several drives and starts", **dict.fromkeys(pure, "1"))
