"""Ext. 2: local exponent of the heat conductivity, d ln kappa / d ln N, at the paper's spacing and at fixed spacings."""

from collections.abc import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.figures.ext09 import CUBE_ROOT, LOOKS, range_of, spacings, tabulate
from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.fit import with_error
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result

RESOLVED = 3  # standard errors beyond which a curvature is called one
BESIDE = 1.07  # factor of the sizes at which neighbouring spacings are drawn, as points would hide each other
TEMPERATURES = {
    "particle": "arriving particles",
    "baths": "baths",
}  # that may take the place of T_1 and T_N in eq. 28
OTHERS = tuple(TEMPERATURES)
DEFINITIONS = ("", *(f"_{other}" for other in OTHERS))  # as suffixes of columns
SPREAD: style.Look = {"linewidth": 4, "alpha": 0.25, "zorder": 1}  # of the definitions


def local(part: pd.DataFrame) -> pd.DataFrame:
    """Between neighbouring sizes of one spacing, for each definition of kappa."""
    found: dict[str, np.ndarray] = {}
    for name in DEFINITIONS:
        middle, slope, error = local_exponents(part.cells, part[f"kappa{name}"], part[f"kappa{name}_error"])
        found |= {"size": middle, f"exponent{name}": slope, f"exponent{name}_error": error}
    return pd.DataFrame(found)


def of_cube_root(part: pd.DataFrame) -> tuple[np.ndarray, np.ndarray] | None:
    """Local exponents of a + b N^(1/3) as it is fitted in ext. 9."""
    held = range_of(part, CUBE_ROOT)
    if held is None:
        return None
    size = part.cells[part.cells >= held.first].to_numpy(dtype=float)
    middle, slope, _ = local_exponents(size, held.predicted, np.ones_like(size))
    return middle, slope


def trend(part: pd.DataFrame, column: str) -> str:
    """What the exponent does with growing size, by the curvature of ln kappa in ln N over all sizes."""
    value, error = part[column], part[f"{column}_error"]
    curve, errors = np.polyfit(np.log(part.cells), np.log(value), 2, w=value / error, cov="unscaled")
    change = curve[0] / np.sqrt(errors[0, 0])
    return "does not change beyond errors" if abs(change) < RESOLVED else "rises" if change > 0 else "falls"


def glide(part: pd.DataFrame, found: pd.DataFrame) -> str:
    """What the exponent does from the smallest sizes to the largest."""
    verb = trend(part, "kappa")
    first, last = found.iloc[0], found.iloc[-1]
    ends = [
        f"{with_error(one.exponent, one.exponent_error)} about N = {one['size']:.0f}" for one in (first, last)
    ]
    return f"{verb}, from {ends[0]} to {ends[1]}"


def definitions(found: pd.DataFrame) -> str:
    """How far the definitions of kappa are apart, where the chains are shortest and where they are longest."""
    apart = pd.concat([(found[f"exponent_{other}"] - found.exponent).abs() for other in OTHERS], axis=1).max(
        axis=1
    )
    most = apart.groupby(found["size"]).max()
    return " and ".join(f"{most[size]:.2f} about N = {size:.0f}" for size in (most.index[0], most.index[-1]))


def otherwise(table: pd.DataFrame, spacing: Mapping[str, str]) -> str:
    """Where another definition of kappa has another trend, in words."""
    said = [
        f"at spacing {spacing[name]} with those of the {TEMPERATURES[other]} it {verb}"
        for name, part in table.groupby("gas", sort=False)
        for other in OTHERS
        if (verb := trend(part, f"kappa_{other}")) != trend(part, "kappa")
    ]
    return f"; {', '.join(said)}" if said else ""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table = tabulate(results)
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    tables: list[pd.DataFrame] = []
    said, spacing = [], spacings(results)
    for name, part in table.groupby("gas", sort=False):
        marker, color = LOOKS[name]
        found = local(part)
        look = {"marker": marker, "color": color, "label": rf"$\lambda = {spacing[name]}$", **style.POINTS}
        beside = BESIDE ** len(tables)
        axes.errorbar(beside * found["size"], found.exponent, found.exponent_error, **look)
        others = found[[f"exponent{name}" for name in DEFINITIONS]]
        axes.vlines(beside * found["size"], others.min(axis=1), others.max(axis=1), color=color, **SPREAD)
        if law := of_cube_root(part):
            axes.plot(*law, color=color, linestyle=style.DASHES[1])
        tables.append(found.assign(gas=name))
        said.append(f"at spacing {spacing[name]} it {glide(part, found)}")
    axes.axhline(1 / 3, **style.GUIDE)
    axes.annotate("1/3", (1.01, 1 / 3), xycoords=("axes fraction", "data"), va="center", size=8)
    axes.set(xscale="log", xlabel="number of cells $N$", ylabel=r"$d\ln\kappa/d\ln N$", ylim=(0, None))
    style.label_sizes(axes.xaxis)
    axes.legend(loc="upper right")
    whole = pd.concat(tables)
    caption = (
        "Local exponent of the heat conductivity between neighbouring sizes, from the runs of ext. 9 at γ = N: "
        f"{'; '.join(said)}. At the spacing 1/N of the paper the gas thins out as the chain grows; at fixed spacings large "
        "N is the thermodynamic limit. Broken lines: a + b N^(1/3), fitted to the sizes for which it is not rejected, "
        "whose exponent tends to 1/3. With the temperatures of the arriving particles or of the baths in place of T_1 and "
        f"T_N (pale bars from the least to the largest of the three) the exponents differ from these by up to {definitions(whole)}{otherwise(table, spacing)}. Error bars: standard errors over replicas; neighbouring points share a size; "
        "spacings are drawn beside each other."
    )
    return figure, whole, caption


if __name__ == "__main__":
    exponents = [f"exponent{name}" for name in DEFINITIONS]
    pure = ["size", *exponents, *(f"{name}_error" for name in exponents)]
    run(draw, "Local exponent of the heat conductivity", **dict.fromkeys(pure, "1"))
