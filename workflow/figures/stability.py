"""Numerical stability: the energy current in limits in which it is known; rounding errors of the conserved
quantities, with the collision as it is computed and as the paper prints it."""

import math
from collections.abc import Sequence
from itertools import cycle
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, TheoryError, plots, require
from workflow.lib.load import Result
from workflow.lib.text import format_number, listed, scientific, scientific_in_tex

TITLE = "Numerical stability"
LABELLED = True  # labels have the parameters
UNITS = dict.fromkeys(("collisions", "ratio"), "1")

RULES = {"elastic": "as computed here", "printed": "by the paper's formula"}  # others by their names
LIMITS = {  # series in the order of the panel, with the parameter that is extreme
    "passing": ("gamma", r"\gamma"),
    "light": ("sigma", r"1 + \sigma"),
    "heavy": ("sigma", r"1 - \sigma"),
    "hot": ("temperature_right", "T_R/T_L"),
    "seldom": ("nu_right", r"\nu_R"),
    "narrow": ("cell_length", r"\lambda"),
    "wide": ("cell_length", r"\lambda"),
}
BAR = 2  # standard errors
EXTREME = 1e-2  # largest distance of γ from 0, or of σ from −1, 0 or 1, in limits with a known current


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
    """J_U of ballistic particles or momenta, of which a fraction is transmitted [eqs. 29, 39]: 1 without
    walls."""
    require("the exact energy current", [result])
    sigma, gamma = float(result.parameters["sigma"]), result.parameters["gamma"]
    if min(abs(sigma), 1 - abs(sigma), math.inf if gamma == "N" else float(gamma)) > EXTREME:
        raise TheoryError(f"no exact energy current is known at σ = {sigma}, γ = {gamma}: {result.path}")
    flux = np.multiply(result.ends("nu"), result.ends("temperature")) / 2
    reflected = 0.0
    if sigma > 0.5:  # walls
        reflected = float(gamma) / int(result.parameters["cells"])
    walls = int(result.parameters["cells"]) * reflected / (1 - reflected)
    return float(flux[0] - flux[1]) / (1 + walls)


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
        row: dict[str, Any] = {"part": result.series, "limit": f"${symbol} = {scientific_in_tex(value)}$"}
        row |= {"ratio": float(current.mean) / exact, "ratio_error": float(current.error) / abs(exact)}
        rows.append(row)
    return pd.DataFrame(rows)


def draw_limits(axes: Axes, table: pd.DataFrame, rounding: float) -> None:
    """Plots the deviation of each current, with a bar up to its statistical error, beside the rounding errors
    of the energy."""
    rows = np.arange(len(table))[::-1]
    deviations, bars = (table.ratio - 1).abs(), BAR * table.ratio_error
    axes.barh(rows, bars, height=0.7, color="0.85")
    axes.plot(deviations, rows, "o", color=style.BLACK)
    axes.axvline(rounding, color=style.BLACK, linestyle="dotted")
    style.name_point(axes, "rounding", (rounding, -1), (4, 0), va="center")
    low, high = np.nanmin([rounding, *deviations]), np.nanmax([*deviations, *bars])
    axes.set(xscale="log", xlim=(low / 10, 3 * high), ylim=(-1.6, len(table) - 0.4))
    axes.set(yticks=rows, yticklabels=table.limit, xlabel=r"$|J_U/J_\mathrm{exact} - 1|$")
    axes.tick_params(axis="y", which="both", left=False, right=False)


def draw_drifts(axes: Axes, table: pd.DataFrame) -> None:
    """Plots drifts of the energy, and with open symbols of the momentum."""
    axes.set(xscale="log", yscale="log", xlabel="collisions of a chain", ylabel="relative change")
    ends = []
    for (rule, part), (marker, color) in zip(table.groupby("rule"), cycle(style.LOOKS), strict=False):
        for name, face in (("energy_change", color), ("momentum_change", "white")):
            look = style.points(marker, color, face)
            axes.errorbar(part.collisions, part[name], part[f"{name}_error"], **look)
            label = f"{name.partition('_')[0]} {RULES.get(rule, rule)}"
            ends.append((label, part.collisions.iloc[-1], part[name].iloc[-1], color))
    walk = np.array([table.collisions.min(), table.collisions.max()])
    axes.plot(walk, 2.0**-53 * np.sqrt(walk), **style.GUIDE)
    ends.append(("random walk", walk[1], 2.0**-53 * np.sqrt(walk[1]), style.GUIDE["color"]))
    style.name_ends(axes, ends)


def caption(walks: pd.DataFrame, known: pd.DataFrame) -> str:
    score = float(((known.ratio - 1).abs() / known.ratio_error).max())
    longest = (
        walks[walks.observation_time == walks.observation_time.max()].groupby("rule").energy_change.max()
    )
    changes = {rule: scientific(longest[rule], 1) if rule in longest else None for rule in RULES}
    text = f"""(a) Dots: deviations of energy currents in extreme chains from exact values, at most {{score}}
        standard errors (grey bars: {BAR}). Dotted: rounding error of the energy. (b) Relative changes by
        rounding at σ = {{sigma}}. {{collisions}} collisions change the energy by {{elastic}} as computed
        here. The paper's formula changes it by {{printed}}. Dashed: random walk of steps of 2⁻⁵³."""
    sigma = listed(map(format_number, sorted({*walks.sigma})))
    collisions = scientific(walks.collisions.max())
    return fill(text, score=f"{score:.1f}", sigma=sigma, collisions=collisions, **changes)


@plots(f"rounding {' '.join(LIMITS)}")
def draw(results: Sequence[Result]) -> Parts:
    rounding = [result for result in results if result.series == "rounding"]
    walks = drifts(rounding)
    known = limits([result for name in LIMITS for result in results if result.series == name])
    figure, panels = plt.subplots(1, 2, figsize=(2.5 * style.COLUMN, style.HEIGHT))
    draw_limits(panels[0], known, walks[walks.rule == "elastic"].energy_change.max())
    draw_drifts(panels[1], walks)
    style.letter(*panels)
    return figure, pd.concat([walks, known]), caption(walks, known)
