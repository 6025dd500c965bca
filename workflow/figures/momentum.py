"""Growth of heat transport with and without conserved momentum.

A particle passes a scatterer with the probability 1 - gamma/N, which conserves momentum; in a fraction epsilon
of the collisions the momentum of the scatterer is reversed, which does not. Chains have a fixed spacing. Q is
the heat current of a ring, integrated over its cells and a time [eq. 58]. The table also has other gases.
"""

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, format_number
from workflow.lib.figure import Parts, plots
from workflow.lib.fit import format_with_error
from workflow.lib.load import Result
from workflow.physics import rings, run_parameters

TITLE = "Heat transport with and without conserved momentum"
UNITS = dict.fromkeys(("passing", "epsilon", "zeta", "mass", "growth"), "1")

CURVE = ["passing", "epsilon"]  # columns that identify a curve of chains
# Markers and colours where momentum is conserved, by ascending probability of passing, and where it is not,
# by descending ε.
CONSERVED = [("o", style.BLACK), ("s", style.BLUE), ("D", style.SKY)]
BROKEN = [("v", style.VERMILLION), ("^", style.ORANGE)]


class Case(NamedTuple):
    """What happens in place of an elastic collision, with what probability."""

    passing: float
    epsilon: float

    @property
    def label(self) -> str:
        if self.epsilon:
            return rf"reversed, $\epsilon = {format_number(self.epsilon)}$"
        return f"passing, {100 * self.passing:g} %" if self.passing else "elastic"


def looks(cases: Iterable[Case]) -> dict[Case, style.Look]:
    """Filled markers where momentum is conserved, open ones where it is not."""
    conserved = sorted(case for case in cases if not case.epsilon)
    broken = sorted((case for case in cases if case.epsilon), reverse=True)
    found = {case: style.points(*look) for case, look in zip(conserved, CONSERVED, strict=False)}
    return found | {case: style.points(*look, "white") for case, look in zip(broken, BROKEN, strict=False)}


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per chain, sorted by N, with kappa over that at the smallest size that all curves have."""
    rows: list[dict[str, Any]] = []
    for result in results:
        row: dict[str, Any] = {
            "passing": run_parameters.passing(result),
            "epsilon": run_parameters.epsilon(result),
        }
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
    return table[(table.passing == case.passing) & (table.epsilon == case.epsilon)]


def growth(chains: pd.DataFrame, case: Case) -> str:
    """kappa of a case at the largest size that all curves have, over that at the smallest."""
    fixed = of_case(chains, case)
    (row,) = fixed[fixed.cells == max(common_sizes(chains))].itertuples()
    return format_with_error(row.growth, row.growth_error)


def last_exponent(control: pd.DataFrame, case: Case) -> str:
    """beta - 1 of a case over the last octave."""
    rows = of_case(control, case).dropna(subset="local_exponent")
    if rows.empty:
        return "(unknown)"
    end = rows.iloc[-1]
    return format_with_error(end.local_exponent - 1, end.local_exponent_error)


def caption(chains: pd.DataFrame, control: pd.DataFrame) -> str:
    sizes = common_sizes(chains)
    passing = chains.passing[chains.passing > 0].min()
    found = chains.epsilon[chains.epsilon > 0]
    epsilon = found.loc[(found - passing).abs().idxmin()]
    cases = (Case(0, 0), Case(passing, 0), Case(0, epsilon))
    elastic, passed, broken = (growth(chains, case) for case in cases)
    ends = [last_exponent(control, case) for case in cases[1:]]
    return f"""
        Open symbols show reversals, which break momentum. (a) In chains κ({max(sizes)})/κ({min(sizes)}) is
        {elastic} for elastic collisions, {passed} with {100 * passing:g} % passing, {broken} with {100 * epsilon:g} % reversed (ε). (b) In rings ⟨Q²⟩ ∼ t^β;
        for the last two β − 1 ends at {ends[0]} and {ends[1]}. {ERRORS}"""


def draw_chains(axes: Axes, chains: pd.DataFrame, look: dict[Case, style.Look]) -> None:
    for (passing, epsilon), part in chains.groupby(CURVE):
        case = Case(passing, epsilon)
        points = look[case] | {"linestyle": "-", "linewidth": 0.6, "label": case.label}
        axes.errorbar(part.cells, part.growth, part.growth_error, **points)
    style.cross_out(axes, chains.cells, chains.growth, ~chains.usable)
    style.against_size(axes)
    axes.set_ylabel(rf"$\kappa(N)/\kappa({min(common_sizes(chains))})$")


def draw_rings(axes: Axes, control: pd.DataFrame, look: dict[Case, style.Look]) -> None:
    """Plots β - 1 of every case."""
    for (passing, epsilon), part in control.groupby(["passing", "epsilon"]):
        case = Case(passing, epsilon)
        points = look[case] | {"linestyle": "-", "linewidth": 0.6, "label": case.label}
        axes.errorbar(part.middle, part.local_exponent - 1, part.local_exponent_error, **points)
    style.guide_at(axes, 0, "0")
    style.guide_at(axes, 1 / 3, "1/3")
    axes.set(xscale="log", xlabel="time $t$", ylabel=r"$\beta - 1$", ylim=(-0.2, 0.75))


RINGS = "light light-long light-longest dense-longest dilute-longest sparse-longest passing reversal "
CHAINS = "chain-elastic chain-passing chain-reversal"


@plots(RINGS + CHAINS)
def draw(results: Sequence[Result]) -> Parts:
    shown = [result for result in results if result.provenance["program"] == "heat_current"]
    chains = tabulate([result for result in results if result not in shown])
    table = rings.tabulate(shown)
    broken = table[table.epsilon > 0].iloc[0]
    control = table[(table.zeta == broken.zeta) & (table.mass == broken.mass)]
    look = looks(
        {Case(*pair) for part in (chains, control) for pair in zip(part.passing, part.epsilon, strict=True)}
    )
    figure, panels = plt.subplots(1, 2, figsize=(1.6 * style.COLUMN, style.HEIGHT))
    draw_chains(panels[0], chains, look)
    draw_rings(panels[1], control, look)
    legends = [zip(*axes.get_legend_handles_labels(), strict=True) for axes in panels]
    handles = {text: handle for legend in legends for handle, text in legend}
    order = [case.label for case in sorted(look, key=lambda case: (case.epsilon, case.passing))]
    labels = sorted(handles, key=lambda text: order.index(text) if text in order else len(order))
    figure.legend([handles[text] for text in labels], labels, loc="outside upper center", ncols=4)
    style.letter(*panels)
    return figure, pd.concat([chains, table]), caption(chains, control)
