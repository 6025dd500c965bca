"""Ext. 2: local exponent of the heat conductivity, d ln kappa / d ln N, at the paper's spacing and at fixed spacings."""

from collections.abc import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from workflow.figures.ext09 import (
    CUBE_ROOT,
    LINES,
    LOOKS,
    MATHS,
    by_spacing,
    range_of,
    spacings,
    tabulate,
    written,
)
from workflow.lib import style
from workflow.lib.caption import parameters
from workflow.lib.figure import run
from workflow.lib.fit import with_error
from workflow.lib.growth import POWER, Growth, local_exponents
from workflow.lib.load import Result

SHOWN = (CUBE_ROOT, POWER)  # laws that are drawn
RESOLVED = 3  # standard errors beyond which a curvature is called one
BESIDE = 1.07  # factor of the sizes at which neighbouring spacings are drawn, as points would hide each other
TEMPERATURES = {
    "particle": "arriving particles",
    "baths": "baths",
}  # that may take the place of T_1 and T_N in eq. 28
OTHERS = tuple(TEMPERATURES)
DEFINITIONS = ("", *(f"_{other}" for other in OTHERS))  # as suffixes of columns
TITLES = {"": "$T_1$, $T_N$"} | {f"_{other}": name for other, name in TEMPERATURES.items()}  # by definition


def local(part: pd.DataFrame) -> pd.DataFrame:
    """Between neighbouring sizes of one spacing, for each definition of kappa."""
    found: dict[str, np.ndarray] = {}
    for name in DEFINITIONS:
        middle, slope, error = local_exponents(part.cells, part[f"kappa{name}"], part[f"kappa{name}_error"])
        found |= {"size": middle, f"exponent{name}": slope, f"exponent{name}_error": error}
    return pd.DataFrame(found)


def fitted(part: pd.DataFrame, name: str, law: str) -> Growth | None:
    """A law as it is fitted in ext. 9, to the sizes for which it is not rejected, for a definition of kappa."""
    return range_of(part.assign(kappa=part[f"kappa{name}"], kappa_error=part[f"kappa{name}_error"]), law)


def draw_law(axes: Axes, part: pd.DataFrame, name: str, law: str, color: str) -> None:
    """Its local exponents."""
    if held := fitted(part, name, law):
        size = part.cells[part.cells >= held.first].to_numpy(dtype=float)
        middle, slope, _ = local_exponents(size, held.predicted, np.ones_like(size))
        axes.plot(middle, slope, color=color, linestyle=LINES[law])


def trend(part: pd.DataFrame, column: str) -> str:
    """What the exponent does with growing size, by the curvature of ln kappa in ln N over all sizes."""
    value, error = part[column], part[f"{column}_error"]
    curve, errors = np.polyfit(np.log(part.cells), np.log(value), 2, w=value / error, cov="unscaled")
    change = curve[0] / np.sqrt(errors[0, 0])
    return "has no steady trend" if abs(change) < RESOLVED else "rises" if change > 0 else "falls"


def glide(part: pd.DataFrame, found: pd.DataFrame) -> str:
    """What the exponent does from the smallest sizes to the largest."""
    verb = trend(part, "kappa")
    first, last = found.iloc[0], found.iloc[-1]
    ends = [
        f"{with_error(one.exponent, one.exponent_error)} about N = {one['size']:.0f}" for one in (first, last)
    ]
    return f"{verb}, from {ends[0]} to {ends[1]}"


def constant(table: pd.DataFrame, spacing: Mapping[str, str]) -> str:
    """Where one exponent fits the sizes as well, in words."""
    held = {name: fitted(part, "", POWER) for name, part in table.groupby("gas", sort=False)}
    said = [
        f"{written(law)} from N = {law.first:.0f} on at spacing {spacing[name]}"
        for name, law in held.items()
        if law
    ]
    return f": in (a) {', '.join(said)}" if said else ""


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


def draw_definition(
    axes: Axes, name: str, table: pd.DataFrame, exponents: pd.DataFrame, spacing: Mapping[str, str]
) -> None:
    """Every spacing, with the temperatures of one definition of kappa. exponents: as from local()."""
    for place, (gas, part) in enumerate(table.groupby("gas", sort=False)):
        marker, color = LOOKS[gas]
        found = exponents[exponents.gas == gas]
        look = {"marker": marker, "color": color, "label": rf"$\lambda = {spacing[gas]}$", **style.POINTS}
        size = BESIDE ** (place - 1) * found["size"]
        axes.errorbar(size, found[f"exponent{name}"], found[f"exponent{name}_error"], **look)
        for law in SHOWN:
            draw_law(axes, part, name, law, color)
    style.guide_at(axes, 1 / 3, "1/3" if name == DEFINITIONS[-1] else "")
    axes.set(xscale="log", xlabel="number of cells $N$", title=TITLES[name])
    style.label_sizes(axes.xaxis)


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table, spacing = tabulate(results), spacings(results)
    tables, said = [], []
    for name, part in table.groupby("gas", sort=False):
        found = local(part)
        tables.append(found.assign(gas=name))
        said.append(f"at spacing {spacing[name]} it {glide(part, found)}")
    whole = pd.concat(tables)
    figure, row = plt.subplots(1, len(DEFINITIONS), sharey=True, figsize=(2 * style.COLUMN, style.HEIGHT))
    for axes, name in zip(row, DEFINITIONS, strict=True):
        draw_definition(axes, name, table, whole, spacing)
    row[0].set(ylabel=r"$d\ln\kappa/d\ln N$", ylim=(0, None))
    points, names = row[0].get_legend_handles_labels()
    points += [Line2D([], [], color=style.BLACK, linestyle=LINES[law]) for law in SHOWN]
    names += [MATHS[law] for law in SHOWN]
    figure.legend(points, names, loc="outside upper center", ncols=len(names))
    style.letter(*row)
    caption = (
        "Local exponent of the heat conductivity between neighbouring sizes, from the runs of ext. 9 at γ = N, with the temperatures "
        "of (a) the first and the last scatterer, as in the paper, (b) the particles that arrive there, (c) the baths. "
        f"In (a), by the curvature of ln κ in ln N over all sizes, {'; '.join(said)}. At the spacing 1/N of the paper the gas thins out as the chain grows; at fixed spacings large "
        "N is the thermodynamic limit. Lines: a + b N^(1/3), whose exponent tends to 1/3, and a N^b, which has one exponent, each over the "
        f"sizes for which it is not rejected{constant(table, spacing)}. The trend depends on the definition of κ: the exponents in (b) and (c) differ from those in (a) by up to {definitions(whole)}{otherwise(table, spacing)}; "
        f"in an infinite chain all would be one. Errors are statistical; the report's bounds add the definitions, and what a start that is not forgotten could change (ext. 12). All are those of one drive, {parameters(results, 'temperature-left', 'temperature-right')}; ext. 12 says how they depend on it. Error bars: standard errors over replicas; neighbouring points share a size; "
        "spacings are drawn beside each other."
    )
    return figure, by_spacing(whole, spacing), caption


if __name__ == "__main__":
    exponents = [f"exponent{name}" for name in DEFINITIONS]
    pure = ["size", *exponents, *(f"{name}_error" for name in exponents)]
    run(draw, "Local exponent of the heat conductivity", **dict.fromkeys(pure, "1"))
