"""Ext. 12: how the local exponents of ext. 9 depend on the drive, and kappa and the particle current on the start."""

from collections.abc import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, goodness, parameters, replicas
from workflow.lib.conductivity import LOOKS, by_spacing, drive, spacings, tabulate
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import mean_of
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result

APART = 0.15  # distance of neighbouring starts in a slot, in units of the slot
WARM = "warm"
FACES = (None, "white")  # fill colours of the smallest and of the largest pair of sizes
STARTS = {
    WARM: ("s", style.BLACK),
    "cold": ("v", style.BLUE),
    "hot": ("^", style.VERMILLION),
    "empty": ("o", style.GREEN),
}
COMPARED = {"kappa": r"\kappa", "particle_current": "J_n"}


def read(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, with its start and its drive, the ratio of the baths' temperatures."""
    rows = [
        tabulate([result]).assign(start=result.parameters["start"], drive=drive(result)) for result in results
    ]
    return pd.concat(rows).sort_values("cells", ignore_index=True)


def exponents(table: pd.DataFrame) -> pd.DataFrame:
    """Local exponents of every drive between the sizes that all drives have."""
    parts = []
    for name, part in table[table.start == WARM].groupby("gas", sort=False):
        common = set.intersection(*(set(rows.cells) for _, rows in part.groupby("drive")))
        for ratio, rows in part[part.cells.isin(common)].groupby("drive"):
            size, slope, error = local_exponents(rows.cells, rows.kappa, rows.kappa_error)
            smaller, larger = rows.cells.to_numpy()[:-1], rows.cells.to_numpy()[1:]
            columns = {"size": size, "smaller": smaller, "larger": larger}
            columns |= {"exponent": slope, "exponent_error": error}
            parts.append(pd.DataFrame({"gas": name, "drive": ratio, **columns}))
    return pd.concat(parts, ignore_index=True)


def deviations(table: pd.DataFrame, quantity: str) -> pd.DataFrame:
    """One row per gas, size and start, at the drive with several starts: a quantity relative to its mean over the starts, minus 1, and
    chi^2 of the starts."""
    driven = table[table.drive.isin(table[table.start != WARM].drive)]
    parts = []
    for (name, cells), part in driven.groupby(["gas", "cells"], sort=False):
        if len(part) > 1:
            value, error = part[quantity], part[f"{quantity}_error"]
            mean, _, chi_square = mean_of(value, error)
            columns = {"deviation": value / mean - 1, "deviation_error": error / abs(mean)}
            columns |= {"chi_square": chi_square, "freedom": len(part) - 1}
            parts.append(part[["start"]].assign(gas=name, cells=cells, quantity=quantity, **columns))
    return pd.concat(parts, ignore_index=True)


def draw_exponents(axes: Axes, table: pd.DataFrame, spacing: Mapping[str, str]) -> None:
    """Plots local exponents between the two smallest and the two largest sizes against the drive."""
    for name, gas in table.groupby("gas", sort=False):
        pairs = [pair for pair, _ in gas.groupby(["smaller", "larger"])]
        for (smaller, larger), face in zip(dict.fromkeys((pairs[0], pairs[-1])), FACES, strict=False):
            rows = gas[(gas.smaller == smaller) & (gas.larger == larger)]
            label = rf"$\lambda = {spacing[name]}$, $N = {smaller:g}$ to {larger:g}"
            look = style.points(*LOOKS[name], face, linestyle=":", label=label)
            axes.errorbar(rows.drive, rows.exponent, rows.exponent_error, **look)
    drives = sorted(table.drive.unique())
    axes.set(xscale="log", xlim=(drives[0] / 1.4, drives[-1] * 1.4))
    axes.set_xticks(drives, [f"{ratio:g}" for ratio in drives])
    axes.set_xticks([], minor=True)
    axes.set_ylim(bottom=min(0, axes.get_ylim()[0]))
    axes.set(xlabel="drive $T_R/T_L$", ylabel=r"$d\ln\kappa/d\ln N$")
    style.guide_at(axes, 1 / 3, "1/3")


def draw_starts(axes: Axes, table: pd.DataFrame, symbol: str, spacing: Mapping[str, str]) -> None:
    """Plots the deviations of the starts, with one slot per spacing and size."""
    present = set(zip(table.gas, table.cells, strict=True))
    slots = sorted(present, key=lambda slot: ([*spacing].index(slot[0]), slot[1]))
    for rank, (start, shape) in enumerate(STARTS.items()):
        rows = table[table.start == start]
        slot = np.array([slots.index(key) for key in zip(rows.gas, rows.cells, strict=True)])
        look = style.points(*shape, label=start)
        axes.errorbar(slot + APART * (rank - 1.5), 100 * rows.deviation, 100 * rows.deviation_error, **look)
    axes.axhline(0, **style.GUIDE)
    names = [f"$\\lambda = {spacing[name]}$\n$N = {cells}$" for name, cells in slots]
    axes.set_xticks(range(len(slots)), names)
    axes.tick_params(axis="x", which="both", length=0)
    axes.set(xlim=(-0.5, len(slots) - 0.5), ylabel=rf"$\delta {symbol}$ / %")


def agreement(starts: pd.DataFrame, quantity: str) -> str:
    """Text with the largest deviation of a start from the mean, and the goodness of the agreement of all starts."""
    rows = starts[starts.quantity == quantity]
    slots = rows.drop_duplicates(["gas", "cells"])
    largest = 100 * rows.deviation.abs().max()
    return f"{largest:.1f} % ({goodness(slots.chi_square.sum(skipna=False), int(slots.freedom.sum()))})"


def caption(starts: pd.DataFrame, results: Sequence[Result]) -> str:
    kappa, current = (agreement(starts, name) for name in COMPARED)
    return f"""
        Heat conductivity κ and particle current J_n of the chains of ext. 9 for other drives and starts, {parameters(results, "gamma", "sigma")},
        {replicas(results)}. (a) Exponents of κ between two sizes against the ratio of the baths' temperatures, at equal
        pressures; at these sizes they depend on it. (b), (c) κ and J_n from several
        starts, over their mean: in equilibrium with the mean of the baths (warm), with the colder or the hotter one, and empty. They
        differ by up to {kappa} in κ and {current} in J_n. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    table, spacing = read(results), spacings(results)
    slopes = exponents(table)
    starts = pd.concat([deviations(table, name) for name in COMPARED])
    figure, panels = plt.subplot_mosaic(
        [["exponents", "kappa"], ["exponents", "particle_current"]],
        figsize=(2 * style.COLUMN, 1.2 * style.HEIGHT),
    )
    draw_exponents(panels["exponents"], slopes, spacing)
    for quantity, symbol in COMPARED.items():
        draw_starts(panels[quantity], starts[starts.quantity == quantity], symbol, spacing)
    panels["kappa"].tick_params(labelbottom=False)
    figure.legend(*panels["exponents"].get_legend_handles_labels(), loc="outside upper left")
    handles = panels["kappa"].get_legend_handles_labels()
    figure.legend(*handles, title="start in (b), (c)", loc="outside upper right", ncols=len(STARTS))
    style.letter(*panels.values())
    return figure, by_spacing(pd.concat([slopes, starts]), spacing), caption(starts, results)


if __name__ == "__main__":
    pure = ("size", "smaller", "larger", "exponent", "drive", "deviation", "chi_square", "freedom")
    run(draw, "Heat conductivity for several drives and starts", **dict.fromkeys(pure, "1"))
