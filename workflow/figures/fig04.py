"""Fig. 4: momentum distribution of the particles at both ends of an open chain; a: gamma = 1, b: gamma = N.

Further panels show the distribution near p = 0, its deviation from mean field, and its jump at p = 0; the
last also for equal rates at both ends if gamma = N. Mean field is the Boltzmann equation: that of the
continuum at gamma = 1, that of N scatterers at gamma = N.
"""

import math
from collections.abc import Sequence
from itertools import product

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, holds, plots
from workflow.lib.load import Result
from workflow.lib.text import format_with_error
from workflow.physics import run_parameters
from workflow.physics.fluxes import at, reach

TITLE = "Momentum distribution of the particles at both ends of an open chain, γ = {gamma}"
UNITS = dict.fromkeys(("theory", "theory_jump"), "1/(time momentum)")

# Bonds behind the first and behind the last scatterer: index, colour, line style and marker.
ENDS = {"x = 1/N": (1, style.BLUE, "solid", "o"), "x = 1": (-1, style.VERMILLION, (0, (4, 1.5)), "s")}
CHAIN = ("gamma", "sigma", "nu_left", "nu_right", "temperature_left", "temperature_right")
EQUAL = "\n$\\nu_L = \\nu_R$"
FEW = 0.5  # if a jump is below this fraction of the largest, the axis includes 0
NEAR = 4  # ratio of the largest |p| to that in the panel of the jump


def measured(results: Sequence[Result]) -> list[Result]:
    """The simulations."""
    return [result for result in results if result.provenance["program"] == "momentum_flux"]


def uncorrelated(results: Sequence[Result], like: Result) -> Result | None:
    """The solution of the Boltzmann equation for the chain of `like`; None if there is none."""
    for result in results:
        # Options of one configuration, so that equal ones have equal bits.
        chain = {name: like.parameters[name] for name in CHAIN}
        if result.provenance["program"] == "boltzmann" and holds([like]) and holds([result], **chain):
            return result
    return None


def at_ends(results: Sequence[Result]) -> pd.DataFrame:
    """One row per chain, end and bin."""
    parts = []
    for result, (end, (bond, *_)) in product(measured(results), ENDS.items()):
        flux, jump, expected = result["flux"], result["jump"], uncorrelated(results, result)
        part = pd.DataFrame({"x": end, "momentum": flux.axes["momentum"], "flux": flux.mean[bond]})
        part["flux_error"] = flux.error[bond]
        part["jump"], part["jump_error"] = jump.mean[bond], jump.error[bond]
        if expected:
            where = flux.axes["bond"][bond] / flux.axes["bond"][-1]
            part["theory"], part["theory_jump"] = at(expected["flux"], where), at(expected["jump"], where)
        part["nu_left"], part["nu_right"] = result.ends("nu")
        part.insert(0, "gamma", run_parameters.gamma(result))
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def halves(part: pd.DataFrame) -> list[pd.DataFrame]:
    """The rows with p < 0 and those with p > 0, which are plotted as separate curves as F jumps at p = 0."""
    return [part[part.momentum < 0], part[part.momentum > 0]]


def draw_distribution(axes: Axes, table: pd.DataFrame, reach: float) -> None:
    """Plots F at both ends as points, and as black lines that of the mean field."""
    for end, part in table.groupby("x", sort=False):
        _, color, _, marker = ENDS[end]
        label: str | None = f"${end}$"
        for half in halves(part[part.momentum.abs() < reach]):
            look = style.points(marker, color, markersize=2, capsize=0)
            axes.errorbar(half.momentum, half.flux, half.flux_error, label=label, **look)
            axes.plot(half.momentum, half.theory, color=style.BLACK, linewidth=0.6, zorder=1)
            label = None
    axes.axvline(0, **style.GUIDE)
    axes.set(xlabel=f"momentum $p$ ({style.UNIT_SYSTEM})", ylabel="$F_N(p, x)$", xlim=(-reach, reach))


def draw_residuals(axes: Axes, table: pd.DataFrame, shown: float) -> None:
    for end, part in table.groupby("x", sort=False):
        _, color, dashes, marker = ENDS[end]
        for half in halves(part[part.momentum.abs() < shown]):
            unit = table.theory.max() / 100
            look: style.Look = {"marker": marker, "color": color, "markersize": 2}
            look |= {"elinewidth": 0.6, "linewidth": 0.6}
            residual = (half.flux - half.theory) / unit
            axes.errorbar(half.momentum, residual, half.flux_error / unit, linestyle=dashes, **look)
    axes.axhline(0, color=style.BLACK, linewidth=0.6)
    axes.axvline(0, **style.GUIDE)
    axes.set(xlabel="momentum $p$", ylabel=r"$(F_N - F)/\max F$ in %", xlim=(-shown, shown))


def cases(table: pd.DataFrame) -> list[tuple[str, bool, pd.DataFrame]]:
    """For every chain: gamma, whether the rates of the baths are equal, and the rows of both ends."""
    ends = table.drop_duplicates(["gamma", "nu_left", "x"])
    chains = ends.groupby(["gamma", "nu_left"], sort=False)
    return [(gamma, bool((part.nu_right == left).all()), part) for (gamma, left), part in chains]


def draw_jumps(axes: Axes, table: pd.DataFrame) -> None:
    """Plots the jumps at both ends, measured and in mean field, with one row per chain."""
    chains = cases(table)
    for row, (_, _, part) in enumerate(chains):
        for shift, end in zip((0.17, -0.17), part.itertuples(), strict=True):
            _, color, _, marker = ENDS[end.x]
            look = {"marker": marker, "color": color, **style.POINTS}
            axes.errorbar(end.jump, -row + shift, xerr=end.jump_error, **look)
            axes.plot(end.theory_jump, -row + shift, "|", color=style.BLACK, markersize=8, zorder=1)
            text: style.Look = {"ha": "right", "va": "center", "size": style.label_size(), "color": color}
            text |= {"transform": axes.get_yaxis_transform()}
            axes.text(0.98, -row + shift, format_with_error(end.jump, end.jump_error), **text)
    jumps = table.jump.abs()
    if (
        jumps.min() < FEW * jumps.max()
    ):  # jumps of similar size could not be distinguished on an axis that includes 0
        axes.axvline(0, **style.GUIDE)
    axes.set(xlabel=r"jump $F_N(0^+, x) - F_N(0^-, x)$", ylim=(0.5 - len(chains), 0.5))
    names = [rf"$\gamma = {gamma}${EQUAL if equal else ''}" for gamma, equal, _ in chains]
    axes.set_yticks([-row for row in range(len(chains))], names)
    axes.tick_params(axis="y", length=0)
    low, high = axes.get_xlim()
    axes.set_xlim(low, high + 0.45 * (high - low))  # space for the numbers


def theory(main: pd.DataFrame) -> str:
    """Name of the lines."""
    return "mean field" if main.gamma.iloc[0] == "N" else "Boltzmann equation"


def caption(main: pd.DataFrame, unequal: pd.DataFrame) -> str:
    far = 100 * (unequal.flux - unequal.theory).abs().max() / unequal.theory.max()
    claim = "follows the Boltzmann equation, with a jump at p = 0"
    if main.gamma.iloc[0] == "N":
        claim = "has small jumps at p = 0"
    text = f"""The paper finds that F_N(p, x) to the right of the first and of the last scatterer {claim}.
        (a), (b) Points: chain; lines: {theory(main)}. (c) Points minus lines, at most {{largest}} % of the
        largest F. (d) Jumps at p = 0, and those of the lines (ticks)."""
    largest = f"{math.ceil(10 * far) / 10:g}" if math.isfinite(far) else None
    return fill(text, largest=largest)


@plots("rare kinetic deterministic equal mean-field mean-field-equal", varied="nu_left nu_right")
def draw(results: Sequence[Result]) -> Parts:
    table = at_ends(results)
    main = table[table.gamma == table.gamma.iloc[-1]]
    unequal = main[main.nu_left != main.nu_right]
    figure, panels = plt.subplot_mosaic(
        [["main", "near"], ["residual", "jump"]],
        figsize=(2 * style.COLUMN, 1.6 * style.HEIGHT),
        height_ratios=[1.7, 1],
    )
    shown = max(reach(result["flux"]) for result in measured(results))
    draw_distribution(panels["main"], unequal, shown)
    draw_distribution(panels["near"], unequal, shown / NEAR)
    style.second_axis(panels["main"], 1 / run_parameters.both_rates(results[0]), r"$F_N/(\nu_L + \nu_R)$")
    draw_residuals(panels["residual"], unequal, shown)
    draw_jumps(panels["jump"], table)
    corner: style.Look = {"transform": panels["main"].transAxes, "ha": "right"}
    panels["main"].text(0.95, 0.9, rf"$\gamma = {main.gamma.iloc[0]}$", **corner)
    panels["near"].plot([], [], color=style.BLACK, linewidth=0.6, label=theory(main))
    figure.legend(*panels["near"].get_legend_handles_labels(), loc="outside upper center", ncols=5)
    style.letter(*panels.values())
    return figure, table, caption(main, unequal)
