"""Arrival rates along an open chain over straight lines, and the accumulation of particles at its ends. The table also has the rates and
both currents."""

from collections.abc import Iterable, Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, baths, listed, parameters
from workflow.lib.figure import Parts, main, plots
from workflow.lib.fit import fit_line, format_with_error
from workflow.lib.load import Result
from workflow.physics import setting

FITTED = 20  # cells of the smallest chain in the fit of the excess
SIDES = {"rate_right": (">", "to the right"), "rate_left": ("<", "to the left")}
CURRENTS = ("particle_current", "energy_current")
ENDS = (("left", "v", style.BLACK, "solid"), ("right", "D", style.GREEN, "dashed"))


def look_of(result: Result, name: str) -> style.Look:
    """Style of a rate: large symbols at gamma = N, small ones at gamma = 1, open to the left."""
    gamma = result.parameters["gamma"]
    face, size = "white" if name == "rate_left" else None, 4 if gamma == "N" else 2
    return style.points(SIDES[name][0], style.BY_GAMMA[gamma][1], face, markersize=size, capsize=0)


def tabulate(result: Result, names: Iterable[str]) -> pd.DataFrame:
    """One row per quantity and position, with the deviation in percent of the mean. Files have the deviation of a rate from a straight
    line, and of a current from its mean over the bonds, each with its own error."""
    parts = []
    cells = int(result.parameters["cells"])
    for name in names:
        whole, deviation = result[name], result[f"{name}_deviation"]
        (axis,) = whole.axes
        scale = 100 / np.abs(whole.mean).mean()
        columns = {"x": (whole.axes[axis] + (0.5 if axis == "cell" else 0)) / cells}
        columns |= {"value": whole.mean, "error": whole.error, "line": whole.mean - deviation.mean}
        columns |= {
            "deviation_percent": scale * deviation.mean,
            "deviation_percent_error": scale * deviation.error,
        }
        labels = {"quantity": name, "units": whole.units, "gamma": setting.gamma(result), "cells": cells}
        parts.append(pd.DataFrame(columns).assign(**labels))
    return pd.concat(parts)


def draw_deviations(axes: Axes, result: Result, table: pd.DataFrame) -> None:
    """Plots the deviations of both rates from the fitted straight lines."""
    for name, part in table[table.quantity.isin(SIDES)].groupby("quantity", sort=False):
        label = rf"$\gamma = {setting.gamma(result)}$, {SIDES[name][1]}"
        axes.errorbar(
            part.x, part.deviation_percent, part.deviation_percent_error, **look_of(result, name), label=label
        )


def draw_excess(axes: Axes, results: Sequence[Result]) -> pd.DataFrame:
    """Plots the excess density of both end cells against the size, with a + b ln N fitted to the longer chains. Returns the table."""
    cells = np.array([int(result.parameters["cells"]) for result in results])
    fitted = cells >= FITTED
    tables = []
    for end, (name, marker, color, dashes) in enumerate(ENDS):
        excess = np.array([result["density_excess"].mean[end] for result in results])
        error = np.array([result["density_excess"].error[end] for result in results])
        line = fit_line(np.log(cells[fitted]), excess[fitted], error[fitted])
        axes.errorbar(cells, excess, error, **style.points(marker, color, "white", label=f"{name} end"))
        axes.plot(cells[fitted], line.at(np.log(cells[fitted])), color=color, linestyle=dashes)
        table = pd.DataFrame(
            {"quantity": f"density_excess {name}", "cells": cells, "value": excess, "error": error}
        )
        table["fitted"] = np.where(fitted, line.at(np.log(cells)), np.nan)
        table["slope"], table["slope_error"], table["chi_square"] = line.slope, line.error, line.chi_square
        tables.append(table.assign(units="1", gamma=setting.gamma(results[0])))
    return pd.concat(tables)


def caption(table: pd.DataFrame, profiles: Sequence[Result]) -> str:
    slopes = table[table.quantity.str.startswith("density_excess")].drop_duplicates("quantity")
    rates = table[table.quantity.isin(SIDES)]
    far = rates.loc[rates.deviation_percent.abs().groupby(rates.gamma, sort=False).idxmax()]
    largest = listed(
        f"{number:.2g} % at γ = {gamma}"
        for number, gamma in zip(far.deviation_percent.abs(), far.gamma, strict=True)
    )
    return f"""
        Arrival rates (a) deviate from straight lines by at most {largest} ({parameters(profiles, "cells", "sigma", "cell-length")},
        {baths(profiles[0])}). (b) The density of the end cells exceeds the line of the bulk. Lines show a + b ln N from N = {FITTED} on, with b =
        {listed(map(format_with_error, slopes.slope, slopes.slope_error))}. {ERRORS}"""


@plots("deterministic rare size")
def draw(results: Sequence[Result]) -> Parts:
    profiles = [result for result in results if result.series != "size"]
    sizes = [result for result in results if result.series != "deterministic"]
    sizes.sort(key=lambda result: result.parameters["cells"])
    figure, (deviations, excess) = plt.subplots(1, 2, figsize=(2 * style.COLUMN, style.HEIGHT))
    tables = [tabulate(result, (*SIDES, *CURRENTS)) for result in profiles]
    for result, table in zip(profiles, tables, strict=True):
        draw_deviations(deviations, result, table)
    table = pd.concat([*tables, draw_excess(excess, sizes)], ignore_index=True)
    deviations.axhline(0, **style.GUIDE)
    deviations.set(xlabel="$x$", ylabel="rate over line, minus 1 / %")
    deviations.legend(loc="upper right", handletextpad=0.2)
    excess.set(
        xscale="log", xlabel="number of cells $N$", ylabel="excess density of an end cell", ylim=(0, None)
    )
    excess.legend(loc="upper left", title=r"$\gamma = 1$")
    style.letter(deviations, excess)
    return figure, table, caption(table, profiles)


if __name__ == "__main__":
    by_row = dict.fromkeys(("value", "error", "line"), "column units")
    pure = dict.fromkeys(("x", "deviation_percent", "fitted", "slope", "chi_square"), "1")
    main(draw, "Linearity of the rates, and accumulation at the ends", **pure, **by_row)
