"""Fig. 1: momentum distribution of the particles in an empty chain that fills, times |p|, at several times.

With three distances between scatterers, as the paper states none. Below on logarithmic bins, with the fronts p_0(t), and
the fronts over lambda/2t, which they are expected to follow.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import BATHS, ERRORS, listed, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import fit_power, with_error
from workflow.lib.load import Result

FRONT = {"marker": "o", "color": style.BLACK, "markerfacecolor": "white", **style.POINTS}


def geometric_mean(values: pd.Series) -> float:
    return float(np.exp(np.log(values).mean()))


def in_pairs(result: Result, bins: str, quantity: str, axis: str) -> pd.DataFrame:
    """One row per time and two neighbouring bins of the file, whose counts are nearly independent."""
    frame = result[quantity].to_frame()
    pairs = frame.groupby([frame.time, frame.groupby("time").cumcount() // 2])
    joined = pairs[["mean"]].mean()
    joined["momentum"] = pairs[axis].agg(geometric_mean if bins == "speed" else "mean")
    squares = (frame.standard_error**2).groupby(pairs.ngroup()).sum()
    joined["standard_error"] = np.sqrt(squares.to_numpy()) / pairs.size().to_numpy()
    return joined.reset_index().assign(bins=bins)


def tabulate(result: Result) -> pd.DataFrame:
    """Both, with the front and the height above it at every time."""
    columns = {"mean": "weighted_density", "standard_error": "error"}
    of_momentum = in_pairs(result, "momentum", "weighted_momentum_density", "p")
    of_speed = in_pairs(result, "speed", "weighted_speed_density", "speed")
    table = pd.concat([of_momentum, of_speed]).rename(columns=columns)
    table = table[["bins", "time", "momentum", "weighted_density", "error"]]
    for name in ("front", "plateau"):
        quantity = result[name]
        for column, values in ((name, quantity.mean), (f"{name}_error", quantity.error)):
            table[column] = table.time.map(dict(zip(quantity.axes["time"], values, strict=True)))
    table.insert(0, "cell_length", style.spacing(result)[0])
    return table


def plot_times(axes: Axes, table: pd.DataFrame) -> None:
    """One curve with its error band per time."""
    curves = zip(table.groupby("time"), style.SEQUENCE, style.DASHES, strict=True)
    for (time, part), color, dashes in curves:
        axes.plot(
            part.momentum, part.weighted_density, color=color, linestyle=dashes, label=f"$t = {time:g}$"
        )
        low, high = (part.weighted_density + sign * part.error for sign in (-1, 1))
        axes.fill_between(part.momentum, low, high, color=color, alpha=0.3, linewidth=0)
    axes.set_ylim(bottom=0)


def fronts(table: pd.DataFrame) -> pd.DataFrame:
    """One row per time, with the front over lambda/2t."""
    rows = table.drop_duplicates("time")
    expected = rows.cell_length / (2 * rows.time)
    return rows.assign(ratio=rows.front / expected, ratio_error=rows.front_error / expected)


def said_of_front(result: Result, table: pd.DataFrame) -> str:
    """Exponent of p_0 over all times, and without the first."""
    late = fronts(table).iloc[1:]
    without = fit_power(late.time, late.front, late.front_error)
    return (
        f"{style.with_error(result['front_exponent'])} at λ = {style.spacing(result)[1]} ({without.text} "
        "without the first time)"
    )


def ends_of_front(result: Result, table: pd.DataFrame) -> str:
    """p_0 over lambda/2t at the first time and at the last."""
    first, last = fronts(table)[["ratio", "ratio_error"]].iloc[[0, -1]].to_numpy()
    return f"from {with_error(*first)} to {with_error(*last)} at λ = {style.spacing(result)[1]}"


def by_spacing(results: Sequence[Result]) -> list[Result]:
    """The paper's own first, as 1/N is the shortest."""
    return sorted(results, key=lambda result: style.spacing(result)[0])


def caption(tables: Sequence[pd.DataFrame], results: Sequence[Result]) -> str:
    exponents = [said_of_front(result, table) for result, table in zip(results, tables, strict=True)]
    ends = [ends_of_front(result, table) for result, table in zip(results, tables, strict=True)]
    return f"""
        Filling of an empty chain: number n_t(p) of particles with momentum p inside, per unit momentum, times |p|, at five times t;
        {parameters(results, "cells", "sigma", "gamma", *BATHS)}, {replicas(results)}. The paper does not state the distance λ
        between scatterers; each column has another. Above against p, as in the paper; in the middle both signs together against
        |p| on logarithmic bins, with circles at the front p_0(t), where the density has fallen to half of its height
        above; below p_0 over λ/2t, which a particle's time of flight to the next scatterer suggests: from the first time to the
        last {listed(ends)}. {ERRORS}, as bands and bars. Exponents of p_0 ~ t^a:
        {"; ".join(exponents)}; what the first time changes is their systematic error. The paper says that p_0 falls logarithmically.
        Above p_0 the density is stationary where the chain has filled. What the paper says of this figure is judged at λ =
        {style.spacing(results[0])[1]}, the spacing of its other open chains."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    figure, rows = plt.subplots(
        3,
        len(results),
        figsize=(3 * style.COLUMN, 2.3 * style.HEIGHT),
        sharex="row",
        height_ratios=[2, 2, 1],
    )
    results = by_spacing(results)
    tables = [tabulate(result) for result in results]
    for (above, middle, below), result, table in zip(rows.T, results, tables, strict=True):
        plot_times(above, table[table.bins == "momentum"])
        plot_times(middle, table[table.bins == "speed"])
        front = fronts(table)
        middle.errorbar(front.front, front.plateau / 2, xerr=front.front_error, **FRONT, label="$p_0(t)$")
        below.errorbar(front.time, front.ratio, front.ratio_error, **FRONT)
        below.axhline(1, **style.GUIDE)
        above.text(0.04, 0.9, rf"$\lambda = {style.spacing(result)[1]}$", transform=above.transAxes, va="top")
        above.set(xlabel=f"momentum $p$ ({style.UNITS})", ylabel=r"$|p|\,n_t(p)$", xlim=(-40, 40))
        middle.set(xscale="log", xlabel=r"$|p|$", ylabel=r"$|p|\,n_t(|p|)$")
        below.set(
            xlabel="time $t$", ylabel=r"$p_0\,/\,(\lambda/2t)$", ylim=(0, 1.3 * max(1, front.ratio.max()))
        )
    style.letter(*rows.flat)
    figure.legend(*rows[1, 0].get_legend_handles_labels(), loc="outside upper center", ncols=6)
    return figure, pd.concat(tables), caption(tables, results)


if __name__ == "__main__":
    density = {"weighted_density": "1", "error": "1"}
    run(draw, "Momentum distribution of the particles inside, times momentum", momentum="momentum", **density)
