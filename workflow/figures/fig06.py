"""Fig. 6: density of waiting times for sigma = 0 and 1/2, with power laws of the fitted exponents.

Below, the density times the power of tau that the paper states. At sigma = 0 momenta are only exchanged, so
the density is that of the start: the paper's Gaussian one gives tau^-3 at long times, times exp(-lambda^2 /
(2 T tau^2)) at all times.
"""

from collections.abc import Sequence
from itertools import cycle

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, holds, plots
from workflow.lib.load import Result
from workflow.lib.text import format_number, format_quantity, listed

TITLE = "Density of waiting times"
UNITS = dict.fromkeys(("fitted", "gaussian_start"), "1/time")

Mark = tuple[str, str, str]  # marker, colour and dashes
MARKS: list[Mark] = [
    ("o", style.BLUE, "dashed"),
    ("s", style.VERMILLION, "dotted"),
    ("^", style.GREEN, "dashdot"),
]
POWERS = {0.0: 3, 0.5: 2}  # the paper's exponents, times -1, by sigma as configured
UNSURE = 0.5  # relative error above which a symbol is open


def gaussian_start(tau: np.ndarray, temperature: float, cell_length: float) -> np.ndarray:
    """Exact density of waiting times at sigma = 0 for n to infinity, from the flux |u| exp(-u^2/2T) at u =
    lambda/tau: as measured, averages over bins, whose geometric middles are tau. The density at a middle is
    0.7 % lower in a tail tau^-3 with ten bins per decade."""
    half = np.sqrt(tau[1] / tau[0])
    exponent = -(cell_length**2) / temperature / 2 / tau**2  # the probability of a shorter time is its exp
    above = np.expm1(exponent / half**2) - np.expm1(exponent * half**2)
    return above / (tau * (half - 1 / half))


def cut(result: Result) -> float:
    """Time from which on the tail is fitted."""
    options = result.parameters
    return float(options["tail_from"] * options["cell_length"] / np.sqrt(options["temperature"]))


def tabulate(result: Result) -> pd.DataFrame:
    """One row per bin that is not empty, with the fitted power law from the cut on and, at sigma = 0, the
    exact density. Without errors, as with one replica, the fit has equal weights."""
    density, options = result["density"], result.parameters
    sigma, tau = float(options["sigma"]), density.axes["tau"]
    table = pd.DataFrame({"tau": tau, "density": density.mean, "density_error": density.error})
    if holds([result], sigma=0, gamma="N", scatterer_temperature=(0, "particles")):
        table["gaussian_start"] = gaussian_start(tau, options["temperature"], options["cell_length"])
    table = table[table.density > 0].assign(unsure=lambda rows: ~(rows.density_error < UNSURE * rows.density))
    tail = table[table.tau > cut(result)]
    tail = tail[tail.unsure.all() | ~tail.unsure]
    shape = tail.tau ** float(result["exponent"].mean)
    weights = None if tail.unsure.all() else (shape / tail.density_error) ** 2
    table["fitted"] = np.average(tail.density / shape, weights=weights) * shape
    table.insert(0, "sigma", sigma)
    return table.reset_index(drop=True)


def draw_density(axes: Axes, table: pd.DataFrame, mark: Mark, power: float = 0, label: str = "") -> None:
    """Plots the density times tau^power with errors. Symbols are open where the error is large."""
    marker, color, dashes = mark
    scale = table.tau**power
    for part, look in ((~table.unsure, {"label": label}), (table.unsure, {"markerfacecolor": "white"})):
        y, error = (scale * table.density)[part], (scale * table.density_error)[part]
        common = style.points(marker, color, markersize=2.5, capsize=0)
        axes.errorbar(table.tau[part], y, error, **common | look)
    axes.plot(table.tau, scale * table.fitted, color=style.BLACK, linestyle=dashes, zorder=5)


def mark_outside(axes: Axes, table: pd.DataFrame, color: str, power: float, top: float) -> None:
    """Marks bins above the frame, which render counts, by triangles at its upper edge."""
    outside = table.tau[table.tau**power * table.density > top]
    # Without clipping a line that has no points would count for the layout, at the corner of the figure.
    if outside.empty:
        return
    look: style.Look = {"marker": "^", "color": color, "markerfacecolor": "white", "markersize": 3.5}
    axes.plot(outside, [top] * len(outside), linestyle="none", clip_on=False, zorder=6, **look)


def caption(results: Sequence[Result]) -> str:
    powers = listed(f"−{power} at σ = {format_number(sigma)}" for sigma, power in POWERS.items())
    products = listed(f"τ^{power}" for power in POWERS.values())
    text = f"""The paper finds that the density Ψ of waiting times τ has the exponents {powers}. Fits over
        the shaded times give {{exponents}}. Below: Ψ times {products}. Line: exact, σ = 0, n → ∞.
        Open symbols: errors above {100 * UNSURE:.0f} %. Empty bins are left out, which raises the end."""
    return fill(text, exponents=listed(format_quantity(result["exponent"]) for result in results))


@plots("all")
def draw(results: Sequence[Result]) -> Parts:
    results = sorted(results, key=lambda result: result.parameters["sigma"])
    tables = [tabulate(result) for result in results]
    figure, (above, *strips) = style.stacked(2.4, *[1] * len(results), height=0.8 + 0.5 * len(results))
    for strip, result, table, mark in zip(strips, results, tables, cycle(MARKS), strict=False):
        sigma = float(result.parameters["sigma"])
        power = POWERS.get(sigma, 2)
        exponent = format_quantity(result["exponent"])
        draw_density(above, table, mark, label=rf"$\sigma = {format_number(sigma)}$: $\tau^{{{exponent}}}$")
        draw_density(strip, table, mark, power)
        if "gaussian_start" in table:
            seen = table[table.gaussian_start > table.density.min()]
            exact: style.Look = {"color": style.SKY, "zorder": 0, "label": r"$\sigma = 0$, $n \to \infty$"}
            above.plot(seen.tau, seen.gaussian_start, **exact)
            strip.plot(table.tau, table.tau**3 * table.gaussian_start, **exact)
        typical = (table.tau**power * table.fitted).median()
        mark_outside(strip, table, mark[1], power, 2 * typical)
        strip.set(ylim=(0, 2 * typical), ylabel=rf"$\tau^{power}\,\Psi$, $\sigma = {format_number(sigma)}$")
    above.set(xscale="log", yscale="log", ylabel=r"density $\Psi(\tau)$")
    right = above.get_xlim()[1]
    for axes in (above, *strips):
        axes.axvspan(cut(results[0]), right, **style.WINDOW)
    above.set_xlim(right=right)
    strips[-1].set_xlabel(rf"waiting time $\tau$ ({style.UNIT_SYSTEM})")
    above.legend(loc="lower left")
    return figure, pd.concat(tables), caption(results)
