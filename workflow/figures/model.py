"""World lines of the particles of a short ring and of a short chain between two baths."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, PowerNorm

from workflow.lib import style
from workflow.lib.caption import number, parameters
from workflow.lib.figure import Drawn, run
from workflow.lib.load import Result

# The part of the perceptually uniform map plasma that is visible on white: low energies are dark, high ones bright.
COLOURS = LinearSegmentedColormap.from_list("energy", plt.get_cmap("plasma")(np.linspace(0, 0.88, 256)))
COLUMNS = ("particle", "start_time", "end_time", "start_position", "end_position", "momentum")
BATH = 0.75  # width of a bath, in cells


def flights(result: Result) -> pd.DataFrame:
    """One row per flight of a run, with the energy of the particle."""
    table = pd.DataFrame({name: result[name].mean for name in COLUMNS})
    table["energy"] = table.momentum**2 / 2
    table.insert(0, "chain", result.parameters["chain"])
    return table


def world_lines(
    axes: Axes, table: pd.DataFrame, shifts: Sequence[float], energies: PowerNorm
) -> LineCollection:
    """Plots the flights, the fastest on top, once per shift of x. A flight across the ends of a ring is thus visible at both ends."""
    table = table.sort_values("energy")
    lines = np.stack([table[["start_position", "start_time"]], table[["end_position", "end_time"]]], axis=1)
    copies = [lines + np.array([shift, 0]) for shift in shifts]
    drawn = LineCollection(
        [*np.concatenate(copies)], array=np.tile(table.energy, len(copies)), cmap=COLOURS, norm=energies, linewidth=1, alpha=0.9,
        capstyle="round",
    )  # fmt: skip
    axes.add_collection(drawn)
    return drawn


def baths(axes: Axes, result: Result, length: float, energies: PowerNorm) -> None:
    """Plots each bath as a band beside the chain. Its colour is that of a particle whose energy equals the temperature."""
    temperatures = result.ends("temperature")
    for side, temperature, begin in zip("LR", temperatures, (-BATH, length), strict=True):
        axes.axvspan(begin, begin + BATH, color=COLOURS(energies(temperature)), linewidth=0, zorder=3)
        kind = "hot" if temperature == max(temperatures) else "cold"
        axes.text(
            begin + BATH / 2, 0.5, f"{kind} bath, $T_{side} = {number(temperature)}$",
            color="black" if kind == "hot" else "white", transform=axes.get_xaxis_transform(), rotation=90,
            ha="center", va="center", zorder=4,
        )  # fmt: skip
    axes.set_xlim(-BATH, length + BATH)


def draw(results: Sequence[Result]) -> Drawn:
    by_chain = {str(result.parameters["chain"]): result for result in results}
    ring, row = by_chain["closed"], by_chain["open"]
    table = pd.concat([flights(ring), flights(row)], ignore_index=True)
    energies = PowerNorm(0.45, 0, table.energy.quantile(0.95))
    cells, spacing = int(ring.parameters["cells"]), float(ring.parameters["cell-length"])
    length = cells * spacing
    size, widths = (2 * style.COLUMN, 0.95 * style.COLUMN), (length, length + 2 * BATH)
    figure, panels = plt.subplots(1, 2, figsize=size, sharey=True, width_ratios=widths)
    for axes, result in zip(panels, (ring, row), strict=True):
        scatterers = (np.arange(cells) + 0.5) * spacing
        along = axes.get_xaxis_transform()
        axes.vlines(scatterers, 0, 1, transform=along, color="0.8", linewidth=0.7, zorder=0)
        shifts = (-length, 0.0, length) if result is ring else (0.0,)
        lines = world_lines(axes, table[table.chain == result.parameters["chain"]], shifts, energies)
        axes.set_xticks(np.arange(0, cells + 1, 2) * spacing)
        axes.set(
            xlim=(0, length),
            ylim=(0, result.parameters["observation-time"]),
            xlabel="position $x$  (grey: scatterers)",
        )
        axes.tick_params(top=False, right=False)
    panels[0].set(title="(a) closed chain: a ring", ylabel=f"time $t$  ({style.UNITS})")
    for end in ("left", "right"):
        panels[0].spines[end].set_linestyle((0, (5, 4)))
    panels[1].set(title="(b) open chain between two baths")
    baths(panels[1], row, length, energies)
    label = "energy of the particle, $p^2/2m$"
    figure.colorbar(lines, ax=panels, label=label, extend="max", aspect=30, pad=0.01)
    caption = f"""The model: world lines of particles in (a) a closed and (b) an open chain of
        {parameters(results, "cells", "sigma", "gamma")}. A particle flies freely, past all others, to the next scatterer (grey),
        which stays in place, and the two exchange energy and momentum. So energy passes from particle to particle through the
        scatterers. The colour is the energy of the particle. (a) A ring: the dashed ends are joined;
        {parameters([ring], "particles-per-cell")}. (b) Each bath injects particles at its rate,
        {parameters([row], "nu-left", "nu-right")}, and absorbs those that reach it; its colour is its temperature as an energy."""
    return figure, table, caption


if __name__ == "__main__":
    run(draw, "World lines of particles in a closed and in an open chain", energy="energy")
