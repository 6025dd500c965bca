"""Fig. 6: density of waiting times for sigma = 0 and 1/2, with power laws of the fitted exponents.

At sigma = 0 momenta are only exchanged, so the density follows the start: the paper's Gaussian one gives
tau^-3 at long times, times exp(-lambda^2 / (2 T tau^2)) at all times.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Result

MARKS = {0.0: ("o", style.BLUE, "dashed"), 0.5: ("s", style.VERMILLION, "dotted")}


def gaussian_start(tau: np.ndarray, temperature: float, cell_length: float) -> np.ndarray:
    """Exact at sigma = 0 for n to infinity: |u| exp(-u^2/2T) at u = lambda/tau."""
    square = cell_length**2 / temperature
    return square / tau**3 * np.exp(-square / (2 * tau**2))


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    tables = []
    for result in sorted(results, key=lambda result: result.parameters["sigma"]):
        sigma = float(result.parameters["sigma"])
        marker, color, dashes = MARKS[sigma]
        density, exponent = result["density"], result["exponent"]
        tau = density.axes["tau"]
        known = (density.mean > 0) & (density.standard_error < 0.5 * density.mean)
        start = "Gaussian start, " if sigma == 0 else ""
        label = rf"$\sigma = {sigma:g}$: {start}$\tau^{{{style.with_error(exponent)}}}$"
        axes.errorbar(
            tau[known],
            density.mean[known],
            density.standard_error[known],
            marker=marker,
            color=color,
            markersize=2.5,
            label=label,
            **{**style.POINTS, "capsize": 0},
        )
        thermal = result.parameters["cell-length"] / np.sqrt(result.parameters["temperature"])
        from_cut = tau[known & (tau > result.parameters["tail-from"] * thermal)]
        anchor = np.searchsorted(tau, from_cut[0])
        law = density.mean[anchor] * (from_cut / tau[anchor]) ** float(exponent.mean)
        axes.plot(from_cut, law, color=style.BLACK, linestyle=dashes, zorder=5)
        columns = {
            "sigma": sigma,
            "tau": tau,
            "density": density.mean,
            "density_error": density.standard_error,
        }
        tables.append(pd.DataFrame(columns)[known])
        if sigma == 0:
            exact = gaussian_start(tau, result.parameters["temperature"], result.parameters["cell-length"])
            seen = known & (exact > 1e-9)
            axes.plot(
                tau[seen], exact[seen], color=style.SKY, zorder=0, label=r"$\sigma = 0$, $n \to \infty$"
            )
    axes.set(
        xscale="log",
        yscale="log",
        xlabel=rf"waiting time $\tau$ ({style.UNITS})",
        ylabel=r"density $\Psi(\tau)$",
    )
    axes.legend(loc="lower left")
    return figure, pd.concat(tables)


if __name__ == "__main__":
    run(draw, "Density of waiting times; at sigma = 0 it follows the start, which is Gaussian here")
