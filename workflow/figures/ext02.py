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

RESOLVED = 3  # standard errors beyond which a change is called one


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


def glide(found: pd.DataFrame) -> str:
    """What the exponent does from the smallest sizes to the largest."""
    first, last = found.iloc[0], found.iloc[-1]
    change = (last.exponent - first.exponent) / np.hypot(first.exponent_error, last.exponent_error)
    verb = "does not change beyond errors" if abs(change) < RESOLVED else "rises" if change > 0 else "falls"
    ends = [
        f"{with_error(one.exponent, one.exponent_error)} about N = {one['size']:.0f}" for one in (first, last)
    ]
    return f"{verb}, from {ends[0]} to {ends[1]}"


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table = tabulate(results)
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    tables, said, spacing = [], [], spacings(results)
    for name, part in table.groupby("gas", sort=False):
        marker, color = LOOKS[name]
        found = local(part)
        look = {"marker": marker, "color": color, "label": rf"$\lambda = {spacing[name]}$", **style.POINTS}
        axes.errorbar(found["size"], found.exponent, found.exponent_error, **look)
        if law := of_cube_root(part):
            axes.plot(*law, color=color, linestyle=style.DASHES[1])
        tables.append(found.assign(gas=name))
        said.append(f"at spacing {spacing[name]} it {glide(found)}")
    axes.axhline(1 / 3, **style.GUIDE)
    axes.annotate("1/3", (1.01, 1 / 3), xycoords=("axes fraction", "data"), va="center", size=8)
    axes.set(xscale="log", xlabel="number of cells $N$", ylabel=r"$d\ln\kappa/d\ln N$", ylim=(0, None))
    style.label_sizes(axes.xaxis)
    axes.legend(loc="upper right")
    caption = (
        "Local exponent of the heat conductivity between neighbouring sizes, from the runs of ext. 9 at γ = N: "
        f"{'; '.join(said)}. At the spacing 1/N of the paper the gas thins out as the chain grows; at fixed spacings large "
        "N is the thermodynamic limit. Broken lines: a + b N^(1/3), fitted to the sizes for which it is not rejected, "
        "whose exponent tends to 1/3. Error bars: standard errors over replicas; neighbouring points share a size."
    )
    return figure, pd.concat(tables), caption


if __name__ == "__main__":
    run(draw, "Local exponent of the heat conductivity", size="1", exponent="1", exponent_error="1")
