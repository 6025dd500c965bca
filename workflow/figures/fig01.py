"""Fig. 1: momentum distribution of the particles in an empty chain that fills, times |p|, at several times.

Where the chain is stationary above the front, the curves of all times coincide.

Shown for several distances between scatterers, as the paper states none. Below, the same on logarithmic bins,
with the fronts p_0(t), and the fronts over lambda/et, where a stationary flux has them.
"""

from collections.abc import Sequence
from itertools import cycle

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, holds, plots
from workflow.lib.load import Result
from workflow.lib.text import format_quantity, listed
from workflow.physics import run_parameters

TITLE = "Momentum distribution of the particles in a filling chain"
SURE = 5  # standard errors above which a change is significant
UNITS = {"weighted_density": "1", "error": "1", "momentum": "momentum"}

FRONT = style.points("o", style.BLACK, "white")


def tabulate(result: Result) -> pd.DataFrame:
    """Densities on bins of either kind, with the front and the height above it at every time."""
    kinds = {"momentum": ("weighted_momentum_density", "p"), "speed": ("weighted_speed_density", "speed")}
    parts = []
    for bins, (quantity, axis) in kinds.items():
        frame = result[quantity].to_frame().rename(columns={axis: "momentum", "mean": "weighted_density"})
        frame["error"] = frame.standard_error
        parts.append(frame[["time", "momentum", "weighted_density", "error"]].assign(bins=bins))
    table = pd.concat(parts)
    for name in ("front", "plateau"):
        estimate = result[name]
        for column, values in ((name, estimate.mean), (f"{name}_error", estimate.error)):
            table[column] = table.time.map(dict(zip(estimate.axes["time"], values, strict=True)))
    table.insert(0, "cell_length", run_parameters.spacing(result)[0])
    return table


def plot_times(axes: Axes, table: pd.DataFrame) -> None:
    """One curve with its error band for each time, in a colour that depends on the time."""
    looks = zip(table.groupby("time"), cycle(style.SEQUENCE), cycle(style.DASHES), strict=False)
    for (time, part), color, dashes in looks:
        label = f"$t = {time:g}$"
        axes.plot(part.momentum, part.weighted_density, color=color, linestyle=dashes, label=label)
        style.band(axes, part.momentum, part.weighted_density, part.error, color)
    axes.set_ylim(bottom=0)


def number_bins(axes: Axes, result: Result) -> None:
    """Adds an upper axis with the numbers of the bins, the abscissa of the paper."""
    low = float(result.parameters["momentum_max"])
    width = 2 * low / int(result.parameters["momentum_bins"])
    scales = (lambda p: (p + low) / width, lambda k: k * width - low)
    axes.tick_params(axis="x", which="both", top=False)
    axes.secondary_xaxis("top", functions=scales).set_xlabel("bin number")


def is_filling(result: Result) -> bool:
    """Whether the height above the front still grows."""
    height = result["plateau"]
    return bool(height.mean[-1] - height.mean[0] > SURE * np.hypot(*height.error[[0, -1]]))


def caption(results: Sequence[Result]) -> str:
    chain, filling = results[0], [run_parameters.spacing(one)[1] for one in results if is_filling(one)]
    first, last = (format_quantity(chain["plateau"], k) for k in (0, -1))
    text = """The paper finds |p| n_t(p) stationary above a front p₀(t), which falls. Top: linear bins;
        middle: logarithmic bins, summed over both signs of p, with p₀(t) (circles). At λ = {spacing} the
        height above p₀ is {first} at the first time and {last} at the last. Bottom: p₀ divided by λ/(et),
        its value for a stationary flux. At λ = {filling} the chain still fills."""
    spacings = {"spacing": run_parameters.spacing(chain)[1], "filling": listed(filling) if filling else None}
    return fill(text, first=first, last=last, **spacings)


@plots("unit-spacing unit-chain", varied="cell_length")
def draw(results: Sequence[Result]) -> Parts:
    results = run_parameters.in_order_of_spacing(results)
    size = (len(results) * style.COLUMN, 2.3 * style.HEIGHT)
    figure, rows = plt.subplots(
        3, len(results), figsize=size, sharex="row", height_ratios=[2, 2, 1], squeeze=False
    )
    tables = [tabulate(result) for result in results]
    for (above, middle, below), result, table in zip(rows.T, results, tables, strict=True):
        plot_times(above, table[table.bins == "momentum"])
        plot_times(middle, table[table.bins == "speed"])
        front = table.drop_duplicates("time")
        expected = front.cell_length / (np.e * front.time)
        middle.errorbar(front.front, front.plateau / np.e, xerr=front.front_error, **FRONT, label="$p_0(t)$")
        ratio = front.front / expected
        below.errorbar(front.time, ratio, front.front_error / expected, **FRONT)
        if holds([result], gamma="N"):
            below.axhline(1, **style.GUIDE)
        name = rf"$\lambda = {run_parameters.spacing(result)[1]}$"
        above.text(0.04, 0.94, name, transform=above.transAxes, va="top")
        above.set(xlabel=f"momentum $p$ ({style.UNIT_SYSTEM})", ylabel=r"$|p|\,n_t(p)$")
        above.margins(x=0)
        number_bins(above, result)
        middle.set(xscale="log", xlabel=r"$|p|$", ylabel=r"$|p|\,n_t(|p|)$")
        below.set(xlabel="time $t$", ylabel=r"$p_0\,/\,(\lambda/\mathrm{e}t)$")
        below.sharey(rows[-1, 0])
    rows[-1, 0].margins(y=0.3)
    style.letter(*rows[0], lift=26)
    style.letter(*rows[1:].flat, first=len(results))
    curves = rows[1, 0].get_legend_handles_labels()
    figure.legend(*curves, loc="outside upper center", ncols=3 * len(results) // 2)
    return figure, pd.concat(tables), caption(results)
