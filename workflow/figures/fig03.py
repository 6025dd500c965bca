"""Fig. 3: momentum distribution of the particles at both ends, by the kinetic equation.

Below, each half over the Gaussian of its own rate and temperature, also for baths of one temperature. The table has also the
case sigma = 0, whose halves are Gaussian.
"""

from collections.abc import Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import BATHS, listed, number, parameters
from workflow.lib.figure import run
from workflow.lib.load import Result

ENDS = [(0, "x = 0", style.BLUE, "solid"), (-1, "x = 1", style.VERMILLION, (0, (4, 1.5)))]
PAPER, EQUAL, EXCHANGE = "as in the paper", "equal temperatures", "sigma = 0"
SHOWN = 45


def case(result: Result) -> str:
    if result.parameters["sigma"] == 0:
        return EXCHANGE
    equal = result.parameters["temperature-left"] == result.parameters["temperature-right"]
    return EQUAL if equal else PAPER


def gaussian_half(momentum: np.ndarray, flux: np.ndarray) -> np.ndarray:
    """Of the same integral and second moment on the same half line, by the midpoint rule."""
    square = np.average(momentum**2, weights=flux)
    rate = flux.sum() * (momentum[1] - momentum[0])
    gaussian: np.ndarray = rate * np.sqrt(2 / (np.pi * square)) * np.exp(-(momentum**2) / (2 * square))
    return gaussian


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per case, end and momentum."""
    parts = []
    for result in results:
        density = result["flux_density"]
        momentum = density.axes["momentum"]
        for index, place, *_ in ENDS:
            flux = density.mean[index]
            part = pd.DataFrame({"case": case(result), "x": place, "momentum": momentum, "flux": flux})
            halves = (momentum < 0, momentum > 0)
            part["gaussian"] = np.concatenate([gaussian_half(momentum[h], flux[h]) for h in halves])
            part["kurtosis"] = np.where(momentum > 0, *result["kurtosis"].mean[index][::-1])
            part["jump"] = result["jump"].mean[index]
            parts.append(part)
    return pd.concat(parts, ignore_index=True)


def draw_halves(axes: Axes, part: pd.DataFrame, values: pd.Series, **look: Any) -> None:
    """Not joined across the jump."""
    for half in (part.momentum < 0, part.momentum > 0):
        axes.plot(part.momentum[half], values[half], **look)
        look.pop("label", None)


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    paper, equal = ([result for result in results if case(result) == name] for name in (PAPER, EQUAL))
    rows = table[table.case == PAPER].drop_duplicates("x")
    jumps = [f"{one.jump:.4f} at {one.x}" for one in rows.itertuples()]
    kurtosis = table.groupby("case")["kurtosis"].max()

    def leaving(name: str) -> str:
        """Those that leave: to the left at the left end, to the right at the right one."""
        part = table[table.case == name]
        left, right = (
            part[(part.x == place) & ((part.momentum < 0) == (place == ENDS[0][1]))]["kurtosis"].iloc[0]
            for _, place, *_ in ENDS
        )
        return f"{number(left)} at the left and {number(right)} at the right end"

    return f"""
        Flux distribution F(p, x) of the particles at the left (solid) and the right end (dashed) of the system by the kinetic equation,
        {parameters(paper, "sigma", "gamma", *BATHS)}. (a) F; it jumps at momentum zero by {listed(jumps)}. (b) Each half over the Gaussian
        half of its own rate and second moment: what a bath injects is Gaussian, what leaves is not, with kurtoses <p⁴>/<p²>² of
        {leaving(PAPER)} (a Gaussian has three). Dotted: the same for baths with
        {parameters(equal, *BATHS)}, with kurtoses of {leaving(EQUAL)}; at σ = 0, where momenta are only exchanged, all halves stay Gaussian,
        with kurtoses up to {number(kurtosis[EXCHANGE])}. Numerical errors, below
        {paper[0].provenance["achieved_error"]:.0e} of the currents, are thinner than a line. The paper has the same jump and the same halves, and says that halves are
        Gaussian only if the temperatures are equal: at σ = 0 they are Gaussian at unequal ones, and at equal ones unequal rates still
        make them differ from a Gaussian."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table = tabulate(results)
    figure, (above, below) = plt.subplots(
        2, 1, sharex=True, figsize=(style.COLUMN, 1.5 * style.HEIGHT), height_ratios=[2, 1]
    )
    departure = 100 * (table.flux / table.gaussian - 1)
    often = departure[table.flux > table.flux.max() / 100]
    for _, place, color, dashes in ENDS:
        ends = table[table.x == place]
        for name, look in (
            (PAPER, {"linestyle": dashes}),
            (EQUAL, {"linestyle": "dotted", "linewidth": 0.8}),
        ):
            part = ends[ends.case == name]
            if name == PAPER:
                draw_halves(above, part, part.flux, color=color, label=f"${place}$", **look)
            draw_halves(below, part, departure[part.index], color=color, **look)
    for axes in (above, below):
        axes.axvline(0, **style.GUIDE)
    above.set(ylabel="$F(p, x)$", xlim=(-SHOWN, SHOWN), ylim=(0, None))
    below.set_ylim(1.3 * often.min(), 1.3 * often.max())
    below.plot([], [], color="grey", linestyle="dotted", label="$T_L = T_R$")
    below.set(xlabel=f"momentum $p$ ({style.UNITS})", ylabel="$F$ over Gaussian,\nminus 1 / %")
    above.legend(loc="upper right")
    below.legend(loc="best")
    style.letter(above, below)
    figure.align_ylabels()
    return figure, table, caption(table, results)


if __name__ == "__main__":
    run(
        draw,
        "Momentum distribution of the particles at both ends, by the kinetic equation",
        gaussian="1/(time momentum)",
    )
