"""Fig. 9: energy difference after a pulse, at several times; a: gamma = N, b: gamma = 1."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Result


def gaussian_start(results: Sequence[Result]) -> Result:
    """The run whose scatterers start at the temperature of the particles."""
    return next(result for result in results if result.parameters["scatterer-temperature"] == "particles")


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    result = gaussian_start(results)
    difference = result["energy_difference"]
    times = difference.axes["time"]
    distance = difference.axes["cell"] - len(difference.axes["cell"]) // 2
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    shown = np.linspace(1, len(times) - 1, 5).round().astype(int)
    parts = []
    for k, color, dashes in zip(shown, style.SEQUENCE, style.DASHES, strict=True):
        mean, error = difference.mean[k] / 1e3, difference.standard_error[k] / 1e3
        axes.plot(distance, mean, color=color, linestyle=dashes, label=f"$t = {times[k]:g}$")
        axes.fill_between(distance, mean - error, mean + error, color=color, alpha=0.3, linewidth=0)
        columns = {"time": times[k], "distance": distance, "energy_difference": difference.mean[k]}
        parts.append(pd.DataFrame({**columns, "energy_difference_error": difference.standard_error[k]}))
    axes.set(
        xlabel=r"distance from the central cell, $x/\lambda$",
        ylabel=rf"$\Delta E(x,t)\,/\,10^3$ ({style.UNITS})",
    )
    axes.legend(
        loc="upper right",
        title=rf"$\gamma = {style.gamma(result)}$, $\varepsilon^0 = {result.parameters['energy']:g}$",
    )
    return figure, pd.concat(parts)


if __name__ == "__main__":
    run(draw, "Energy per cell with a pulse minus without", distance="1")
