"""World lines of the particles of a short ring and of a short chain between two baths, by a simulation of its
own: a heap of arrivals.

A few flights: at higher temperatures, longer times or larger chains the lines cover each other.
"""

import heapq
from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, PowerNorm

from workflow.lib import style
from workflow.lib.figure import Parts, plots
from workflow.lib.load import Result
from workflow.lib.text import format_number

TITLE = "World lines of particles in a closed and in an open chain"
UNITS = dict.fromkeys(("start_time", "end_time"), "time") | dict.fromkeys(
    ("start_position", "end_position"), "length"
)
UNITS |= {"particle": "1", "momentum": "momentum", "energy": "energy"}

# The part of the perceptually uniform map plasma that is visible on white: low energies are dark, high ones
# bright.
COLOURS = LinearSegmentedColormap.from_list("energy", plt.get_cmap("plasma")(np.linspace(0, 0.88, 256)))
BATH = 0.75  # width of a bath
CELLS, SIGMA = 8, 0.5  # of length 1; every particle scatters at every scatterer
MASS = (1 + SIGMA) / (1 - SIGMA)
PER_CELL, TEMPERATURE = 2, 1  # of the ring
RATES, TEMPERATURES = (0.7, 1.4), (4, 1)  # of the baths
RELAXATION, TIME = 14, 8  # before the picture, and in it

Flight = tuple[
    float, int, float, float, float, float
]  # end, particle, start, positions at start and end, momentum


def begin(particle: int, time: float, x: float, p: float, ring: bool) -> Flight:
    """Flight to the next scatterer, at (cell + 1/2), or to the opening of a row."""
    target = np.floor(x + 0.5) + 0.5 if p > 0 else np.ceil(x - 0.5) - 0.5
    target = target if ring else np.clip(target, 0, CELLS)
    return time + (target - x) / p, particle, time, x, float(target), p


def flights(ring: bool, seed: int) -> pd.DataFrame:
    """Flights in the window of time of the picture, one per row. Particles and scatterers of a ring start
    at its temperature; a row is empty, with scatterers at rest, and baths inject half-Gaussian momenta at
    exponential intervals [model.md, eqs. 1 and 5]."""
    random, end = np.random.default_rng(seed), RELAXATION + TIME
    momenta = np.zeros(CELLS)
    starts: list[tuple[float, float, float]] = []  # time, position, momentum
    if ring:
        momenta = np.sqrt(MASS * TEMPERATURE) * random.standard_normal(CELLS)
        for x in random.uniform(0, CELLS, CELLS * PER_CELL):
            starts.append((0, x, np.sqrt(TEMPERATURE) * random.standard_normal()))
    else:
        for x, sign, rate, temperature in zip((0, CELLS), (1, -1), RATES, TEMPERATURES, strict=True):
            for time in np.cumsum(random.exponential(1 / rate, size=int(4 * rate * end))):
                starts.append((time, x, sign * np.sqrt(temperature) * abs(random.standard_normal())))
    pending = [begin(particle, *start, ring) for particle, start in enumerate(sorted(starts))]
    heapq.heapify(pending)
    flown = []
    while pending and pending[0][0] < end:
        flown.append(heapq.heappop(pending))
        time, particle, _, _, x, p = flown[-1]
        if not ring and x in (0, CELLS):
            continue
        x %= CELLS
        cell = int(x)
        p, momenta[cell] = (1 - SIGMA) * momenta[cell] - SIGMA * p, (1 + SIGMA) * p + SIGMA * momenta[cell]
        heapq.heappush(pending, begin(particle, time, x, p, ring))
    columns = ["end_time", "particle", "start_time", "start_position", "end_position", "momentum"]
    table = pd.DataFrame(flown + pending, columns=columns)
    table = table[(table.end_time > RELAXATION) & (table.start_time < end)]
    for name, side in (("start", np.maximum), ("end", np.minimum)):  # cut at the ends of the window
        time = side(table[f"{name}_time"], RELAXATION if name == "start" else end)
        table[f"{name}_position"] += table.momentum * (time - table[f"{name}_time"])
        table[f"{name}_time"] = time
    table[["start_time", "end_time"]] -= RELAXATION
    table["energy"] = table.momentum**2 / 2
    table.insert(0, "chain", "closed" if ring else "open")
    return table.sort_values(["start_time", "particle"])


def world_lines(
    axes: Axes, table: pd.DataFrame, shifts: Sequence[float], energies: PowerNorm
) -> LineCollection:
    """Plots the flights, the fastest on top, once per shift of x. A flight across the ends of a ring is
    thus visible at both ends."""
    table = table.sort_values("energy")
    lines = np.stack([table[["start_position", "start_time"]], table[["end_position", "end_time"]]], axis=1)
    copies = [lines + np.array([shift, 0]) for shift in shifts]
    array = np.tile(table.energy, len(copies))
    look: style.Look = {"cmap": COLOURS, "norm": energies, "linewidth": 1, "alpha": 0.9, "capstyle": "round"}
    drawn = LineCollection([*np.concatenate(copies)], array=array, **look)
    axes.add_collection(drawn)
    return drawn


def baths(axes: Axes, energies: PowerNorm) -> None:
    """Plots each bath as a band beside the chain. Its colour is that of a particle whose energy equals the
    temperature."""
    for side, temperature, left in zip("LR", TEMPERATURES, (-BATH, CELLS), strict=True):
        axes.axvspan(left, left + BATH, color=COLOURS(energies(temperature)), linewidth=0, zorder=3)
        kind = "hot" if temperature == max(TEMPERATURES) else "cold"
        axes.text(
            left + BATH / 2, 0.5, f"{kind} bath, $T_{side} = {format_number(temperature)}$",
            color="black" if kind == "hot" else "white", transform=axes.get_xaxis_transform(), rotation=90,
            ha="center", va="center", zorder=4,
        )  # fmt: skip
    axes.set_xlim(-BATH, CELLS + BATH)


@plots("")
def draw(_: Sequence[Result]) -> Parts:
    closed, row = flights(ring=True, seed=1), flights(ring=False, seed=1)
    table = pd.concat([closed, row], ignore_index=True)
    energies = PowerNorm(0.45, 0, table.energy.quantile(0.95))
    size, widths = (2 * style.COLUMN, 0.95 * style.COLUMN), (CELLS, CELLS + 2 * BATH)
    figure, panels = plt.subplots(1, 2, figsize=size, sharey=True, width_ratios=widths)
    for axes, part, shifts in zip(panels, (closed, row), ((-CELLS, 0, CELLS), (0,)), strict=True):
        along = axes.get_xaxis_transform()
        axes.vlines(np.arange(CELLS) + 0.5, 0, 1, transform=along, color="0.8", linewidth=0.7, zorder=0)
        lines = world_lines(axes, part, shifts, energies)
        axes.set_xticks(np.arange(0, CELLS + 1, 2))
        axes.set(xlim=(0, CELLS), ylim=(0, TIME), xlabel="position $x$  (grey: scatterers)")
        axes.tick_params(top=False, right=False)
    panels[0].set(title="(a) closed chain: a ring", ylabel=f"time $t$  ({style.UNIT_SYSTEM})")
    for end in ("left", "right"):
        panels[0].spines[end].set_linestyle((0, (5, 4)))
    panels[1].set(title="(b) open chain between two baths")
    baths(panels[1], energies)
    label = "energy of the particle, $p^2/2m$"
    figure.colorbar(lines, ax=panels, label=label, extend="max", aspect=30, pad=0.01)
    caption = f"""A particle flies past all others to the next scatterer (grey), fixed in place, and both
        exchange energy (colours) and momentum. Simulated with N = {CELLS} cells, σ =
        {format_number(SIGMA)} and γ = N. (a) The ring, joined at the dashed ends. (b) Baths, coloured by
        temperature, inject particles and absorb those that reach them."""
    return figure, table, caption
