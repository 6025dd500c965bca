"""Fig. 2, lower panel: particles per cell, averaged over the stated window."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Result


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    tables = []
    for result in results:
        marker, color = style.BY_GAMMA[result.parameters["gamma"]]
        density = result["density"]
        x = (density.axes["cell"] + 0.5) / len(density.mean)
        look = {"marker": marker, "color": color, "markerfacecolor": "white", **style.POINTS}
        label = rf"$\gamma = {style.gamma(result)}$"
        axes.errorbar(x, density.mean, density.standard_error, **look, label=label)
        table = pd.DataFrame({"x": x, "density": density.mean, "density_error": density.standard_error})
        table.insert(0, "gamma", style.gamma(result))
        tables.append(table)
    begin, length = (results[0].parameters[f"{time}-time"] for time in ("relaxation", "observation"))
    axes.set(xlabel="$x$", ylabel=r"particles per cell, $\rho(x)$", xlim=(0, 1))
    axes.legend(loc="best", title=f"mean over $t = {begin:g}$ to ${begin + length:g}$")
    return figure, pd.concat(tables)


if __name__ == "__main__":
    run(draw, "Density profiles", x="1")
