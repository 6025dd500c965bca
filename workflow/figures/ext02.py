"""Ext. 2: local exponent of the conductivity, d ln kappa / d ln N between neighbouring sizes.

The legend says from which size on every local exponent lies within two standard errors of the paper's.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.figures.fig08 import GUIDES, mean_field, tabulate
from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Result


def local_exponents(table: pd.DataFrame, name: str) -> pd.DataFrame:
    """Between neighbouring sound points of one gamma, at the geometric mean of their sizes."""
    sound = table[table.sound]
    size, kappa = (sound[column].to_numpy(dtype=float) for column in ("cells", name))
    relative = sound[f"{name}_error"].to_numpy() / kappa
    step = np.diff(np.log(size))
    slope, error = np.diff(np.log(kappa)) / step, np.hypot(relative[1:], relative[:-1]) / step
    middle = np.sqrt(size[1:] * size[:-1])
    return pd.DataFrame({"quantity": name, "size": middle, "exponent": slope, "exponent_error": error})


def holds_from(local: pd.DataFrame, expected: float) -> str:
    """The smallest of the sizes from which on the exponent is compatible with the expected one."""
    compatible = (local.exponent - expected).abs() < 2 * local.exponent_error
    from_here_on = compatible[::-1].cumprod()[::-1].astype(bool)
    return f"from {local['size'][from_here_on].min():.0f} on" if from_here_on.any() else "nowhere"


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    table = tabulate(results)
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    tables = []
    for gamma, (marker, color) in style.BY_GAMMA.items():
        for name, face, shift, text in (
            ("kappa", color, 1, "scatterers"),
            ("kappa_particle", "white", 1.08, "particles"),
        ):
            local = local_exponents(table[table.gamma == gamma], name)
            look = {"marker": marker, "color": color, "markerfacecolor": face, **style.POINTS}
            expected, law = GUIDES[gamma]
            label = rf"$\gamma = {gamma}$, $T$ of {text}; {law} {holds_from(local, expected)}"
            axes.errorbar(shift * local["size"], local.exponent, local.exponent_error, **look, label=label)
            local.insert(0, "gamma", str(gamma))
            tables.append(local)
        axes.axhline(GUIDES[gamma][0], **style.GUIDE)
    theory = mean_field(results)
    size, kappa = theory.cells.to_numpy(dtype=float), theory.mean_field_kappa.to_numpy()
    middle, slope = np.sqrt(size[1:] * size[:-1]), np.diff(np.log(kappa)) / np.diff(np.log(size))
    axes.plot(middle, slope, color=style.BY_GAMMA["N"][1], label=r"$\gamma = N$, mean field")
    columns = {"gamma": "N", "quantity": "mean_field_kappa", "size": middle, "exponent": slope}
    tables.append(pd.DataFrame(columns))
    axes.set(xscale="log", xlabel="number of cells $N$", ylabel=r"$d\ln\kappa/d\ln N$", ylim=(-0.3, 1.9))
    axes.legend(loc="upper right", fontsize=7)
    return figure, pd.concat(tables)


if __name__ == "__main__":
    run(draw, "Local exponent of the heat conductivity", size="1", exponent="1", exponent_error="1")
