"""Fig. 1: momentum distribution of the particles in an empty chain that fills, times |p|, at several times.

With three distances between scatterers, as the paper states none; below on logarithmic bins, with the fronts p_0(t).
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Quantity, Result


def plot_times(axes: Axes, density: Quantity, axis: str) -> list[pd.DataFrame]:
    """One curve with its error band per time; returns their tables."""
    x, parts = density.axes[axis], []
    curves = zip(density.axes["time"], density.mean, density.standard_error, strict=True)
    for (time, mean, error), color, dashes in zip(curves, style.SEQUENCE, style.DASHES, strict=True):
        axes.plot(x, mean, color=color, linestyle=dashes, label=f"$t = {time:g}$")
        axes.fill_between(x, mean - error, mean + error, color=color, alpha=0.3, linewidth=0)
        columns = {"bins": axis, "time": time, "momentum": x, "weighted_density": mean}
        parts.append(pd.DataFrame({**columns, "error": error}))
    return parts


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    figure, rows = plt.subplots(2, len(results), figsize=(3 * style.COLUMN, 2 * style.HEIGHT), sharex="row")
    tables = []
    for (above, below), result in zip(rows.T, results, strict=True):
        length, spacing = style.spacing(result)
        linear = plot_times(above, result["weighted_momentum_density"], "p")
        logarithmic = plot_times(below, result["weighted_speed_density"], "speed")
        front, plateau = result["front"], result["plateau"]
        look = {"marker": "o", "color": style.BLACK, "markerfacecolor": "white", **style.POINTS}
        below.errorbar(front.mean, plateau.mean / 2, xerr=front.standard_error, **look, label="$p_0(t)$")
        label = rf"$p_0 \sim t^{{{style.with_error(result['front_exponent'])}}}$"
        below.text(0.04, 0.9, label, transform=below.transAxes)
        above.set(
            title=rf"$\lambda = {spacing}$", xlabel=f"momentum $p$ ({style.UNITS})", ylabel=r"$|p|\,n_t(p)$"
        )
        below.set(xscale="log", xlabel=r"$|p|$", ylabel=r"$|p|\,n_t(|p|)$")
        for axes in (above, below):
            axes.set_ylim(bottom=0)
        for part in (*linear, *logarithmic):
            part.insert(0, "cell_length", length)
            tables.append(part)
    figure.legend(*rows[1, 0].get_legend_handles_labels(), loc="outside upper center", ncols=6)
    return figure, pd.concat(tables)


if __name__ == "__main__":
    density = {"weighted_density": "1", "error": "1"}
    run(draw, "Momentum distribution of the particles inside, times momentum", momentum="momentum", **density)
