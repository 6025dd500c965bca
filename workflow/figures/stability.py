"""Numerical stability: rounding errors of the conserved quantities, with the collision as it is computed and as
the paper prints it; the energy current in limits in which it is known; a chain in two units of length.

The exact trajectories of the chain agree in both units, but every rounding differs, as with another precision.
"""

from collections.abc import Sequence
from itertools import cycle
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, parameters, scientific
from workflow.lib.figure import PHYSICS, Parts, plots
from workflow.lib.load import Result

TITLE = "Numerical stability"
UNITS = dict.fromkeys(("collisions", "ratio", "difference", "relative_error"), "1")

RULES = {"elastic": "as computed here", "printed": "by the paper's formula"}
LIMITS = {  # series in the order of the panel, with the parameter that is extreme
    "passing": ("gamma", r"\gamma"),
    "light": ("sigma", r"1 + \sigma"),
    "heavy": ("sigma", r"1 - \sigma"),
    "hot": ("temperature_right", "T_R/T_L"),
    "seldom": ("nu_right", r"\nu_R"),
    "narrow": ("cell_length", r"\lambda"),
    "wide": ("cell_length", r"\lambda"),
}
IDENTICAL = 1e-17  # where differences of 0 are plotted


def collisions(result: Result) -> float:
    """Collisions of a replica."""
    return float(result.provenance["events"]) / result.replicas


def drifts(results: Sequence[Result]) -> pd.DataFrame:
    """Relative changes of energy and momentum, one row per run."""
    rows = []
    for result in results:
        row = {"part": result.series, "collisions": collisions(result)}
        row |= {name: result.parameters[name] for name in ("rule", "sigma", "observation_time")}
        rows.append(row | result.columns("energy_change", "momentum_change"))
    return pd.DataFrame(rows).sort_values(["rule", "sigma", "collisions"], ignore_index=True)


def exact_current(result: Result) -> float:
    """J_U of ballistic particles or momenta, of which a fraction is transmitted: 1 without walls [eq. 36]."""
    flux = np.multiply(result.ends("nu"), result.ends("temperature")) / 2
    reflected = 0.0
    if float(result.parameters["sigma"]) > 0.5:  # walls
        reflected = float(result.parameters["gamma"]) / int(result.parameters["cells"])
    walls = int(result.parameters["cells"]) * reflected / (1 - reflected)
    return float(flux[0] - flux[1]) / (1 + walls)


def in_tex(value: float) -> str:
    """The value with one digit, as 2·10^-3, for matplotlib."""
    digit, power = f"{value:.0e}".split("e")
    factor = "" if digit == "1" else rf"{digit} \cdot "
    return f"{factor}10^{{{int(power)}}}"


def limits(results: Sequence[Result]) -> pd.DataFrame:
    """Energy current over its exact value, one row per run."""
    rows = []
    for result in results:
        name, symbol = LIMITS[result.series]
        value = float(result.parameters[name])
        if name == "sigma":
            value = 1 - abs(value)
        elif name == "temperature_right":
            value /= result.ends("temperature")[0]
        current, exact = result["energy_current_mean"], exact_current(result)
        row: dict[str, Any] = {"part": result.series, "limit": f"${symbol} = {in_tex(value)}$"}
        row |= {"ratio": float(current.mean) / exact, "ratio_error": float(current.error) / abs(exact)}
        rows.append(row)
    return pd.DataFrame(rows)


def partings(results: Sequence[Result]) -> pd.DataFrame:
    """Relative difference of the particles' mean energy in two units of length, and its relative error."""
    units: dict[tuple[int, float], list[Result]] = {}
    for result in results:
        key = int(result.parameters["cells"]), float(result.parameters["observation_time"])
        units.setdefault(key, []).append(result)
    rows = []
    for (cells, time), (one, other) in sorted(units.items()):
        first, second = (
            result["particle_energy"].mean / float(result.parameters["temperature"])
            for result in (one, other)
        )
        error = float(one["particle_energy"].error / one["particle_energy"].mean)
        row = {"part": "unit", "cells": cells, "observation_time": time, "collisions": collisions(one)}
        rows.append(row | {"difference": abs(float(second / first) - 1), "relative_error": error})
    return pd.DataFrame(rows)


def draw_drifts(axes: Axes, table: pd.DataFrame) -> None:
    """Plots drifts of the energy, and with open symbols of the momentum."""
    for (rule, part), (marker, color) in zip(table.groupby("rule"), cycle(style.LOOKS), strict=False):
        for name, face in (("energy_change", color), ("momentum_change", "white")):
            label = f"{name.partition('_')[0]}, {rule}"
            axes.errorbar(part.collisions, part[name], **style.points(marker, color, face, label=label))
    axes.set(xscale="log", yscale="log", xlabel="collisions of a chain", ylabel="relative change")
    axes.legend(loc="upper left")


def draw_limits(axes: Axes, table: pd.DataFrame) -> None:
    rows = np.arange(len(table))[::-1]
    axes.axvline(0, **style.GUIDE)
    axes.errorbar(
        1e3 * (table.ratio - 1), rows, xerr=1e3 * table.ratio_error, **style.points("o", style.BLACK)
    )
    axes.set(yticks=rows, yticklabels=table.limit, xlabel=r"$10^3\,(J_U/J_\mathrm{exact} - 1)$")
    axes.tick_params(axis="y", which="minor", left=False, right=False)


def draw_partings(axes: Axes, table: pd.DataFrame) -> None:
    for (cells, part), (marker, color) in zip(table.groupby("cells"), cycle(style.LOOKS), strict=False):
        look = style.points(marker, color) | {"linestyle": "none"}
        axes.errorbar(part.collisions, part.difference.clip(lower=IDENTICAL), label=f"$N = {cells}$", **look)
        both = np.sqrt(2) * part.relative_error  # of the difference of two independent means
        axes.plot(part.collisions, both, color=color, linestyle="dotted")
    axes.set(xscale="log", yscale="log", xlabel="collisions of a chain", ylabel="difference of energies")
    axes.legend(loc="center left")


def parted(table: pd.DataFrame) -> str:
    """Where trajectories part: collisions after which the averages differ, by N, and by how many errors."""
    apart = table[table.difference > 1e-9]
    if not len(apart):
        return f"do not part within {scientific(table.collisions.max(), 1)} collisions"
    after = [
        f"{scientific(part.collisions.min(), 1)} (N = {cells})" for cells, part in apart.groupby("cells")
    ]
    score = float((apart.difference / apart.relative_error / np.sqrt(2)).max())
    return f"part after {', '.join(after)} collisions, averages by at most {score:.1f} errors"


def caption(walks: pd.DataFrame, pairs: pd.DataFrame, sigma: str) -> str:
    longest = (
        walks[walks.observation_time == walks.observation_time.max()].groupby("rule").energy_change.max()
    )
    changes = ", ".join(f"by {scientific(drift)} {RULES.get(rule, rule)}" for rule, drift in longest.items())
    same = f"; {scientific(IDENTICAL, 1)}: none" if (pairs.difference < IDENTICAL).any() else ""
    return f"""
        (a) In {scientific(walks.collisions.max())} collisions at {sigma} the energy changes {changes}. (b) Energy
        current over that of the limit. (c) In two units of length trajectories
        {parted(pairs)} (dotted: one error{same}). {ERRORS}"""


@plots(f"rounding unit tripled {' '.join(LIMITS)}", varying=" ".join(PHYSICS))
def draw(results: Sequence[Result]) -> Parts:
    rounding = [result for result in results if result.series == "rounding"]
    walks = drifts(rounding)
    known = limits([result for name in LIMITS for result in results if result.series == name])
    pairs = partings([result for result in results if result.series in ("unit", "tripled")])
    figure, panels = plt.subplots(1, 3, figsize=(3 * style.COLUMN, style.HEIGHT))
    draw_drifts(panels[0], walks)
    draw_limits(panels[1], known)
    draw_partings(panels[2], pairs)
    style.letter(*panels)
    return figure, pd.concat([walks, known, pairs]), caption(walks, pairs, parameters(rounding, "sigma"))
