"""Ext. 9: heat conductivity against the number of cells at the paper's spacing 1/N and at fixed spacings.

At 1/N the gas thins out as the chain grows; at a fixed spacing the particles per cell are the same for every N, so
that N goes to infinity in the thermodynamic limit.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.typing import LineStyleType

from workflow.lib import style
from workflow.lib.caption import ERRORS, format_number, listed, parameters
from workflow.lib.figure import Parts, main, plots
from workflow.lib.fit import p_value
from workflow.lib.load import Result
from workflow.physics.conductivity import LOOKS, by_spacing, drive, spacings, tabulate

THINNING = "thinning"  # the gas that has no thermodynamic limit


class Law(NamedTuple):
    """A law of growth with the size: its label in the legend, the dashes of its line, and its leading term and
    first correction, combined linearly. A sound peak whose width grows as t^(2/3) gives corrections of relative order N^(-1/3)."""

    label: str
    dashes: LineStyleType
    basis: Callable[[np.ndarray], list[np.ndarray]]


LAWS = {
    "N^(1/3)": Law("$a + bN^{1/3}$", "solid", lambda n: [n ** (1 / 3), n**0]),
    "logarithm": Law(r"$a + b\,\ln N$", "dashed", lambda n: [np.log(n), n**0]),
    "constant": Law("saturation, $a + bN^{-1/3}$", "dotted", lambda n: [n**0, n ** (-1 / 3)]),
}


def fitted(law: Law, size: np.ndarray, value: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Values at the sizes of the law that fits best, by weighted least squares; nan if an error is unknown."""
    if not np.isfinite(error).all():
        return np.full(len(size), np.nan)
    design = np.stack(law.basis(size), axis=1)
    solution, *_ = np.linalg.lstsq(design / error[:, None], value / error, rcond=None)
    return design @ solution


def points(part: pd.DataFrame) -> list[np.ndarray]:
    return [part[name].to_numpy(dtype=float) for name in ("cells", "kappa", "kappa_error")]


def laws(part: pd.DataFrame) -> pd.DataFrame:
    """Fits of all laws to all sizes of one gas, one row per law."""
    size, value, error = points(part)
    rows = []
    for name, law in LAWS.items():
        chi_square = float(np.sum(((value - fitted(law, size, value, error)) / error) ** 2))
        freedom = len(size) - len(law.basis(size))
        row = {"law": name, "chi_square": chi_square, "freedom": freedom}
        rows.append(row | {"p_value": p_value(chi_square, freedom)})
    return pd.DataFrame(rows)


def slopes(part: pd.DataFrame) -> pd.DataFrame:
    """dκ/d(N^(1/3)) between neighbouring sizes, at their geometric mean, with the slopes of the laws fitted to all sizes."""
    size, value, error = points(part)
    step = np.diff(np.cbrt(size))
    columns = {"between": np.sqrt(size[1:] * size[:-1]), "slope": np.diff(value) / step}
    columns["slope_error"] = np.hypot(error[1:], error[:-1]) / step
    for name, law in LAWS.items():
        columns[f"slope_{name}"] = np.diff(fitted(law, size, value, error)) / step
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
        axes.errorbar(part.between, part.slope, part.slope_error, **style.points(*LOOKS[name]))
        if name != THINNING:
            for name_of_law, law in LAWS.items():
                look: style.Look = {"color": LOOKS[name][1], "linestyle": law.dashes, "linewidth": 0.8}
                axes.plot(part.between, part[f"slope_{name_of_law}"], zorder=1, **look)
    style.against_size(axes)
    axes.set(yscale="log", ylabel=r"$d\kappa/d(N^{1/3})$")
    positive = table.slope[table.slope > 0]
    axes.set_ylim(0.2 * positive.min(), 2 * positive.max())  # space for the legend
    style.label_within_decades(axes.yaxis)
    handles = [Line2D([], [], color="grey", linestyle=law.dashes, label=law.label) for law in LAWS.values()]
    axes.legend(handles=handles, loc="lower left")


def caption(tested: pd.DataFrame, results: Sequence[Result], spacing: Mapping[str, str]) -> str:
    largest = tested.groupby("gas", sort=False).p_value.max()
    p_values = listed(f"{p:.1g} (λ = {spacing[gas]})" for gas, p in largest.items())
    return f"""
        Conductivity κ = −J_U N/(T_N − T_1) of open chains at the paper's λ = 1/N, where the gas thins out, and at fixed λ;
        {parameters(results, "gamma", "sigma")}, T_R/T_L = {format_number(max(map(drive, results)))}. (b) Slope against N^(1/3); lines: laws fitted to all sizes, of which
        the best has the p-value {p_values}. {ERRORS}"""


@plots("thinning thinning-large dilute dilute-large dense dense-large")
def draw(results: Sequence[Result]) -> Parts:
    table, spacing = tabulate(results), spacings(results)
    gases = table.groupby("gas", sort=False)
    table = table.join(pd.concat([slopes(part) for _, part in gases]))
    tested = pd.concat([laws(part).assign(gas=name) for name, part in table.groupby("gas", sort=False)])
    figure, (left, right) = plt.subplots(1, 2, figsize=(2 * style.COLUMN, style.HEIGHT))
    draw_powers(left, table, spacing)
    draw_slopes(right, table)
    style.letter(left, right)
    return figure, by_spacing(pd.concat([table, tested]), spacing), caption(tested, results, spacing)


if __name__ == "__main__":
    conductivities = ("kappa_baths", "slope", *(f"slope_{law}" for law in LAWS))
    units = dict.fromkeys(("between", "chi_square", "freedom", "p_value"), "1")
    units |= dict.fromkeys(conductivities, "energy/(time temperature)")
    main(draw, "Heat conductivity at fixed spacing and at the spacing 1/N", **units)
