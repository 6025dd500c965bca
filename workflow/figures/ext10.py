"""Ext. 10: equilibrium between equal baths. Flux of the particles and momenta of the end scatterers against the Gaussian at the
temperature of the baths.

Left: flux F_N of the particles that leave at both ends. Right: density g of P/sqrt(M) of the end scatterers. Both are divided by the
exact value of the bin, minus 1. The table has chi^2 over the bins shown, and the Kolmogorov-Smirnov distance.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, WINDOW, baths, number, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import with_error
from workflow.lib.fluxes import Curve, end_scatterers, largest_distance, outgoing_flux
from workflow.lib.load import Result

SEEN = 1e-3  # probability of the rarest bins that are shown


def plot(axes: Axes, result: Result, curve: Curve, units: str, shift: float) -> pd.DataFrame:
    momentum, measured, error, exact = curve
    seen = exact * (momentum[1] - momentum[0]) > SEEN * exact.sum() * (momentum[1] - momentum[0])
    momentum, measured, error, exact = (array[seen] for array in (momentum, measured, error, exact))
    chi_square = float(np.sum(((measured - exact) / error) ** 2))
    distance, distance_error = largest_distance(measured, error, exact)
    look = style.points(*style.BY_GAMMA[result.parameters["gamma"]], "white", markersize=2.5)
    label = rf"$\gamma = {style.gamma(result)}$"
    axes.errorbar(momentum + shift, 100 * (measured / exact - 1), 100 * error / exact, label=label, **look)
    table = pd.DataFrame({"momentum": momentum, "found": measured, "found_error": error, "exact": exact})
    table.insert(0, "gamma", style.gamma(result))
    return table.assign(units=units, chi_square=chi_square, distance=distance, distance_error=distance_error)


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    farthest = table.sort_values("distance").iloc[-1]
    return f"""
        Open chain in equilibrium, between equal baths; {parameters(results, "cells", "cell-length", "sigma")}, {baths(results[0])}, {parameters(results, *WINDOW)},
        {replicas(results)}, at γ = N (circles) and γ = 1 (squares). (a) Flux of the particles that leave at both ends over the Gaussian of the
        rate and temperature of the baths, minus one. (b) Density of the momenta of the end scatterers over the Gaussian at the temperature of the baths, minus one. Bins
        of a probability above {number(100 * SEEN)} %; nothing is fitted. As the paper states both are Gaussian: the largest distance between the
        distribution functions is {with_error(100 * farthest.distance, 100 * farthest.distance_error)} %. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    figure, columns = plt.subplots(1, 2, figsize=(2 * style.COLUMN, 1.1 * style.HEIGHT))
    kinds = {
        "momentum_flux": (columns[0], outgoing_flux, "flux"),
        "steady_profile": (columns[1], end_scatterers, "scatterer_density"),
    }
    tables = []
    for result in sorted(results, key=style.gamma, reverse=True):  # so that gamma = N is plotted first
        axes, curve, name = kinds[result.provenance["program"]]
        shift = 0.2 if style.gamma(result) == "1" else -0.2
        table = plot(axes, result, curve(result), result[name].units, shift)
        table.insert(0, "quantity", name)
        tables.append(table)
    columns[0].set(
        xlabel=f"momentum $p$ ({style.UNITS})", ylabel="flux that leaves over Gaussian, minus 1 / %"
    )
    columns[1].set(xlabel=r"momentum $P/\sqrt{M}$", ylabel="end scatterers over Gaussian, minus 1 / %")
    for axes in columns:
        axes.axhline(0, **style.GUIDE)
    figure.legend(*columns[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    style.letter(*columns)
    table = pd.concat(tables)
    return figure, table, caption(table, results)


if __name__ == "__main__":
    by_row = {"found": "column units", "exact": "column units"}
    run(draw, "Momentum distributions in equilibrium", chi_square="1", distance="1", **by_row)
