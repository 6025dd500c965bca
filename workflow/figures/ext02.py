"""Ext. 2: local exponent of the heat conductivity, d ln kappa / d ln N, at the paper's spacing and at fixed spacings."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.figures.ext09 import CUBE_ROOT, LOOKS, range_of, spacings, tabulate
from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.fit import with_error
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result


def local(part: pd.DataFrame) -> pd.DataFrame:
    """Between neighbouring sizes of one spacing."""
    middle, slope, error = local_exponents(part.cells, part.kappa, part.kappa_error)
    return pd.DataFrame({"size": middle, "exponent": slope, "exponent_error": error})


def of_cube_root(part: pd.DataFrame) -> tuple[np.ndarray, np.ndarray] | None:
    """Local exponents of a + b N^(1/3) as it is fitted in ext. 9."""
    held = range_of(part, CUBE_ROOT)
    if held is None:
        return None
    size = part.cells[part.cells >= held.first].to_numpy(dtype=float)
    middle, slope, _ = local_exponents(size, held.predicted, np.ones_like(size))
    return middle, slope


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table = tabulate(results)
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    tables, last, spacing = [], [], spacings(results)
    for name, part in table.groupby("gas", sort=False):
        marker, color = LOOKS[name]
        found = local(part)
        look = {"marker": marker, "color": color, "label": rf"$\lambda = {spacing[name]}$", **style.POINTS}
        axes.errorbar(found["size"], found.exponent, found.exponent_error, **look)
        if law := of_cube_root(part):
            axes.plot(*law, color=color, linestyle=style.DASHES[1])
        tables.append(found.assign(gas=name))
        end = found.iloc[-1]
        value = with_error(end.exponent, end.exponent_error)
        last.append(f"{value} at spacing {spacing[name]} about N = {end['size']:.0f}")
    axes.axhline(1 / 3, **style.GUIDE)
    axes.annotate("1/3", (1.01, 1 / 3), xycoords=("axes fraction", "data"), va="center", size=8)
    axes.set(xscale="log", xlabel="number of cells $N$", ylabel=r"$d\ln\kappa/d\ln N$", ylim=(0, None))
    style.label_sizes(axes.xaxis)
    axes.legend(loc="upper right")
    caption = (
        "Local exponent of the heat conductivity between neighbouring sizes, from the runs of ext. 9 at gamma = N. At the "
        "spacing 1/N of the paper the gas thins out as the chain grows, and the exponent passes 1/3 on its way down. At "
        "fixed spacings, in the thermodynamic limit, it rises towards 1/3 where a + b N^(1/3) is not rejected (broken "
        f"lines). For the largest sizes it is {'; '.join(last)}. Error bars: standard errors over replicas."
    )
    return figure, pd.concat(tables), caption


if __name__ == "__main__":
    run(draw, "Local exponent of the heat conductivity", size="1", exponent="1", exponent_error="1")
