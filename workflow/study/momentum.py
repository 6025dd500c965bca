"""Heat in rings: fig. 8's own gas, with noise in the collisions, and at a density that does not depend on N.

Q is the heat current of a ring, integrated over its cells and a time [eq. 54]; <Q²> ~ t^β. (a) Fig. 8's
conductivity of heat, and the Green-Kubo value of rings of its gas at the time in which sound crosses the
chain [eq. 56]. (b) In a fraction of the collisions the momenta of the particle, its scatterer and a
neighbouring one are rotated, which conserves energy and momentum [eq. 4], or the momentum of the scatterer
is reversed, which conserves energy alone.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import cycle

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, plots
from workflow.lib.load import Result
from workflow.lib.text import format_with_error, listed
from workflow.physics import run_parameters
from workflow.study import rings

TITLE = "Conductivity of fig. 8's gas, and heat with and without conserved momentum"
LABELLED = True  # labels have the parameters
UNITS = dict.fromkeys(("epsilon", "zeta", "mass", "ratio"), "1") | {"green_kubo": "energy/(time temperature)"}

OWN = "gas-"  # begin of the names of the series of fig. 8's gas
FIRST = 128  # cells from which the chain is compared with its gas: the ends dominate shorter ones
LINE: style.Look = {"linestyle": "-", "linewidth": 0.6}
# By collision rule: name, and filled symbols where momentum is conserved.
NOISE: dict[str, tuple[str, style.Look]] = {
    "elastic": ("no noise", style.points("o", style.BLACK)),
    "rotation": ("rotation: momentum conserved", style.points("s", style.BLUE)),
    "reversal": ("reversal: momentum broken", style.points("^", style.PURPLE, "white")),
}
GASES = [("s", style.GREEN), ("D", style.ORANGE), ("^", style.SKY), ("P", style.BLUE)]
OWN_LOOK = style.points("s", style.VERMILLION, "white", zorder=3)


def compare(chains: Sequence[Result], own: Sequence[Result]) -> pd.DataFrame:
    """One row per N: conductivity of heat of the chain, Green-Kubo value of its gas, their ratio, and β of
    this gas in the last octave."""
    table = pd.DataFrame(
        {"cells": int(chain.parameters["cells"]), "usable": chain.usable} | chain.columns("kappa_heat")
        for chain in chains
    )
    ends = [chain[f"temperature_{end}"].mean for chain in chains for end in ("first", "last")]
    state = float(np.mean(ends)), max(run_parameters.length(chain) for chain in chains)
    columns = ["cells", "green_kubo", "green_kubo_error", "middle", "local_exponent", "local_exponent_error"]
    values = pd.DataFrame(
        [(*rings.green_kubo(ring, *state), *rings.last_exponent(ring)) for ring in own], columns=columns
    )
    table = table.merge(values, "outer", "cells").sort_values("cells", ignore_index=True)
    table["ratio"] = table.green_kubo / table.kappa_heat
    relative = table.kappa_heat_error / table.kappa_heat, table.green_kubo_error / table.green_kubo
    return table.assign(ratio_error=table.ratio * np.hypot(*relative), usable=table.usable.eq(other=True))


def draw_own_gas(axes: Axes, sizes: pd.DataFrame) -> None:
    """Plots both conductivities."""
    heat = style.points("o", style.BLUE, label="chain, heat alone")
    axes.errorbar(sizes.cells, sizes.kappa_heat, sizes.kappa_heat_error, **heat)
    label = "Green–Kubo, its gas"
    axes.errorbar(sizes.cells, sizes.green_kubo, sizes.green_kubo_error, label=label, **OWN_LOOK)
    style.cross_out(axes, sizes.cells, sizes.kappa_heat, ~sizes.usable & sizes.kappa_heat.notna())
    style.against_size(axes, sizes.cells)
    axes.set_ylabel(rf"$\kappa$ of heat alone ({style.UNIT_SYSTEM})")
    axes.legend(loc="upper left")


Line = tuple[str, style.Look, pd.DataFrame]  # label, look, and rows with β


def noise(control: pd.DataFrame) -> Iterator[Line]:
    """One gas by rule, until the last time of the noise."""
    control = control[control.middle <= control[control.rule != "elastic"].middle.max()]
    for (rule, epsilon), part in control.groupby(["rule", "epsilon"]):
        name, look = NOISE.get(rule, (f"{rule} ({epsilon:g})", style.points("P", style.GREEN)))
        yield name, look | LINE, part


def gases(elastic: pd.DataFrame, control: pd.DataFrame, sizes: pd.DataFrame) -> Iterator[Line]:
    """Every gas, that of the noise as there, and those of fig. 8."""
    looks = cycle(GASES)
    for _, gas in elastic.groupby(rings.STATE):
        zeta, mass = rings.texts(*gas[["zeta", "mass"]].iloc[0])
        look = NOISE["elastic"][1] if gas.index.isin(control.index).any() else style.points(*next(looks))
        yield rf"$\zeta = {zeta}$, $M = {mass}$", look | LINE, gas
    known = sizes.dropna(subset="middle")
    yield f"fig. 8, $N = {known.cells.min()}$ to ${known.cells.max()}$", OWN_LOOK, known


def draw_exponents(axes: Axes, lines: Iterable[Line]) -> None:
    """Plots β with guides at diffusion and at 4/3."""
    for label, look, part in lines:
        known = part.dropna(subset="middle")
        error = known.local_exponent_error
        axes.errorbar(known.middle, known.local_exponent, error, label=label, **look)
    style.guide_at(axes, 1, "1")
    style.guide_at(axes, 4 / 3, "4/3")
    axes.set(xscale="log", xlabel="time $t$", ylabel=r"exponent $\beta$")
    axes.legend(loc="upper right")


def caption(sizes: pd.DataFrame, fractions: Iterable[float]) -> str:
    """With the ratio at the shortest and the longest chain from FIRST on, or of the longest alone."""
    known = sizes[sizes.usable].dropna(subset="ratio_error").sort_values("cells")
    rows = [*known[known.cells >= min(FIRST, max(known.cells, default=FIRST))].itertuples()]
    ratios = [f"{format_with_error(row.ratio, row.ratio_error)} at N = {row.cells}" for row in rows]
    text = """(a) Conductivity of heat of fig. 8's chains, and by Green–Kubo of their gas, ζ = 16/N, at the
        time in which sound crosses the chain. The latter, without a fitted parameter, is {ratios} times the
        former. (b), (c) β of ⟨Q²⟩ ∼ t^β: 1 is diffusion, 4/3 the predicted limit. (b) One of two gases: in
        {fraction} % of the collisions the scatterer's momentum is reversed, or three momenta are rotated at a
        fixed sum. (c)
        Gases of a fixed density; open squares: those of fig. 8, in the octave until sound crosses the chain.
        t: middle of an octave, in λ/√T."""
    ratio = listed(dict.fromkeys([ratios[0], ratios[-1]])) if ratios else None
    return fill(text, ratios=ratio, fraction=listed(f"{100 * one:g}" for one in fractions))


SERIES = " ".join(f"{OWN}{cells}" for cells in rings.SIZES)
SERIES += " light dense sparse thin thin-long light-longest dense-longest sparse-longest thin-longest"
SERIES += " light-rotation light-reversal thin-rotation thin-reversal deterministic deterministic-large"


@plots(SERIES)
def draw(results: Sequence[Result]) -> Parts:
    of_rings = [result for result in results if result.provenance["program"] == "heat_current"]
    own = [result for result in of_rings if result.series.startswith(OWN)]
    sizes = compare([result for result in results if result not in of_rings], own)
    table = rings.tabulate([result for result in of_rings if result not in own])
    broken = table[table.rule == "reversal"].iloc[-1]  # of the largest σ
    control = table[(table[rings.STATE] == broken[rings.STATE]).all(axis=1)]
    figure, axes = plt.subplots(1, 3, figsize=(2.2 * style.COLUMN, style.HEIGHT))
    axes[2].sharey(axes[1])
    draw_own_gas(axes[0], sizes)
    draw_exponents(axes[1], noise(control))
    draw_exponents(axes[2], gases(table[table.rule == "elastic"], control, sizes))
    low, high = axes[2].get_ylim()
    axes[2].set_ylim(low, high + 0.3 * (high - low))  # room for the legends
    zeta, mass = rings.texts(broken.zeta, broken.mass)
    titles = "fig. 8 and its own gas", rf"effect of noise, $\zeta = {zeta}$, $M = {mass}$", "without noise"
    for panel, text in zip(axes, titles, strict=True):
        panel.set_title(text, size=style.label_size())
    style.letter(*axes)
    fractions = sorted({*control[control.rule != "elastic"].epsilon})
    return figure, pd.concat([sizes, table]), caption(sizes, fractions)
