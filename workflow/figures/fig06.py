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
from workflow.lib.caption import format_number, listed, parameters
from workflow.lib.figure import Parts, plots
from workflow.lib.fit import format_with_error
from workflow.lib.load import Result
from workflow.physics.paper import PAPER

TITLE = "Waiting-time density for σ = 0 and 1/2"
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
    if sigma == 0:
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


def above_exact(table: pd.DataFrame, result: Result) -> str:
    """A sentence on the tail at sigma = 0 over the exact density of an infinite number of particles. A
    momentum that a scatterer holds flies again when the next particle arrives, on average after
    λ/(n⟨|p|⟩): to first order in 1/n slow flights are more frequent by ⟨p²⟩/(n⟨|p|⟩²) = π/2n."""
    tail = table[(table.tau > cut(result)) & ~table.unsure]
    if tail.empty:
        return ""
    exact = tail.gaussian_start
    # Weights by the counts that the exact density predicts: those observed would favour bins that are low.
    weight = tail.tau * exact
    mean = np.average(tail.density / exact, weights=weight)
    error = np.hypot.reduce(tail.tau * tail.density_error) / weight.sum()
    expected = 50 * np.pi / int(result.parameters["particles_per_cell"])
    excess = format_with_error(100 * (mean - 1), 100 * error)
    return f" At σ = 0 the tail is {excess} % above n → ∞ (expected: {expected:.2g} %)."


def caption(results: Sequence[Result], young: Sequence[Result], tables: Sequence[pd.DataFrame]) -> str:
    powers = listed(f"−{power} at σ = {format_number(sigma)}" for sigma, power in POWERS.items())
    exponents = listed(style.format_quantity(result["exponent"]) for result in results)
    pairs = zip(results, tables, strict=True)
    excess = [above_exact(table, result) for result, table in pairs if "gaussian_start" in table]
    return f"""
        The paper gives Ψ(τ) the exponents {powers}. Here ({parameters(results, "gamma", "particles_per_cell", paper=PAPER["fig06"])})
        they are {exponents} in the shaded windows.{"".join(excess)} Open: errors above {100 * UNSURE:.0f} %."""


@plots("all young", varying="sigma")
def draw(results: Sequence[Result]) -> Parts:
    young = [result for result in results if result.series == "young"]
    results = sorted(
        (result for result in results if result not in young), key=lambda result: result.parameters["sigma"]
    )
    tables = [tabulate(result) for result in results]
    figure, (above, *strips) = style.stacked(2.4, *[1] * len(results), height=0.8 + 0.5 * len(results))
    for strip, result, table, mark in zip(strips, results, tables, cycle(MARKS), strict=False):
        sigma = float(result.parameters["sigma"])
        power = POWERS.get(sigma, 2)
        exponent = style.format_quantity(result["exponent"])
        draw_density(above, table, mark, label=rf"$\sigma = {format_number(sigma)}$: $\tau^{{{exponent}}}$")
        draw_density(strip, table, mark, power)
        if sigma == 0:
            seen = table[table.gaussian_start > table.density.min()]
            exact: style.Look = {"color": style.SKY, "zorder": 0, "label": r"$\sigma = 0$, $n \to \infty$"}
            above.plot(seen.tau, seen.gaussian_start, **exact)
            strip.plot(table.tau, table.tau**3 * table.gaussian_start, **exact)
        typical = (table.tau**power * table.fitted).median()
        mark_outside(strip, table, mark[1], power, 2 * typical)
        strip.set(ylim=(0, 2 * typical), ylabel=rf"$\tau^{power}\,\Psi$, $\sigma = {format_number(sigma)}$")
    above.set(xscale="log", yscale="log", ylabel=r"density $\Psi(\tau)$")
    ends = [table.tau[~table.unsure].max() for table in tables]
    for axes, end in zip((above, *strips), (np.fmax.reduce(ends), *ends), strict=True):
        axes.axvspan(cut(results[0]), end, **style.WINDOW)
    strips[-1].set_xlabel(rf"waiting time $\tau$ ({style.UNIT_SYSTEM})")
    above.legend(loc="lower left")
    return figure, pd.concat(tables), caption(results, young, tables)
