"""Heat conductivity against the number of cells at a fixed spacing and at the paper's spacing 1/N: κ at a strong drive, and κ_0, that
without a particle current, by linear response, against rings in equilibrium (workflow/physics/response.py).

At 1/N the gas thins out as the chain grows; at a fixed spacing the particles per cell are the same for every N, so that N goes to
infinity in the thermodynamic limit. Both conductivities are over the difference of the end scatterers' temperatures. Open symbols: exponents of κ_0
over that of the baths, which contains the resistance of the contacts; both definitions bracket the exponent of long chains. The table also
has the matrix L.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, format_number
from workflow.lib.figure import Parts, main, plots, require_elastic
from workflow.lib.fit import format_with_error
from workflow.lib.load import Result
from workflow.physics.conductivity import LOOKS, by_spacing, drive, spacings, tabulate
from workflow.physics.growth import local_exponents
from workflow.physics.response import DENSE, response

THINNING = "thinning"  # the gas that has no thermodynamic limit
DRIVEN = "thinning thinning-large dilute dilute-large dense dense-large "
FORCES = "thinning-temperature dense-temperature dense-temperature-large thinning-pressure dense-pressure dense-pressure-large "
RINGS = "ring-16 ring-32 ring-64 ring-128 ring-256 dense-long dense-longest "  # and dense, of `momentum`
BESIDE = 1.07  # ratio of the abscissas of open and full symbols, so that they do not overlap
ABOVE = 1.6  # upper end of the axis of the exponents over the largest, so that there is space for the legend
EXPONENTS = {
    "kappa": "exponent",
    "kappa_0": "exponent_0",
    "kappa_0_baths": "exponent_0_baths",
    "predicted": "exponent_predicted",
}


def with_exponents(table: pd.DataFrame) -> pd.DataFrame:
    """Adds the local exponent of every conductivity from a size to the next one of its gas, with the geometric mean of both sizes."""
    table = table.assign(between=np.nan)  # stays NaN in the row of the largest size
    for _, part in table.groupby("gas", sort=False):
        for name in (name for name in EXPONENTS if name in part):
            columns = ["between", EXPONENTS[name], f"{EXPONENTS[name]}_error"]
            local = local_exponents(part.cells, part[name], part[f"{name}_error"])
            table.loc[part.index[:-1], columns] = np.stack(local, axis=1)
    return table


def draw_driven(axes: Axes, table: pd.DataFrame, spacing: dict[str, str]) -> None:
    for name, part in table.groupby("gas", sort=False):
        axes.errorbar(
            part.cells,
            part.kappa,
            part.kappa_error,
            **style.points(*LOOKS[name], label=rf"$\lambda = {spacing[name]}$"),
        )
    size = np.array([table.cells.min(), table.cells.max()], dtype=float)
    guide = 0.6 * table.kappa.min() * (size / size[0]) ** (1 / 3)
    axes.plot(size, guide, **style.GUIDE)
    axes.text(size[1], 0.7 * guide[1], "$N^{1/3}$", size=8, ha="right", va="top")
    axes.set(ylabel=rf"$\kappa$, strong drive ({style.UNITS})")
    axes.legend(loc="upper left", handletextpad=0.2)


def draw_without_current(whole: Axes, local: Axes, table: pd.DataFrame) -> None:
    """Plots κ_0 and its exponents, with the predictions; those over the baths at the fixed spacing only."""
    for name, part in table.groupby("gas", sort=False):
        look, color = style.points(*LOOKS[name]), LOOKS[name][1]
        whole.errorbar(part.cells, part.kappa_0, part.kappa_0_error, **look)
        whole.plot(part.cells, part.predicted, color=color)
        style.band(whole, part.cells, part.predicted, part.predicted_error, color)
        local.errorbar(part.between, part.exponent_0, part.exponent_0_error, **look)
        local.plot(part.between, part.exponent_predicted, color=color)
        style.band(local, part.between, part.exponent_predicted, part.exponent_predicted_error, color)
        if name == DENSE:
            local.errorbar([], [], [], **look, label="$T$ of the end scatterers")
            baths = style.points(*LOOKS[name], "white", label="$T$ of the baths")
            local.errorbar(BESIDE * part.between, part.exponent_0_baths, part.exponent_0_baths_error, **baths)
    whole.set(ylabel=rf"$\kappa_0$ at $J_n = 0$ ({style.UNITS})")
    highest = table[["exponent_0", "exponent_0_baths", "exponent_predicted"]].max().max()
    local.set(ylabel=r"local exponent of $\kappa_0$", ylim=(0, ABOVE * max(highest, 1 / 3)))
    style.guide_at(local, 1 / 3, "1/3")
    local.plot([], [], color="grey", label="rings")
    local.legend(loc="upper right")


def caption(weak: pd.DataFrame, results: Sequence[Result]) -> str:
    spacing = spacings(results)
    dense, thin = (weak[weak.gas == name] for name in (DENSE, THINNING))
    last = dense.dropna(subset="between").iloc[-1]
    ends, baths = (
        format_with_error(last[name], last[f"{name}_error"]) for name in ("exponent_0", "exponent_0_baths")
    )
    thinnest = thin.iloc[-1]
    ratio = thinnest.kappa_0 / thinnest.predicted
    error = ratio * np.hypot(
        thinnest.kappa_0_error / thinnest.kappa_0, thinnest.predicted_error / thinnest.predicted
    )
    return f"""
        At the fixed spacing λ = {spacing[DENSE]} and without particle current, the last exponent (c) of κ = −J_U N/(T_N − T_1) is {ends}, or {baths} with bath temperatures.
        (a) T_R/T_L is {format_number(max(map(drive, results)))}. (b) Lines are predicted from ⟨Q²⟩ of rings until sound has crossed the chain; the
        last ratio of κ_0 to them at λ = 1/N is {format_with_error(ratio, error)}. {ERRORS}"""


@plots(DRIVEN + FORCES + RINGS)
def draw(results: Sequence[Result]) -> Parts:
    chains = [result for result in results if "nu-left" in result.parameters]
    require_elastic(chains, "the conductivity of mode coupling")
    strongest, spacing = max(map(drive, chains)), spacings(chains)
    driven = with_exponents(tabulate([chain for chain in chains if drive(chain) == strongest]))
    table, _ = response([chain for chain in chains if drive(chain) < strongest], results)
    weak = with_exponents(table)
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(2.1 * style.COLUMN, style.HEIGHT))
    right.sharex(middle)
    draw_driven(left, driven, spacing)
    draw_without_current(middle, right, weak)
    for axes, part, name in ((left, driven, "kappa"), (middle, weak, "kappa_0")):
        style.cross_out(axes, part.cells, part[name], ~part.usable)
        axes.set(yscale="log")
        style.label_within_decades(axes.yaxis)
    for axes in (left, middle, right):
        style.against_size(axes)
    style.letter(left, middle, right)
    whole = by_spacing(pd.concat([driven, weak]), spacing)
    return figure, whole, caption(weak, chains)


if __name__ == "__main__":
    units = {"L_uu": "energy^2/time", "L_un": "energy/time", "L_nu": "energy/time", "L_nn": "1/time"}
    units |= dict.fromkeys(("kappa_0", "kappa_0_baths", "predicted"), "energy/(time temperature)")
    units |= {"asymmetry": "energy/time", "tau": "1", "between": "1"} | dict.fromkeys(EXPONENTS.values(), "1")
    main(draw, "Heat conductivity at fixed and at the paper's spacing", **units)
