"""Growth of heat transport with noise in the collisions that conserves momentum, and with noise that does not.

In a fraction epsilon of the collisions the momenta of the particle, its scatterer and a neighbouring one are
rotated, which conserves energy and momentum [eq. 60], or the momentum of the scatterer is reversed, which
conserves energy alone. Chains have a fixed spacing. Q is the heat current of a ring, integrated over its cells
and a time [eq. 58]. The table also has other gases.
"""

from collections.abc import Iterable, Sequence
from itertools import cycle
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, format_number
from workflow.lib.figure import PHYSICS, Parts, plots
from workflow.lib.fit import format_with_error
from workflow.lib.load import Result
from workflow.physics import run_parameters
from workflow.study import rings

TITLE = "Heat transport with and without conserved momentum"
UNITS = dict.fromkeys(("epsilon", "zeta", "mass", "growth"), "1")

CURVE = ["rule", "epsilon"]  # columns that identify a curve of chains


class Case(NamedTuple):
    """A collision rule, and the fraction of the collisions that it disturbs."""

    rule: str
    epsilon: float

    @property
    def label(self) -> str:
        kind = {"rotation": "momentum conserved", "reversal": "momentum broken"}.get(self.rule, self.rule)
        return f"{kind}, {100 * self.epsilon:g} %" if self.epsilon else "no noise"


# Filled where momentum is conserved, open where it is not; the larger the fraction, the lighter.
LOOKS: dict[str, list[tuple[str, str, str | None]]] = {
    "elastic": [("o", style.BLACK, None)],
    "rotation": [("s", style.BLUE, None), ("D", style.SKY, None)],
}
LOOKS |= {"reversal": [("v", style.VERMILLION, "white"), ("^", style.ORANGE, "white")]}
OTHER_RULES: list[tuple[str, str, str | None]] = [("P", style.GREEN, None), ("X", style.GREEN, None)]

OTHERS = style.points(".", "0.6", linestyle="-", linewidth=0.5, zorder=1)


def looks(cases: Iterable[Case]) -> dict[Case, style.Look]:
    """Looks of all cases, in the order of the legend."""
    found: dict[Case, style.Look] = {}
    for rule in dict.fromkeys([*LOOKS, *sorted({case.rule for case in cases})]):
        of_rule = sorted({case for case in cases if case.rule == rule})
        own = cycle(LOOKS.get(rule, OTHER_RULES))
        found |= {case: style.points(*look) for case, look in zip(of_rule, own, strict=False)}
    return found


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per chain, sorted by N, with kappa over that at the smallest size that all curves have."""
    rows: list[dict[str, Any]] = []
    for result in results:
        row: dict[str, Any] = {"rule": result.parameters["rule"], "epsilon": run_parameters.epsilon(result)}
        row |= {"spacing": run_parameters.spacing(result)[1], "cells": int(result.parameters["cells"])}
        rows.append(row | result.columns("kappa") | {"usable": result.usable})
    table = pd.DataFrame(rows).sort_values([*CURVE, "cells"], ignore_index=True)
    reference = (
        table[table.cells == min(common_sizes(table))].set_index(CURVE).reindex(table.set_index(CURVE).index)
    )
    relative = np.hypot(table.kappa_error / table.kappa, (reference.kappa_error / reference.kappa).to_numpy())
    table["growth"] = table.kappa / reference.kappa.to_numpy()
    table["growth_error"] = table.growth * relative.where(table.cells != reference.cells.to_numpy(), 0)
    return table


def common_sizes(table: pd.DataFrame) -> set[int]:
    """Sizes of all curves."""
    return set.intersection(*(set(part.cells) for _, part in table.groupby(CURVE)))


def of_case(table: pd.DataFrame, case: Case) -> pd.DataFrame:
    return table[(table.rule == case.rule) & (table.epsilon == case.epsilon)]


def growth(chains: pd.DataFrame, case: Case) -> str:
    """kappa of a case at the largest size that all curves have, over that at the smallest."""
    fixed = of_case(chains, case)
    rows = fixed[fixed.cells == max(common_sizes(chains))]
    return format_with_error(*rows[["growth", "growth_error"]].iloc[0]) if len(rows) else "(unknown)"


def last_exponent(control: pd.DataFrame, case: Case) -> str:
    """beta - 1 of a case over the last octave."""
    rows = of_case(control, case).dropna(subset="local_exponent")
    if rows.empty:
        return "(unknown)"
    end = rows.iloc[-1]
    return format_with_error(end.local_exponent - 1, end.local_exponent_error)


def caption(chains: pd.DataFrame, control: pd.DataFrame, cases: Sequence[Case], *, others: bool) -> str:
    sizes = common_sizes(chains)
    epsilon = min(case.epsilon for case in cases if case.rule == "reversal")
    compared = [Case("elastic", 0), Case("rotation", epsilon), Case("reversal", epsilon)]
    elastic, rotated, broken = (growth(chains, case) for case in compared)
    ends = [last_exponent(control, case) for case in compared[1:]]
    grey = " Grey: without noise, in other gases." if others else ""
    return f"""
        Noise that conserves energy and momentum (rotation, filled), or energy alone (reversal, open), in a fraction of the collisions.
        (a) In chains κ({max(sizes)})/κ({min(sizes)}) is {elastic} without noise, {rotated} and {broken} at {100 * epsilon:g} %. (b) In rings ⟨Q²⟩ ∼ t^β;
        at {100 * epsilon:g} % β − 1 ends at {ends[0]} and {ends[1]}.{grey} {ERRORS}"""


def draw_chains(axes: Axes, chains: pd.DataFrame, look: dict[Case, style.Look]) -> None:
    for case, points in look.items():
        part = of_case(chains, case)
        axes.errorbar(part.cells, part.growth, part.growth_error, label=case.label, **points)
    style.cross_out(axes, chains.cells, chains.growth, ~chains.usable)
    style.against_size(axes)
    axes.set_ylabel(rf"$\kappa(N)/\kappa({min(common_sizes(chains))})$")


def draw_rings(axes: Axes, control: pd.DataFrame, look: dict[Case, style.Look]) -> None:
    """Plots β - 1 of every case."""
    for case, points in look.items():
        part = of_case(control, case)
        axes.errorbar(part.middle, part.local_exponent - 1, part.local_exponent_error, **points)
    style.guide_at(axes, 0, "0")
    style.guide_at(axes, 1 / 3, "1/3")
    axes.set(xscale="log", xlabel="time $t$", ylabel=r"$\beta - 1$")


RINGS = "light light-long light-longest dense-longest dilute-longest sparse-longest rotation reversal "
CHAINS = "chain-elastic chain-rotation chain-reversal"


@plots(RINGS + CHAINS, varying=" ".join(PHYSICS))
def draw(results: Sequence[Result]) -> Parts:
    of_rings = [result for result in results if result.provenance["program"] == "heat_current"]
    chains = tabulate([result for result in results if result not in of_rings])
    table = rings.tabulate(of_rings)
    broken = table[table.rule == "reversal"].iloc[0]
    control = table[(table[rings.STATE] == broken[rings.STATE]).all(axis=1)]
    cases = [Case(*pair) for part in (chains, control) for pair in zip(part.rule, part.epsilon, strict=True)]
    look = {case: points | {"linestyle": "-", "linewidth": 0.6} for case, points in looks(cases).items()}
    figure, panels = plt.subplots(1, 2, figsize=(1.6 * style.COLUMN, style.HEIGHT))
    draw_chains(panels[0], chains, look)
    draw_rings(panels[1], control, look)
    others = [
        panels[1].errorbar(other.middle, other.local_exponent - 1, other.local_exponent_error, **OTHERS)
        for _, other in table[(table.rule == "elastic") & ~table.index.isin(control.index)].groupby(
            rings.STATE
        )
    ]
    gas = rf"$\sigma = {format_number(float(of_rings[0].parameters['sigma']))}$, $\zeta = {broken.zeta:g}$"
    one = next(result for result in results if result not in of_rings)
    sigma, spacing = float(one.parameters["sigma"]), run_parameters.spacing(one)[1]
    of_chains = rf"chains, $\sigma = {format_number(sigma)}$, $\lambda = {spacing}$"
    for axes, text in zip(panels, (of_chains, f"rings, {gas}"), strict=True):
        axes.set_title(text, size=style.label_size())
    handles, labels = panels[0].get_legend_handles_labels()
    labels += ["no noise, other gases"] * bool(others)
    figure.legend([*handles, *others[:1]], labels, loc="outside upper center", ncols=3)
    style.letter(*panels)
    return figure, pd.concat([chains, table]), caption(chains, control, cases, others=bool(others))
