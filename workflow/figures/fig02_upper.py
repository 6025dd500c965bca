"""Fig. 2, upper panel: temperature profiles of an open chain between two reservoirs.

Below, the temperature of the particles minus that of the scatterers, measured in the same runs.
"""

from collections.abc import Sequence

import pandas as pd

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, plots
from workflow.lib.load import Result
from workflow.lib.text import format_quantity, listed
from workflow.physics import run_parameters

TITLE = "Temperature profiles"
UNITS = {"x": "1"} | dict.fromkeys(("scatterer", "particle", "particle_minus_scatterer"), "temperature")


def tabulate(result: Result) -> pd.DataFrame:
    """One row per cell."""
    scatterer, particle = result["temperature_scatterer"], result["temperature_particle"]
    difference = result["temperature_difference"]
    table = pd.DataFrame({"x": (scatterer.axes["cell"] + 0.5) / len(scatterer.mean)})
    table["scatterer"], table["scatterer_error"] = scatterer.mean, scatterer.error
    table["particle"], table["particle_error"] = particle.mean, particle.error
    table["particle_minus_scatterer"] = -difference.mean
    table["particle_minus_scatterer_error"] = difference.error
    table.insert(0, "gamma", run_parameters.gamma(result))
    return table


def caption(results: Sequence[Result], table: pd.DataFrame) -> str:
    first = listed(
        f"{format_quantity(result['temperature_scatterer'], 0)} at γ = {run_parameters.gamma(result)}"
        for result in results
    )
    far = table.loc[table.particle_minus_scatterer.abs().idxmax()]
    text = """The paper finds one temperature of scatterers and particles, which does not reach the baths.
        (a) Points: scatterers; lines: particles. The first scatterer has {first}. (b) Particles minus
        scatterers, largest at γ = {gamma}."""
    return fill(text, first=first, gamma=far.gamma)


@plots("deterministic rare")
def draw(results: Sequence[Result]) -> Parts:
    figure, (above, below) = style.stacked(2, 1, height=1.6, width=1.1)
    tables = [tabulate(result) for result in results]
    looks = style.by_gamma(map(run_parameters.gamma, results))
    for result, table in zip(results, tables, strict=True):
        marker, color = looks[run_parameters.gamma(result)]
        look = style.points(marker, color, "white")
        name = rf"$\gamma = {run_parameters.gamma(result)}$"
        dashes = "solid" if run_parameters.gamma(result) == "N" else "dashed"
        above.errorbar(table.x, table.scatterer, table.scatterer_error, **look, label=f"{name}, scatterers")
        above.plot(table.x, table.particle, color=color, linestyle=dashes, label=f"{name}, particles")
        style.band(above, table.x, table.particle, table.particle_error, color)
        below.errorbar(table.x, table.particle_minus_scatterer, table.particle_minus_scatterer_error, **look)
    temperatures = results[0].ends("temperature")
    marks = (("$T_L$", 0.06, -3), ("$T_R$", 0.94, 3))
    for temperature, (name, x, lift) in zip(temperatures, marks, strict=True):
        above.axhline(temperature, **style.GUIDE)
        side = "bottom" if lift > 0 else "top"
        style.name_point(above, name, (x, temperature), (0, lift), ha="center", va=side)
    above.margins(y=0.1)  # room for the names of the guides
    above.set(ylabel=f"temperature ({style.UNIT_SYSTEM})", xlim=(0, 1))
    style.second_axis(above, 0.5, "kinetic energy $E_K$")
    below.axhline(0, **style.GUIDE)
    below.set(xlabel="position $x$", ylabel="temperature, particles\nminus scatterers")
    figure.legend(*above.get_legend_handles_labels(), loc="outside upper left", ncols=2)
    table = pd.concat(tables, ignore_index=True)
    return figure, table, caption(results, table)
