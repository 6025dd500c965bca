"""Fig. 3: momentum distribution of the particles at both ends, by the Boltzmann equation.

Below, each half over the Gaussian of its own rate and second moment, also for baths of equal temperatures.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, plots
from workflow.lib.load import Result
from workflow.lib.text import format_number
from workflow.physics import run_parameters
from workflow.physics.fluxes import reach

TITLE = "Momentum distribution of the particles at both ends, by the Boltzmann equation"
UNITS = {"gaussian": "1/(time momentum)"}

ENDS = [(0, "x = 0", style.BLUE, "solid"), (-1, "x = 1", style.VERMILLION, (0, (4, 1.5)))]
PAPERS, EQUAL = "as in the paper", "equal temperatures"
OFTEN = 0.01  # fraction of the largest flux above which the ratio to a Gaussian is shown


def case(result: Result) -> str:
    left, right = result.ends("temperature")
    return EQUAL if left == right else PAPERS


def gaussian_half(momentum: np.ndarray, flux: np.ndarray) -> np.ndarray:
    """Gaussian on a half line with the integral and the second moment of the flux, by the midpoint rule."""
    square = np.average(momentum**2, weights=flux)
    rate = flux.sum() * (momentum[1] - momentum[0])
    return rate * np.sqrt(2 / (np.pi * square)) * np.exp(-(momentum**2) / (2 * square))


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per case, end and momentum."""
    parts = []
    for result in results:
        density = result["flux_density"]
        momentum = density.axes["momentum"]
        for index, end, *_ in ENDS:
            flux = density.mean[index]
            part = pd.DataFrame({"case": case(result), "x": end, "momentum": momentum, "flux": flux})
            halves = (momentum < 0, momentum > 0)
            part["gaussian"] = np.concatenate([gaussian_half(momentum[h], flux[h]) for h in halves])
            part["kurtosis"] = np.where(momentum > 0, *result["kurtosis"].mean[index][::-1])
            part["jump"] = result["jump"].mean[index]
            parts.append(part)
    return pd.concat(parts, ignore_index=True)


def draw_halves(axes: Axes, part: pd.DataFrame, values: pd.Series, **look: Any) -> None:
    """Plots the halves p < 0 and p > 0 as separate curves, as F jumps at p = 0."""
    for half in (part.momentum < 0, part.momentum > 0):
        axes.plot(part.momentum[half], values[half], **look)
        look.pop("label", None)


def caption(results: Sequence[Result], largest: float) -> str:
    paper = next((result for result in results if case(result) == PAPERS), results[0])
    left, right = (format_number(float(f"{paper['jump'].mean[index]:.4g}")) for index, *_ in ENDS)
    text = f"""The paper finds that the distribution F(p, x) jumps at p = 0. (a) At the ends it
        jumps by {{left}} and {{right}}. (b) Each half divided by a Gaussian of its own rate and second
        moment, where F exceeds {100 * OFTEN:g} % of its maximum: up to {{largest}} % off. Dotted:
        equal temperatures, unequal rates. Flat halves: the injected Gaussians."""
    return fill(text, left=left, right=right, largest=f"{largest:.2g}")


@plots("paper equal", varied="temperature_left temperature_right")
def draw(results: Sequence[Result]) -> Parts:
    table = tabulate(results)
    shown = reach(results[0]["flux_density"])
    figure, (above, below) = style.stacked(2, 1, height=1.5, width=1.1)
    departure = (100 * (table.flux / table.gaussian - 1)).where(table.flux > OFTEN * table.flux.max())
    for _, end, color, dashes in ENDS:
        ends = table[(table.x == end) & (table.momentum.abs() < shown)]
        paper, equal = (ends[ends.case == name] for name in (PAPERS, EQUAL))
        draw_halves(above, paper, paper.flux, color=color, linestyle=dashes, label=f"${end}$")
        draw_halves(below, paper, departure[paper.index], color=color, linestyle=dashes)
        draw_halves(below, equal, departure[equal.index], color=color, linestyle="dotted", linewidth=0.8)
    for axes in (above, below):
        axes.axvline(0, **style.GUIDE)
    above.set(ylabel="$F(p, x)$", xlim=(-shown, shown), ylim=(0, None))
    style.second_axis(above, 1 / run_parameters.both_rates(results[0]), r"$F/(\nu_L + \nu_R)$")
    if EQUAL in map(case, results):
        below.plot([], [], color="grey", linestyle="dotted", label="$T_L = T_R$")
        below.legend(loc="best")
    below.set(xlabel=f"momentum $p$ ({style.UNIT_SYSTEM})", ylabel="$F$ / Gaussian\nminus 1, in %")
    above.legend(loc="upper right")
    outgoing = float(departure[table.case == PAPERS].abs().max())
    return figure, table, caption(results, outgoing)
