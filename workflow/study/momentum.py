"""Growth of heat transport with noise in the collisions that conserves momentum, and with noise that does not.

In a fraction epsilon of the collisions the momenta of the particle, its scatterer and a neighbouring one are
rotated, which conserves energy and momentum [eq. 60], or the momentum of the scatterer is reversed, which
conserves energy alone. The chains are those of fig. 8. Q is the heat current of a ring, integrated over its cells
and a time [eq. 58]; <Q²>/2t per cell is its heat conductivity at this time, in units of T².
"""

from collections.abc import Collection, Iterable, Sequence
from itertools import cycle
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.figure import Parts, plots
from workflow.lib.load import Result
from workflow.lib.text import format_with_error
from workflow.study import rings

TITLE = "Heat transport with and without conserved momentum"
UNITS = dict.fromkeys(("epsilon", "zeta", "mass"), "1") | {"spread": "energy^2 length^2/time"}


class Case(NamedTuple):
    """A collision rule, and the fraction of the collisions that it disturbs."""

    rule: str
    epsilon: float

    @property
    def label(self) -> str:
        kind = {"rotation": "momentum conserved", "reversal": "momentum broken"}.get(self.rule, self.rule)
        return f"{kind}, {100 * self.epsilon:g} %" if self.epsilon else "no noise"


# Filled where momentum is conserved, open where it is not; the larger the fraction, the darker.
LOOKS: dict[str, list[tuple[str, str, str | None]]] = {
    "elastic": [("o", style.BLACK, None)],
    "rotation": [("D", style.SKY, None), ("s", style.BLUE, None)],
    "reversal": [("v", style.ORANGE, "white"), ("^", style.VERMILLION, "white"), ("<", "#7f3b08", "white")],
}
OTHER_RULES: list[tuple[str, str, str | None]] = [("P", style.GREEN, None), ("X", style.GREEN, None)]
LINE: style.Look = {"linestyle": "-", "linewidth": 0.6}


def looks(cases: Iterable[Case]) -> dict[Case, style.Look]:
    """Looks of all cases, in the order of the legend."""
    found: dict[Case, style.Look] = {}
    for rule in dict.fromkeys([*LOOKS, *sorted({case.rule for case in cases})]):
        of_rule = sorted({case for case in cases if case.rule == rule})
        own = cycle(LOOKS.get(rule, OTHER_RULES))
        found |= {case: style.points(*look) | LINE for case, look in zip(of_rule, own, strict=False)}
    return found


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per chain, sorted by N."""
    rows: list[dict[str, Any]] = []
    for result in results:
        row: dict[str, Any] = {"rule": result.parameters["rule"], "epsilon": rings.epsilon(result)}
        row |= {"cells": int(result.parameters["cells"]), "usable": result.usable}
        rows.append(row | result.columns("kappa"))
    return pd.DataFrame(rows).sort_values(["rule", "epsilon", "cells"], ignore_index=True)


def of_case(table: pd.DataFrame, case: Case) -> pd.DataFrame:
    return table[(table.rule == case.rule) & (table.epsilon == case.epsilon)]


def growth(chains: pd.DataFrame, case: Case, sizes: Collection[int]) -> str:
    """kappa of a case at the largest of the sizes, over that at the smallest."""
    rows = of_case(chains, case).set_index("cells").reindex([min(sizes), max(sizes)])
    (first, one), (last, other) = rows[["kappa", "kappa_error"]].to_numpy()
    return format_with_error(last / first, last / first * np.hypot(one / first, other / last))


def caption(chains: pd.DataFrame) -> str:
    sizes = common_sizes(chains)
    epsilon = chains[chains.rule == "reversal"].epsilon.min()
    elastic, broken = (
        growth(chains, case, sizes) for case in (Case("elastic", 0), Case("reversal", epsilon))
    )
    return f"""
        Noise in a fraction of the collisions conserves energy and momentum (filled), or energy alone (open). (a) In fig. 8's chain, whose gas
        gets thinner, κ grows from N = {min(sizes)} to {max(sizes)} by {elastic} without noise, by {broken} if {100 * epsilon:g} % break momentum.
        (b) Heat of a ring: only broken momentum stops its growth."""


def common_sizes(chains: pd.DataFrame) -> set[int]:
    """Sizes of all cases."""
    return set.intersection(*(set(part.cells) for _, part in chains.groupby(["rule", "epsilon"])))


def draw_chains(axes: Axes, chains: pd.DataFrame, look: dict[Case, style.Look]) -> None:
    for case, points in look.items():
        part = of_case(chains, case)
        axes.errorbar(part.cells, part.kappa, part.kappa_error, label=case.label, **points)
    style.cross_out(axes, chains.cells, chains.kappa, ~chains.usable)
    style.against_size(axes, chains.cells)
    axes.set(yscale="log", ylabel=r"$\kappa$")
    style.label_within_decades(axes.yaxis)


def draw_rings(axes: Axes, control: pd.DataFrame, look: dict[Case, style.Look]) -> None:
    """Plots the conductivity <Q²>/2t of every case."""
    for case, points in look.items():
        part = of_case(control, case)
        axes.errorbar(part.time, part.spread, part.spread_error, label=case.label, **points)
    axes.set(xscale="log", yscale="log", xlabel="time $t$", ylabel=r"$\langle Q^2\rangle/2tN$")
    style.label_within_decades(axes.yaxis)


def draw_gases(axes: Axes, elastic: pd.DataFrame) -> None:
    """Plots β - 1 of every gas."""
    ours = cycle([("o", style.BLACK), *style.LOOKS[1:]])
    for (_, gas), (marker, color) in zip(elastic.groupby(rings.STATE, sort=False), ours, strict=False):
        zeta, mass = rings.texts(*gas[["zeta", "mass"]].iloc[0])
        look = style.points(marker, color) | LINE
        label = rf"$\zeta = {zeta}$, $M = {mass}$"
        axes.errorbar(gas.middle, gas.local_exponent - 1, gas.local_exponent_error, label=label, **look)
    style.guide_at(axes, 0, "0")
    style.guide_at(axes, 1 / 3, "1/3")
    axes.set(xscale="log", xlabel="time $t$", ylabel=r"$\beta - 1$")
    axes.legend(loc="upper right")


SERIES = "light light-long light-longest dense-longest dilute-longest sparse-longest rotation reversal "
SERIES += "chain-rotation chain-reversal deterministic deterministic-large"


@plots(SERIES)
def draw(results: Sequence[Result]) -> Parts:
    of_rings = [result for result in results if result.provenance["program"] == "heat_current"]
    chains = tabulate([result for result in results if result not in of_rings])
    disturbed = chains[chains.rule != "elastic"].cells
    chains = chains[chains.cells.between(disturbed.min(), disturbed.max())]
    table = rings.tabulate(of_rings)
    table["spread"] = table.heat_variance / (2 * table.time)
    table["spread_error"] = table.heat_variance_error / (2 * table.time)
    broken = table[table.rule == "reversal"].iloc[0]
    control = table[(table[rings.STATE] == broken[rings.STATE]).all(axis=1)]
    cases = [Case(*pair) for part in (chains, control) for pair in zip(part.rule, part.epsilon, strict=True)]
    look = looks(cases)
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(2.2 * style.COLUMN, style.HEIGHT))
    draw_chains(left, chains, look)
    draw_rings(middle, control, look)
    elastic = table[table.rule == "elastic"]
    ours = elastic.index.isin(control.index)
    draw_gases(right, pd.concat([elastic[ours], elastic[~ours]]))
    zeta, mass = rings.texts(broken.zeta, broken.mass)
    gas = rf"rings, $\zeta = {zeta}$, $M = {mass}$"
    for axes, text in zip(
        (left, middle, right), ("chains of fig. 8", gas, "rings without noise"), strict=True
    ):
        axes.set_title(text, size=style.label_size())
    figure.legend(*middle.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    style.letter(left, middle, right)
    return figure, pd.concat([chains, table]), caption(chains)
