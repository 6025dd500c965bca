"""Ext. 1: spreading with the paper's random total momentum and with none; ext. 4: with random directions.

Above, local slopes of <x^2>(t): 2 is ballistic, 1 diffusive. Below, the exponent alpha of every run. The table has also the
power b of t ln(t/tau)^b, which is 0 for t and -1 for t/ln t, for the runs that have no drift of all particles.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import ERRORS, listed, number, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import with_error
from workflow.lib.load import Result

LOOKS: dict[str, style.Look] = {
    "random total momentum, as in the paper": {"marker": "o", "color": style.BLUE},
    "zero total momentum": {"marker": "s", "color": style.VERMILLION, "markerfacecolor": "white"},
    "random directions": {"marker": "D", "color": style.GREEN, "markerfacecolor": "white"},
}
PAPER, *CONTROLS = LOOKS
LABELS = ("sigma", "particles-per-cell", "relaxation-time", "zero-total-momentum", "random-direction")


def kind(result: Result) -> str:
    if result.parameters["random-direction"]:
        return CONTROLS[1]
    return CONTROLS[0] if result.parameters["zero-total-momentum"] else PAPER


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run and time."""
    parts = []
    for result in results:
        slope = result["local_slope"]
        columns = {"time": slope.axes["time"], "slope": slope.mean, "slope_error": slope.error}
        part = pd.DataFrame(columns).assign(kind=kind(result))
        for name in LABELS:
            part[name.replace("-", "_")] = result.parameters[name]
        for name in ("alpha", "logarithmic_power", "momentum_drift"):
            if name not in result.quantities or np.isnan(result[name].mean):
                continue  # no logarithmic power where the chain drifts, no momentum where directions are drawn
            part[name] = float(result[name].mean)
            part[f"{name}_error"] = float(result[name].error)
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def shown(table: pd.DataFrame) -> pd.DataFrame:
    """The paper's ensemble and one control: the drawn directions where there are any."""
    return table[table.kind.isin([PAPER, CONTROLS[int(table.random_direction.any())]])]


def like_the_paper(table: pd.DataFrame) -> pd.DataFrame:
    """Of every kind the run with the paper's number of particles, the smallest, that has relaxed longest."""
    few = table[table.particles_per_cell == table.particles_per_cell.min()]
    return few[few.relaxation_time == few.groupby("kind").relaxation_time.transform("max")]


def draw_slopes(axes: Axes, table: pd.DataFrame) -> None:
    """Every third time, as neighbours share a time."""
    for name, part in table.groupby("kind"):
        every = part.iloc[::3]
        look = {**style.POINTS, "linestyle": "-", **LOOKS[name]}
        axes.errorbar(every.time, every.slope, every.slope_error, **look)
    axes.set(xscale="log", xlabel="time $t$")


def draw_exponents(axes: Axes, table: pd.DataFrame) -> None:
    """alpha of all runs, one column per number of particles and relaxation time."""
    runs = table.drop_duplicates(["kind", "particles_per_cell", "relaxation_time"])
    places = sorted(set(zip(runs.particles_per_cell, runs.relaxation_time, strict=True)))
    for name, part in runs.groupby("kind"):
        pairs = zip(part.particles_per_cell, part.relaxation_time, strict=True)
        x = [places.index(pair) for pair in pairs]
        axes.errorbar(x, part.alpha, part.alpha_error, label=name, **LOOKS[name], **style.POINTS)
    names = [f"$n = {n}$\n$t_r = {relaxed:g}$" for n, relaxed in places]
    axes.set_xticks(range(len(places)), names)
    axes.tick_params(axis="x", length=0)
    axes.set_xlim(-0.5, len(places) - 0.5)


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    used = [result for result in results if kind(result) in set(table.kind)]
    fitted = used[0].parameters["observation-time"] / 10 ** used[0].parameters["fit-decades"]
    said = []
    for sigma, part in like_the_paper(table).groupby("sigma"):
        runs = part.drop_duplicates("kind").sort_values("kind", key=lambda names: names != PAPER)
        alphas = [with_error(one.alpha, one.alpha_error) for one in runs.itertuples()]
        said.append(f"{listed(alphas)} at σ = {number(sigma)}")
    (control,) = set(table.kind) - {PAPER}
    conserved = table[table.kind == PAPER].momentum_drift.max()
    unequal = " for unequal masses" if 0 in table.sigma.to_numpy() else ""
    logarithms = table.dropna(subset="logarithmic_power").sort_values("logarithmic_power")
    least, most = (
        f"{with_error(one.logarithmic_power, one.logarithmic_power_error)} (σ = {number(one.sigma)}, n = {one.particles_per_cell}, t_r = {one.relaxation_time:g})"
        for one in logarithms.iloc[[0, -1]].itertuples()
    )
    claimed = (
        " The paper says that random directions give diffusion; with waiting times whose density falls as their inverse square α comes to it from below."
        if control == CONTROLS[1]
        else ""
    )
    return f"""
        Spreading of a tagged particle in a closed chain, {parameters(used, "cells", "cell-length", "temperature", "gamma")},
        n particles per cell, relaxed for t_r, {replicas(used)}. Above, local slopes of ln ⟨x²⟩ against ln t for the paper's
        number of particles and the longest relaxation; below, the exponent α of all runs, about both guides on larger scales, fitted in the
        shaded decade, from t = {fitted:g} on. Guides: ballistic and diffusive. {ERRORS}. α with {PAPER}, and with {control}: {"; ".join(said)}. In the paper's ensemble the
        total momentum of particles and scatterers is random, and conserved to {conserved:.0e} of the sum of all momenta; the
        superdiffusion that the paper reads from it is this drift, and with {control} it is gone{unequal}. Fits of t times a power of its logarithm to the runs without drift give powers from {least} to {most};
        diffusion has none, and waiting times without a variance leave some for as long as they are watched.{claimed}"""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table = shown(tabulate(results))
    sigmas = sorted(table[table.kind != PAPER].sigma.unique())
    table = table[table.sigma.isin(sigmas)].reset_index(drop=True)
    figure, rows = plt.subplots(
        3,
        len(sigmas),
        sharey="row",
        figsize=(style.COLUMN * max(2, 0.4 + 0.6 * len(sigmas)), 1.9 * style.HEIGHT),
        height_ratios=[1.6, 1, 1],
    )
    options = results[0].parameters
    until = options["observation-time"]
    for sigma, (above, ballistic, diffusive) in zip(sigmas, rows.T, strict=True):
        part = table[table.sigma == sigma]
        draw_slopes(above, like_the_paper(part))
        draw_exponents(ballistic, part[part.kind == PAPER])
        draw_exponents(diffusive, part[part.kind != PAPER])
        above.axvspan(until / 10 ** options["fit-decades"], until, **style.WINDOW)
        above.text(0.05, 0.92, rf"$\sigma = {sigma:g}$", transform=above.transAxes, va="top")
        for axes, value in ((above, 1), (above, 2), (ballistic, 2), (diffusive, 1)):
            axes.axhline(value, **style.GUIDE)
    slope = r"$d\ln\langle x^2\rangle/d\ln t$"
    rows[0, 0].set(xlabel=f"time $t$ ({style.UNITS})", ylabel=slope, ylim=(0.6, 2.4))
    for axes in rows[1:, 0]:
        axes.set_ylabel(r"$\alpha$ of $\langle x^2\rangle \sim t^\alpha$")
    style.letter(*rows.flat)
    (paper, its_name), (control, name) = (axes.get_legend_handles_labels() for axes in rows[1:, 0])
    figure.legend([*paper, *control], [*its_name, *name], loc="outside upper center", ncols=2)
    figure.align_ylabels()
    return figure, table, caption(table, results)


def title(results: Sequence[Result]) -> str:
    (control,) = {*shown(tabulate(results)).kind} - {PAPER}
    return f"Local exponent of the spreading of a tagged particle, with {control} beside the paper's start"


if __name__ == "__main__":
    run(draw, title, slope="1", slope_error="1")
