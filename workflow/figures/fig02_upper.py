"""Fig. 2, upper panel: temperature profiles of an open chain between two reservoirs."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
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
        scatterer, particle = result["temperature_scatterer"], result["temperature_particle"]
        x = (scatterer.axes["cell"] + 0.5) / len(scatterer.mean)
        look = {"marker": marker, "color": color, "markerfacecolor": "white", **style.POINTS}
        name = rf"$\gamma = {style.gamma(result)}$"
        axes.errorbar(x, scatterer.mean, scatterer.standard_error, **look, label=f"{name}, scatterers")
        axes.plot(x, particle.mean, color=color, label=f"{name}, particles")
        low, high = (particle.mean + sign * particle.standard_error for sign in (-1, 1))
        axes.fill_between(x, low, high, color=color, alpha=0.3, linewidth=0)
        table = pd.DataFrame(
            {"x": x, "scatterer": scatterer.mean, "scatterer_error": scatterer.standard_error}
        )
        table["particle"], table["particle_error"] = particle.mean, particle.standard_error
        table.insert(0, "gamma", style.gamma(result))
        tables.append(table)
    for end in ("left", "right"):
        axes.axhline(results[0].parameters[f"temperature-{end}"], **style.GUIDE)
    middle = np.mean([results[0].parameters[f"temperature-{end}"] for end in ("left", "right")])
    axes.set(
        xlabel="$x$", ylabel=f"temperature ({style.UNITS})", xlim=(0, 1), ylim=(0.76 * middle, 1.24 * middle)
    )
    axes.legend(loc="upper left", **style.OPAQUE)
    return figure, pd.concat(tables)


if __name__ == "__main__":
    names = ("scatterer", "scatterer_error", "particle", "particle_error")
    run(draw, "Temperature profiles", x="1", **dict.fromkeys(names, "temperature"))
