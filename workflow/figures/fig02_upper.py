"""Fig. 2, upper panel: temperature profiles of an open chain between two reservoirs.

Below, the temperature of the particles minus that of the scatterers, measured in the same runs.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import BATHS, ERRORS, WINDOW, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import with_error
from workflow.lib.load import Result


def tabulate(result: Result) -> pd.DataFrame:
    """One row per cell."""
    scatterer, particle = result["temperature_scatterer"], result["temperature_particle"]
    difference = result["temperature_difference"]
    table = pd.DataFrame({"x": (scatterer.axes["cell"] + 0.5) / len(scatterer.mean)})
    table["scatterer"], table["scatterer_error"] = scatterer.mean, scatterer.error
    table["particle"], table["particle_error"] = particle.mean, particle.error
    table["particle_minus_scatterer"] = -difference.mean
    table["particle_minus_scatterer_error"] = difference.error
    table.insert(0, "gamma", style.gamma(result))
    return table


def ends(result: Result) -> str:
    """Particle minus scatterer in the first and the last cell."""
    difference = result["temperature_difference"]
    values = [with_error(-difference.mean[k], difference.error[k]) for k in (0, -1)]
    largest = np.nanmax(np.abs(difference.mean / difference.error))
    return f"γ = {style.gamma(result)}: {values[0]} and {values[1]}; the largest difference of any cell is {largest:.1f} standard errors"


def caption(results: Sequence[Result]) -> str:
    first, last = (
        ", ".join(
            f"{style.with_error(result['temperature_scatterer'], k)} at γ = {style.gamma(result)}"
            for result in results
        )
        for k in (0, -1)
    )
    return f"""
        Temperature profiles of an open chain, {parameters(results, "cells", "cell-length", "sigma", *BATHS, *WINDOW)}, {replicas(results)}.
        (a) Scatterers (symbols) and arriving particles (lines, with error bands) at γ = N (circles) and γ = 1 (squares); dashed the
        temperatures T_L and T_R of the baths. (b) Temperature of the particles minus that of the scatterer in the same cell and the same runs.
        {ERRORS}; those of (b) are of paired differences. As in the paper neither profile reaches the temperatures of the baths, at γ = 1
        least: the first scatterer has {first}, the last {last}. Particle minus scatterer in the first and the last cell at
        {"; at ".join(ends(result) for result in results)}. The paper has both coincide in each cell."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    figure, (above, below) = plt.subplots(
        2, 1, sharex=True, figsize=(style.COLUMN, 1.6 * style.HEIGHT), height_ratios=[2, 1]
    )
    tables = [tabulate(result) for result in results]
    for result, table in zip(results, tables, strict=True):
        marker, color = style.BY_GAMMA[result.parameters["gamma"]]
        look = {"marker": marker, "color": color, "markerfacecolor": "white", **style.POINTS}
        name = rf"$\gamma = {style.gamma(result)}$"
        dashes = "solid" if style.gamma(result) == "N" else "dashed"
        above.errorbar(table.x, table.scatterer, table.scatterer_error, **look, label=f"{name}, scatterers")
        above.plot(table.x, table.particle, color=color, linestyle=dashes, label=f"{name}, particles")
        low, high = (table.particle + sign * table.particle_error for sign in (-1, 1))
        above.fill_between(table.x, low, high, color=color, alpha=0.3, linewidth=0)
        below.errorbar(table.x, table.particle_minus_scatterer, table.particle_minus_scatterer_error, **look)
    options = results[0].parameters
    for end, name, place, lift in (("left", "$T_L$", 0.06, -3), ("right", "$T_R$", 0.94, 3)):
        temperature = options[f"temperature-{end}"]
        above.axhline(temperature, **style.GUIDE)
        side = "bottom" if lift > 0 else "top"
        above.annotate(
            name, (place, temperature), (0, lift), textcoords="offset points", ha="center", va=side, size=8
        )
    middle = np.mean([options[f"temperature-{end}"] for end in ("left", "right")])
    above.set(ylabel=f"temperature ({style.UNITS})", xlim=(0, 1), ylim=(0.76 * middle, 1.28 * middle))
    below.axhline(0, **style.GUIDE)
    below.set(xlabel="$x$", ylabel="temperature, particles\nminus scatterers")
    figure.legend(*above.get_legend_handles_labels(), loc="outside upper left", ncols=2)
    style.letter(above, below)
    figure.align_ylabels()
    return figure, pd.concat(tables), caption(results)


if __name__ == "__main__":
    kinds = ("scatterer", "particle", "particle_minus_scatterer")
    names = [f"{kind}{error}" for kind in kinds for error in ("", "_error")]
    run(draw, "Temperature profiles", x="1", **dict.fromkeys(names, "temperature"))
