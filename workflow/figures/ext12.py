"""Ext. 12: how the exponents of ext. 9 depend on how strongly the chain is driven, and whether kappa knows the start."""

from collections.abc import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from workflow.figures.ext09 import CUBE_ROOT, LOOKS, by_spacing, kept, range_of, spacings, tabulate, written
from workflow.lib import style
from workflow.lib.caption import WINDOW, goodness, number, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import mean_of, rejected
from workflow.lib.growth import Growth, fits, local_exponents
from workflow.lib.load import Result

PARAMETERS = 2  # of a + b N^(1/3)
BESIDE = 1.12  # factor of the sizes at which neighbouring drives are drawn
TOP = 0.7  # of the exponents
STATE = {"particle_current": "J_n", "temperature_first": "T_1", "temperature_last": "T_N"}
STARTS = {
    "warm": ("s", style.BLACK),
    "cold": ("v", style.BLUE),
    "hot": ("^", style.VERMILLION),
    "empty": ("o", style.GREEN),
}


def read(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, with its start and its drive, the ratio of the baths' temperatures."""
    rows = []
    for result in results:
        low, high = (float(result.parameters[f"temperature-{side}"]) for side in ("left", "right"))
        row = tabulate([result]).iloc[0].to_dict()
        row |= {"start": result.parameters["start"], "drive": round(high / low, 2)}
        for name in STATE:
            row[name], row[f"{name}_error"] = float(result[name].mean), float(result[name].error)
        rows.append(row)
    return pd.DataFrame(rows).sort_values("cells", ignore_index=True)


def exponents(table: pd.DataFrame) -> pd.DataFrame:
    """Local exponents of every drive between the sizes that all drives have, where there are several."""
    parts = []
    warm = table[table.start == "warm"]
    several = warm.groupby("gas").filter(lambda part: part.drive.nunique() > 1)
    for name, part in several.groupby("gas", sort=False):
        common = set.intersection(*(set(one.cells) for _, one in part.groupby("drive")))
        for drive, one in part[part.cells.isin(common)].groupby("drive"):
            size, slope, error = local_exponents(one.cells, one.kappa, one.kappa_error)
            ends = {"size": size, "first": one.cells.to_numpy()[:-1], "last": one.cells.to_numpy()[1:]}
            columns = {**ends, "exponent": slope, "exponent_error": error}
            parts.append(pd.DataFrame({"gas": name, "drive": drive, **columns}))
    return pd.concat(parts, ignore_index=True)


def laws(table: pd.DataFrame, spacing: Mapping[str, str]) -> str:
    """From which size on kappa grows as a + b N^(1/3), for every drive at fixed spacing, in words."""
    said = []
    warm = table[(table.start == "warm") & (table.gas != "thinning")]
    for (name, drive), part in warm.groupby(["gas", "drive"]):
        if warm[warm.gas == name].drive.nunique() > 1 and len(part) > PARAMETERS + 1:
            law = range_of(part, CUBE_ROOT)
            found = (
                f"from N = {law.first:.0f} on ({goodness(law.chi_square, law.freedom)}{beside(part, law)})"
                if law
                else "nowhere"
            )
            said.append(f"at λ = {spacing[name]} and the ratio {drive:g} {found}")
    return f" a + b N^(1/3) is not rejected {'; '.join(said)}." if said else ""


def beside(part: pd.DataFrame, law: Growth) -> str:
    """Which other laws hold over the same sizes, in words."""
    found = kept(fits(part.cells, part.kappa, part.kappa_error, law.first))
    others = [written(one) for one in found if one.law != law.law]
    return f"; {' and '.join(others)} as well" if others else "; no other law"


def deviations(table: pd.DataFrame, quantity: str) -> pd.DataFrame:
    """A quantity from every start relative to the mean over the starts, minus 1, at the drive that has several; with
    chi^2 about that mean for each size, in its first row."""
    driven = table[table.drive.isin(table[table.start != "warm"].drive)]
    parts = []
    for (name, cells), part in driven.groupby(["gas", "cells"]):
        if len(part) > 1:
            value, error = part[quantity], part[f"{quantity}_error"]
            mean, _, spread = mean_of(value, error)
            found = {"deviation": value / mean - 1, "deviation_error": error / mean}
            parts.append(part[["start"]].assign(gas=name, cells=cells, **found))
            parts[-1].loc[parts[-1].index[0], ["chi_square", "freedom"]] = spread, len(part) - 1
    return pd.concat(parts, ignore_index=True)


def memory(found: Mapping[str, pd.DataFrame], spacing: Mapping[str, str]) -> str:
    """Whether the state of the chain knows its start, in words, from the deviations of what describes it."""
    said, known = [], []
    for quantity, symbol in STATE.items():
        one = found[quantity]
        spread = goodness(one.chi_square.sum(), int(one.freedom.sum()))
        said.append(f"{symbol} {spread}, largest deviation {100 * one.deviation.abs().max():.1f} %")
        known += [
            f"{symbol} at λ = {spacing[row.gas]}, N = {row.cells} ({goodness(row.chi_square, int(row.freedom))})"
            for row in one.dropna(subset="chi_square").itertuples()
            if rejected(row.chi_square, int(row.freedom))
        ]
    where = f" Starts are not forgotten by {'; '.join(known)}." if known else ""
    return f"Of the state, likewise: {'; '.join(said)}.{where}"


def conclusion(slopes: pd.DataFrame, table: pd.DataFrame) -> str:
    """What the laws of ext. 9 rest on."""
    depends = " Local exponents depend on the drive at these sizes." if rejected(*scatter(slopes)) else ""
    longest = table[table.start != "warm"].groupby("gas").cells.max()
    return f"{depends} Starts are compared up to N = {longest.min()} to {longest.max()} only: what ext. 9 says of longer chains rests on its start."


def scatter(found: pd.DataFrame) -> tuple[float, int]:
    """chi^2 of the drives' local exponents about their weighted mean at each size and spacing, with its degrees of
    freedom. Neighbouring sizes share an error, so that the p-value is not exact."""
    total, freedom = 0.0, 0
    for _, one in found.groupby(["gas", "size"]):
        weight = one.exponent_error**-2
        mean = np.average(one.exponent, weights=weight)
        total += float(np.sum(weight * (one.exponent - mean) ** 2))
        freedom += len(one) - 1
    return total, freedom


def draw_exponents(axes: Axes, found: pd.DataFrame, gas: str, spacing: str) -> None:
    """Of one spacing, against the size: the stronger the drive, the fuller the marker."""
    marker, color = LOOKS[gas]
    drives = sorted(found.drive.unique())
    for place, (drive, share) in enumerate(zip(drives, np.linspace(0, 1, len(drives)), strict=True)):
        one = found[found.drive == drive]
        look: style.Look = {"marker": marker, "color": color, "markerfacecolor": shaded(color, share)}
        size = BESIDE ** (place - (len(drives) - 1) / 2) * one["size"]  # they would hide each other
        label = f"$T_R/T_L = {drive:g}$"
        axes.errorbar(size, one.exponent, one.exponent_error, label=label, **style.POINTS, **look)
    axes.set(xscale="log", xlabel="number of cells $N$", title=rf"$\lambda = {spacing}$", ylim=(0, TOP))
    style.label_sizes(axes.xaxis)
    style.guide_at(axes, 1 / 3, "1/3")


def shaded(color: str, share: float) -> tuple[float, float, float]:
    """Between white and the colour."""
    red, green, blue = (1 - share * (1 - part) for part in to_rgb(color))
    return red, green, blue


def draw_starts(axes: Axes, found: pd.DataFrame, symbol: str) -> None:
    places = {key: index for index, key in enumerate(found.groupby(["cells", "gas"], sort=True).groups)}
    for rank, (start, (marker, color)) in enumerate(STARTS.items()):
        one = found[found.start == start]
        shift = 0.17 * (rank - (len(STARTS) - 1) / 2)
        place = [places[cells, name] + shift for cells, name in zip(one.cells, one.gas, strict=True)]
        look = {"marker": marker, "color": color, "label": start, **style.POINTS}
        axes.errorbar(place, 100 * one.deviation, 100 * one.deviation_error, **look)
    axes.axhline(0, **style.GUIDE)
    axes.set_ylabel(rf"$\delta {symbol}$ (%)")
    axes.margins(y=0.25)
    axes.yaxis.set_major_locator(MaxNLocator(4))


def label_cases(axes: Axes, found: pd.DataFrame, spacing: Mapping[str, str]) -> None:
    cases = found.groupby(["cells", "gas"], sort=True).groups
    axes.set_xticks(range(len(cases)), [f"{cells}\n${spacing[name]}$" for cells, name in cases])
    axes.tick_params(axis="x", which="both", length=0)
    axes.set_xlabel(r"$N$, $\lambda$")


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table = read(results)
    slopes = exponents(table)
    found = {name: deviations(table, name) for name in ("kappa", *STATE)}
    starts, current = found["kappa"], found["particle_current"]
    spacing = spacings(results)
    figure = plt.figure(figsize=(1.9 * style.COLUMN, 1.5 * style.HEIGHT))
    above, below = figure.subfigures(2, 1, squeeze=False, height_ratios=[1, 1.1]).ravel()
    gases = list(slopes.groupby("gas", sort=False))
    row = above.subplots(1, len(gases), sharey=True, squeeze=False)[0]
    for axes, (name, part) in zip(row, gases, strict=True):
        draw_exponents(axes, part, name, spacing[name])
    row[0].set_ylabel(r"$d\ln\kappa/d\ln N$")
    strips = below.subplots(2, 1, sharex=True)
    draw_starts(strips[0], starts, r"\kappa")
    draw_starts(strips[1], current, "J_n")
    label_cases(strips[1], current, spacing)
    for place, axes in ((above, row[0]), (below, strips[0])):
        place.legend(*axes.get_legend_handles_labels(), loc="outside upper right", ncols=4)
    below.align_ylabels(strips)
    style.letter(*row, *strips)
    scatters = [f"{goodness(*scatter(slopes))}, about a common value at every size and spacing"]
    if slopes["size"].nunique() > 1:
        last = slopes[slopes["size"] == slopes.groupby("gas")["size"].transform("max")]
        scatters += [
            f"between the largest sizes at spacing {spacing[name]} {goodness(*scatter(part))}"
            for name, part in last.groupby("gas")
        ]
    baths = sorted(
        {(one.parameters["temperature-left"], one.parameters["temperature-right"]) for one in results}
    )
    temperatures = "; ".join(f"{number(left)}, {number(right)}" for left, right in baths)
    drives = ", ".join(f"{drive:g}" for drive in sorted(slopes.drive.unique()))
    caption = (
        f"Open chains, {parameters(results, 'sigma', 'gamma', *WINDOW)}, {replicas(results)}; baths of T_L, T_R = {temperatures} with ν√T equal at both ends. Above: local exponent of κ between neighbouring sizes for ratios of the baths' temperatures of {drives} at equal pressures, "
        f"drawn beside each other: {'; '.join(scatters)}."
        f"{laws(table, spacing)} Below: κ and J_n from several starts relative to the mean over them, δ: in "
        "equilibrium with the mean of the baths (warm), with the colder or the hotter one, and empty; for κ "
        f"{goodness(starts.chi_square.sum(), int(starts.freedom.sum()))}, about a common value at every size, the largest "
        f"deviation {100 * starts.deviation.abs().max():.1f} %. {memory(found, spacing)}{conclusion(slopes, table)} Error bars: standard errors over replicas."
    )
    drawn = [found[name].assign(quantity=name) for name in ("kappa", "particle_current")]
    return figure, by_spacing(pd.concat([slopes, *drawn]), spacing), caption


if __name__ == "__main__":
    pure = (
        "size",
        "first",
        "last",
        "exponent",
        "exponent_error",
        "drive",
        "deviation",
        "deviation_error",
        "chi_square",
        "freedom",
    )
    run(draw, "Growth of the conductivity for several drives and starts", **dict.fromkeys(pure, "1"))
