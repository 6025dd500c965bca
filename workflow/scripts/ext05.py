"""Ext. 5: rates and currents along an open chain, and the accumulation of particles at its ends."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.scripts import style
from workflow.scripts.figure import run
from workflow.scripts.load import Quantity, Result


def deviation(quantity: Quantity, x: np.ndarray, degree: int) -> tuple[np.ndarray, np.ndarray]:
    """From the weighted polynomial, in percent of its mean, with the error."""
    fit = np.polyfit(x, quantity.mean, degree, w=1 / quantity.standard_error)
    scale = 100 / np.abs(quantity.mean).mean()
    return scale * (quantity.mean - np.polyval(fit, x)), scale * quantity.standard_error


def plot_deviations(axes: Axes, result: Result, curves: dict, look: dict) -> list[pd.DataFrame]:
    tables = []
    for (name, degree), (marker, face) in curves.items():
        quantity = result[name]
        (axis,) = quantity.axes
        cells = result.parameters["cells"]
        x = (quantity.axes[axis] + (0.5 if axis == "cell" else 0)) / cells
        percent, error = deviation(quantity, x, degree)
        label = rf"{name.replace('_', ' ')}, $\gamma = {style.gamma(result)}$"
        axes.errorbar(x, percent, error, marker=marker, markerfacecolor=face, label=label, **look)
        table = pd.DataFrame(
            {"quantity": name, "x": x, "value": quantity.mean, "error": quantity.standard_error}
        )
        table["units"], table["deviation_percent"] = quantity.units, percent
        tables.append(table.assign(gamma=style.gamma(result), cells=cells))
    return tables


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    profiles = [result for result in results if result.parameters["cells"] == 30]
    sizes = [result for result in results if style.gamma(result) == "1"]
    sizes.sort(key=lambda result: result.parameters["cells"])
    figure, (rates, currents, density) = plt.subplots(3, 1, figsize=(style.COLUMN, 2.6 * style.HEIGHT))
    tables = []
    for result in profiles:
        color = style.BY_GAMMA[result.parameters["gamma"]][1]
        look = {"color": color, **style.POINTS}
        sides = {("rate_right", 1): (">", color), ("rate_left", 1): ("<", "white")}
        kinds = {("particle_current", 0): ("o", "white"), ("energy_current", 0): ("s", color)}
        tables += plot_deviations(rates, result, sides, look)
        tables += plot_deviations(currents, result, kinds, look)
    for result, color, dashes in zip(sizes, style.SEQUENCE, style.DASHES, strict=False):
        cells, rho = int(result.parameters["cells"]), result["density"]
        x = (rho.axes["cell"] + 0.5) / cells
        middle = rho.mean[cells // 4 : -(cells // 4)].mean()
        ratio, error = rho.mean / middle, rho.standard_error / middle
        density.plot(x, ratio, color=color, linestyle=dashes, label=f"$N = {cells}$")
        density.fill_between(x, ratio - error, ratio + error, color=color, alpha=0.3, linewidth=0)
        table = pd.DataFrame({"quantity": "density", "x": x, "value": rho.mean, "error": rho.standard_error})
        tables.append(table.assign(units=rho.units, gamma=style.gamma(result), cells=cells))
    rates.set(xlabel="$x$", ylabel="rates minus line / %")
    currents.set(xlabel="$x$", ylabel="currents minus mean / %")
    density.set(xlabel="$x$", ylabel=r"$\rho(x)$ / middle half")
    density.legend(loc="best", title=r"$\gamma = 1$")
    for axes in (rates, currents):
        axes.axhline(0, **style.GUIDE)
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.55 * (high - low))
        axes.legend(loc="upper center", ncols=2, fontsize=6.5)
    return figure, pd.concat(tables)


if __name__ == "__main__":
    by_row = {"value": "column units", "error": "column units"}
    run(draw, "Rates, currents and density along the chain", x="1", deviation_percent="1", **by_row)
