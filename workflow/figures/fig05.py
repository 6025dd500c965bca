"""Fig. 5: persistence mu against the mass ratio sigma, with the law arccos(sigma)/pi."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import ERRORS, listed, number, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import with_error
from workflow.lib.load import NOT_REACHED, Result

MARKS = [
    {"marker": "o", "color": style.BLUE, "markerfacecolor": style.BLUE},
    {"marker": "s", "color": style.VERMILLION, "markerfacecolor": "white"},
]
DASHES = ["dashed", "dotted"]


def law(sigma: np.ndarray) -> np.ndarray:
    """Particle and scatterer Gaussian and independent, at one temperature."""
    share: np.ndarray = np.arccos(sigma) / np.pi
    return share


def law_at_local_energies(table: pd.DataFrame) -> pd.Series:
    """The same at the mean energies that particles and scatterers have when they meet."""
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
    table.insert(4, "law", law(table.sigma))
    table.insert(5, "deviation", table.mu - table.law)
    table["law_at_local_energies"] = law_at_local_energies(table)
    return table


def pulls(series: pd.DataFrame) -> str:
    """Largest deviation from the law and chi^2 of all, where the law is not exact."""
    known = series[series.mu_error > 0]
    far = known.loc[known.deviation.abs().idxmax()]
    ratio = far.scatterer_energy / far.particle_energy
    chi_square = float(((known.deviation / known.mu_error) ** 2).sum())
    return (
        f"n = {int(far.particles_per_cell)}: at most {with_error(far.deviation, far.mu_error)}, at σ = {number(far.sigma)}, "
        f"where scatterers have {100 * ratio:.0f} % of the energy of the particles that they meet; "
        f"χ² = {chi_square:.0f} for {len(known)} points"
    )


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    said = [pulls(series) for _, series in table.groupby("particles_per_cell")]
    sizes = listed(f"n = {particles}" for particles in table.particles_per_cell.unique())
    return f"""
        Persistence μ, the probability that a particle keeps its direction when it scatters, against the mass ratio
        σ = (M − m)/(M + m) in closed chains of {parameters(results, "cells", "cell-length", "gamma", "temperature", "relaxation-time")}
        with {sizes} particles per cell; {replicas(results)} per point. (a) μ and the law arccos(σ)/π, which holds for Gaussian
        particles and scatterers of one temperature. (b) μ minus the law, in thousandths; broken and dotted lines: the law at the local mean
        energies of particles and scatterers, whose difference explains a part of it. {ERRORS}. Deviation from the law: {"; ".join(said)}.
        The paper has the smaller n and sees no deviation; it is smaller in the chain with the larger n. The paper calls particles persistent for all unequal masses;
        by its own law they are only where scatterers are the lighter."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table = tabulate(results)
    figure, (above, below) = plt.subplots(
        2, 1, sharex=True, figsize=(style.COLUMN, 1.4 * style.HEIGHT), height_ratios=[2.2, 1]
    )
    sigma = np.sin(np.linspace(-np.pi / 2, np.pi / 2, 401))
    above.plot(sigma, law(sigma), color=style.BLACK, label=r"$\arccos(\sigma)/\pi$", zorder=1)
    below.axhline(0, color=style.BLACK, zorder=1)
    for (particles, series), mark, dashes in zip(
        table.groupby("particles_per_cell"), MARKS, DASHES, strict=True
    ):
        label = f"$n = {particles}$"
        above.errorbar(series.sigma, series.mu, series.mu_error, label=label, **mark, **style.POINTS)
        below.errorbar(series.sigma, 1e3 * series.deviation, 1e3 * series.mu_error, **mark, **style.POINTS)
        expected = 1e3 * (series.law_at_local_energies - series.law)
        label = f"law at local energies, $n = {particles}$"
        below.plot(series.sigma, expected, color=mark["color"], linestyle=dashes, zorder=1, label=label)
        style.cross_out(above, series.sigma, series.mu, series.converged == NOT_REACHED)
    below.legend(loc="lower left")
    above.set(ylabel=r"persistence $\mu$", xlim=(-1.04, 1.04), ylim=(-0.03, 1.03))
    above.legend(loc="upper right", title=f"$N = {results[0].parameters['cells']}$")
    below.set(xlabel=r"mass ratio $\sigma = (M-m)/(M+m)$", ylabel=r"$10^3\,(\mu - \mathrm{law})$")
    style.letter(above, below)
    figure.align_ylabels()
    return figure, table, caption(table, results)


if __name__ == "__main__":
    numbers = ("law", "deviation", "law_at_local_energies")
    run(draw, "Persistence probability against the mass ratio", **dict.fromkeys(numbers, "1"))
