"""Fig. 5: persistence mu against the mass ratio sigma, with the law arccos(sigma)/pi."""

from collections.abc import Sequence
from itertools import cycle

import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.caption import ERRORS, listed, parameters
from workflow.lib.figure import Parts, plots, require_elastic
from workflow.lib.fit import format_with_error
from workflow.lib.load import NOT_REACHED, Result
from workflow.physics.closed import persistence_law

TITLE = "Persistence probability against the mass ratio"
UNITS = dict.fromkeys(("law", "deviation", "law_at_local_energies"), "1")

MARKS = [
    style.points(*look) for look in (("o", style.BLUE), ("s", style.VERMILLION, "white"), ("^", style.GREEN))
]


def law_at_local_energies(table: pd.DataFrame) -> pd.Series:
    """Persistence for independent Gaussian momenta with the measured mean energies of particles and
    scatterers before collisions."""
    c = np.sqrt((1 - table.sigma) * (1 + table.sigma))
    speeds = np.sqrt(table.particle_energy / table.scatterer_energy)
    return 0.5 - np.arctan2(table.sigma * speeds, c) / np.pi


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, by number of particles and sigma."""
    rows = [
        {
            "particles_per_cell": int(result.parameters["particles-per-cell"]),
            "sigma": float(result.parameters["sigma"]),
            "mu": float(result["mu"].mean),
            "mu_error": float(result["mu"].error),
            "particle_energy": float(result["particle_energy"].mean),
            "scatterer_energy": float(result["scatterer_energy"].mean),
            "replicas": int(result["mu"].replicas),
            "converged": result.converged,
        }
        for result in results
    ]
    table = pd.DataFrame(rows).sort_values(["particles_per_cell", "sigma"], ignore_index=True)
    table.insert(4, "law", persistence_law(table.sigma))
    table.insert(5, "deviation", table.mu - table.law)
    table["law_at_local_energies"] = law_at_local_energies(table)
    return table


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    largest = []
    for particles, series in table.groupby("particles_per_cell"):
        far = series.loc[series.deviation.abs().idxmax()]
        largest.append(f"{format_with_error(far.deviation, far.mu_error)} at n = {particles}")
    return f"""
        The paper plots the probability μ that a particle keeps its direction in a scattering and finds arccos(σ)/π ({parameters(results, "cells", "gamma", "temperature")}).
        Here the largest differences are {listed(largest)} particles per cell. (a) The line shows the law. (b) Dashes show the law for the energies
        measured before collisions. {ERRORS}"""


@plots("paper dense")
def draw(results: Sequence[Result]) -> Parts:
    require_elastic(results, "the law arccos(σ)/π")
    table = tabulate(results)
    figure, (above, below) = style.stacked(2.2, 1, height=1.4)
    sigma = np.sin(np.linspace(-np.pi / 2, np.pi / 2, 401))
    above.plot(sigma, persistence_law(sigma), color=style.BLACK, label=r"$\arccos(\sigma)/\pi$", zorder=1)
    below.axhline(0, color=style.BLACK, zorder=1)
    for (particles, series), mark in zip(table.groupby("particles_per_cell"), cycle(MARKS), strict=False):
        label = f"$n = {particles}$"
        above.errorbar(series.sigma, series.mu, series.mu_error, label=label, **mark)
        below.errorbar(series.sigma, 1e3 * series.deviation, 1e3 * series.mu_error, **mark)
        expected = 1e3 * (series.law_at_local_energies - series.law)
        dash: style.Look = {"linestyle": "none", "marker": "_", "markersize": 7, "markeredgewidth": 1.2}
        below.plot(series.sigma, expected, color=mark["color"], zorder=1, **dash)
        style.cross_out(above, series.sigma, series.mu, series.converged == NOT_REACHED)
    above.plot([], [], color="grey", label="law at measured energies", **dash)
    above.set(ylabel=r"persistence $\mu$", xlim=(-1.04, 1.04), ylim=(-0.03, 1.03))
    above.legend(loc="upper right", title=f"$N = {results[0].parameters['cells']}$")
    below.set(xlabel=r"mass ratio $\sigma = (M-m)/(M+m)$", ylabel=r"$10^3\,(\mu - \mathrm{law})$")
    return figure, table, caption(table, results)
