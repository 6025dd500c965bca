"""Fig. 3, inset: finite chains against the kinetic equation, in the halves that leave the chain.

F_N(p, 0) for p < 0 and F_N(p, 1) for p > 0, both averaged over the bins, minus F, in units of the largest F.
Lines: the chain of N scatterers without correlations (mean field).
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.fit import fit_power
from workflow.lib.load import Result

LIMITS = [(1e-3, "0.1 %"), (1e-4, "0.01 %")]  # of the paper


def outgoing(values: np.ndarray, momentum: np.ndarray) -> np.ndarray:
    """By momentum: of the first place where p < 0, of the last one where p > 0."""
    return np.where(momentum < 0, values[0], values[-1])


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
        table["error"] = outgoing(found.standard_error, momentum) / largest if simulated else 0.0
        table.insert(0, "kind", "simulation" if simulated else "mean field")
        table.insert(1, "cells", int(result.parameters["cells"]))
        tables.append(table)
    # As printed, a bath's half of F integrates to 1/2 whatever its rate.
    rates = sum(continuum.parameters[f"nu-{end}"] for end in ("left", "right"))
    table = pd.concat(tables)
    return table.assign(absolute_as_printed=table.deviation * largest / rates)


def draw_decay(axes: Axes, table: pd.DataFrame) -> None:
    """Largest deviation over the bins against N; on the right in the normalisation that the paper prints."""
    printed = (table.absolute_as_printed / table.deviation).median()
    decay = table.loc[table.groupby(["kind", "cells"]).deviation.apply(lambda column: column.abs().idxmax())]
    for kind, look in (("simulation", {"marker": "o", **style.POINTS}), ("mean field", {"marker": ""})):
        part = decay[decay.kind == kind]
        size, height = part.cells, part.deviation.abs()
        if kind == "simulation":
            law = fit_power(size, height, part.error)
            axes.errorbar(
                size,
                height,
                part.error,
                color=style.BLUE,
                **look,
                label=rf"simulation, $\sim N^{{{law.text}}}$",
            )
        else:
            axes.plot(size, height, color=style.BLACK, label=kind)
    for height, name in LIMITS:
        for scale, reading, look in (
            (1, r"of $\max F$", {}),
            (1 / printed, "as printed", {"color": style.GREEN}),
        ):
            axes.axhline(height * scale, **style.GUIDE | look)
            axes.text(4.2, height * scale, f"{name} {reading}", va="bottom", size=7, **look)
    axes.set(xscale="log", yscale="log", ylim=(5e-5, 0.2))
    axes.set(xlabel="number of cells $N$", ylabel=r"largest $|F_N - F|\,/\,\max F$")
    right = axes.secondary_yaxis("right", functions=(lambda y: y * printed, lambda y: y / printed))
    right.set_ylabel(r"$|F_N - F|$, halves of 1/2 as printed")
    axes.tick_params(axis="y", which="both", right=False)
    style.label_within_decades(axes.xaxis)
    axes.legend(loc="upper right")


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    table = tabulate(results).reset_index(drop=True)
    figure, (above, below) = plt.subplots(2, 1, figsize=(style.COLUMN, 2 * style.HEIGHT))
    sizes = sorted(table.cells.unique())
    for size, color, dashes in zip(sizes, style.SEQUENCE, style.DASHES, strict=False):
        for kind, part in table[table.cells == size].groupby("kind"):
            if kind == "simulation":
                look = {
                    "marker": "o",
                    "color": color,
                    "markersize": 2,
                    **style.POINTS,
                    "label": f"$N = {size}$",
                }
                above.errorbar(part.momentum, 1e3 * part.deviation, 1e3 * part.error, **look)
            else:
                above.plot(part.momentum, 1e3 * part.deviation, color=color, linestyle=dashes)
    above.axhline(0, **style.GUIDE)
    above.set(xlabel=f"momentum $p$ ({style.UNITS})", ylabel=r"$10^3\,(F_N - F)\,/\,\max F$", xlim=(-45, 45))
    above.legend(loc="best")
    draw_decay(below, table)
    return figure, table


if __name__ == "__main__":
    units = {"deviation": "1", "error": "1", "absolute_as_printed": "1/momentum"}
    run(draw, "Finite chains against the kinetic equation", **units)
