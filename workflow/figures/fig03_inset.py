"""Fig. 3, inset: finite chains against the kinetic equation, in the halves that leave the chain.

F_N(p, 0) for p < 0 and F_N(p, 1) for p > 0, both averaged over the bins, minus F, in units of the largest F.
Lines: the mean field, the kinetic equation of N scatterers.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import BATHS, ERRORS, WINDOW, goodness, listed, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import PowerLaw, fit_power, with_error
from workflow.lib.load import Result

LOWEST, HIGHEST = 6e-4, 0.2  # of the deviations that are shown
LIMITS = [(1e-3, "0.1 %"), (1e-4, "0.01 %")]  # of the paper
SIMULATION, MEAN_FIELD = "simulation", "mean field"
MARKERS = ["o", "s", "^", "D"]  # by N


def outgoing(values: np.ndarray, momentum: np.ndarray) -> np.ndarray:
    """By momentum: of the first place where p < 0, of the last one where p > 0."""
    found: np.ndarray = np.where(momentum < 0, values[0], values[-1])
    return found


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per kind, N and bin: deviation from the continuum, in units of the largest F."""
    (continuum,) = (result for result in results if result.parameters["cells"] == "continuum")
    flux = continuum["flux"]
    momentum = flux.axes["momentum"]
    exact = outgoing(flux.mean, momentum)
    largest = flux.mean.max()
    tables = []
    for result in results:
        if result is continuum:
            continue
        found = result["flux"]
        simulated = found.standard_error is not None
        table = pd.DataFrame({"momentum": momentum})
        table["deviation"] = (outgoing(found.mean, momentum) - exact) / largest
        table["error"] = outgoing(found.error, momentum) / largest if simulated else 0.0
        table.insert(0, "kind", SIMULATION if simulated else MEAN_FIELD)
        table.insert(1, "cells", int(result.parameters["cells"]))
        tables.append(table)
    # As printed, F of a chain without correlations integrates to 1.
    rates = sum(continuum.parameters[f"nu-{end}"] for end in ("left", "right"))
    table = pd.concat(tables, ignore_index=True)
    return table.assign(absolute_as_printed=table.deviation * largest / rates)


def largest_deviations(table: pd.DataFrame) -> pd.DataFrame:
    """Over the bins, per kind and N."""
    sizes = table.groupby(["kind", "cells"]).deviation
    return table.loc[sizes.apply(lambda column: column.abs().idxmax())].assign(
        deviation=lambda rows: rows.deviation.abs()
    )


def amplitudes(table: pd.DataFrame, kind: str = SIMULATION) -> pd.DataFrame:
    """Per N, the part of the deviation that has the shape of that of the mean field of the shortest chain, at its
    largest; with its error, for bins as independent. Unlike the largest of noisy bins it has no bias."""
    mean_field = table[table.kind == MEAN_FIELD]
    shape = mean_field[mean_field.cells == mean_field.cells.min()].deviation.to_numpy()
    scale = np.abs(shape).max() / (shape @ shape)
    rows = [
        {
            "cells": cells,
            "amplitude": scale * float(shape @ part.deviation),
            "error": scale * float(np.sqrt(np.sum((shape * part.error) ** 2))),
        }
        for cells, part in table[table.kind == kind].groupby("cells")
    ]
    return pd.DataFrame(rows)


def decay(table: pd.DataFrame) -> PowerLaw:
    part = amplitudes(table)
    return fit_power(part.cells, part.amplitude, part.error)


def draw_deviations(axes: Axes, table: pd.DataFrame) -> None:
    """Points from simulations, lines from the mean field; the halves belong to different ends and are not joined."""
    sizes = table.groupby("cells")
    for (size, rows), color, dashes, marker in zip(
        sizes, style.SEQUENCE, style.DASHES, MARKERS, strict=False
    ):
        points, line = (rows[rows.kind == kind] for kind in (SIMULATION, MEAN_FIELD))
        look = {"marker": marker, "color": color, "markersize": 2.5, **style.POINTS, "capsize": 0}
        axes.errorbar(
            points.momentum, 1e3 * points.deviation, 1e3 * points.error, **look, label=f"$N = {size}$"
        )
        for half in (line[line.momentum < 0], line[line.momentum > 0]):
            axes.plot(half.momentum, 1e3 * half.deviation, color=color, linestyle=dashes, linewidth=0.8)
    axes.plot([], [], color="grey", linewidth=0.8, label=MEAN_FIELD)
    axes.axhline(0, **style.GUIDE)
    axes.axvline(0, **style.GUIDE)
    axes.set(xlabel=f"momentum $p$ ({style.UNITS})", ylabel=r"$10^3\,(F_N - F)\,/\,\max F$", xlim=(-45, 45))
    axes.legend(loc="upper right")


def draw_decay(axes: Axes, table: pd.DataFrame) -> None:
    """Amplitude of the deviation against N, beside the largest bin; on the right in the normalisation that the paper prints."""
    printed = (table.absolute_as_printed / table.deviation).median()
    points, line = amplitudes(table), amplitudes(table, MEAN_FIELD)
    noisy = largest_deviations(table[table.kind == SIMULATION])
    look = {"marker": "o", "color": style.BLUE, **style.POINTS}
    axes.errorbar(points.cells, points.amplitude, points.error, **look, label=SIMULATION)
    axes.plot(
        noisy.cells,
        noisy.deviation,
        "x",
        color="0.4",
        markersize=6,
        zorder=3,
        label="simulation, largest bin",
    )
    axes.plot(line.cells, line.amplitude, color=style.BLACK, label=MEAN_FIELD)
    law = decay(table)
    label = "power law, rejected" if law.rejected else rf"fit, $N^{{{law.text}}}$"
    axes.plot(points.cells, law.at(points.cells), color=style.BLUE, linestyle="dotted", label=label)
    readings: list[tuple[float, str, style.Look]] = [
        (1, r"of $\max F$", {}),
        (1 / printed, "as printed", {"color": style.GREEN}),
    ]
    axes.set(xscale="log", yscale="log", ylim=(LOWEST, HIGHEST))
    for height, name in LIMITS:
        for scale, reading, look in readings:
            if height * scale > LOWEST:
                axes.axhline(height * scale, **style.GUIDE | look)
                axes.text(2, height * scale, f"{name} {reading}", va="bottom", size=8, **look)
    axes.set(xlabel="number of cells $N$", ylabel=r"$|F_N - F|\,/\,\max F$")
    right = axes.secondary_yaxis("right", functions=(lambda y: y * printed, lambda y: y / printed))
    right.set_ylabel(r"$|F_N - F|$, with $\int F\,dp = 1$")
    axes.tick_params(axis="y", which="both", right=False)
    style.label_within_decades(axes.xaxis)
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], loc="upper right")


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    runs = [result for result in results if result.provenance["program"] == "momentum_flux"]
    rows = largest_deviations(table[table.kind == SIMULATION])
    found = [f"{with_error(one.deviation, one.error)} at N = {one.cells}" for one in rows.itertuples()]
    sizes = [
        f"{with_error(one.amplitude, one.error)} at N = {one.cells}" for one in amplitudes(table).itertuples()
    ]
    first, last = (
        with_error(one.absolute_as_printed, one.error * one.absolute_as_printed / one.deviation)
        for one in rows.assign(absolute_as_printed=rows.absolute_as_printed.abs()).iloc[[0, -1]].itertuples()
    )
    law = decay(table)
    said = "no power of N fits it" if law.rejected else f"it falls as the power {law.text} of N"
    return f"""
        Finite chains against the kinetic equation, {parameters(runs, "cells", "cell-length", "sigma", "gamma", *BATHS, *WINDOW)},
        {replicas(runs)}. (a) F_N − F in the halves that leave the chain, negative p at the left end and positive p at the right one,
        means over the bins in thousandths of the largest F: simulations (points) and the mean field, the kinetic equation of
        N scatterers (lines). {ERRORS}. (b) The part of the deviation that has the shape of that of the mean field at N =
        {table.cells.min()}, at its largest: {listed(sizes)}; {said} ({goodness(law.chi_square, law.freedom)}). Crosses: the largest bin, {listed(found)}. The paper states less than {LIMITS[0][1]} for all N and
        {LIMITS[1][1]} for the longest chain, without a reference: both are exceeded relative to the largest F; in its printed
        normalisation, in which F integrates to one, taken at the mean of the two rates (right axis), the largest bins are {first} for the shortest and
        {last} for the longest; towards momentum zero, within the innermost bins, the deviation still grows (C10). The largest of noisy bins is above the true largest, by up to the error of one."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table = tabulate(results)
    figure, (above, below) = plt.subplots(2, 1, figsize=(style.COLUMN, 2 * style.HEIGHT))
    draw_deviations(above, table)
    draw_decay(below, table)
    style.letter(above, below)
    law = decay(table)
    fitted = table.cells.map(lambda size: float(law.at(size)))
    whole = amplitudes(table).rename(columns={"error": "amplitude_error"})
    table = table.assign(amplitude_fitted=fitted).merge(whole, on="cells")
    return figure, table, caption(table, results)


if __name__ == "__main__":
    pure = ("deviation", "error", "amplitude", "amplitude_error", "amplitude_fitted")
    units = {"absolute_as_printed": "1/momentum"} | dict.fromkeys(pure, "1")
    run(draw, "Finite chains against the kinetic equation", **units)
