"""Ext. 11: linear response of the currents of energy and particles, and heat conductivity without a particle current.

J_i = sum_k L_ik X_k / N with X_u = 1/T_R - 1/T_L and X_n = (mu/T)_L - (mu/T)_R, where mu/T = ln(nu/sqrt(T)) + const for
half-Gaussian baths [eq. 29]. What is called heat conductivity elsewhere has no current of particles,
κ_0 = (L_uu - L_un L_nu/L_nn)/T^2.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.figures.ext09 import LOOKS, by_spacing, gas, spacings
from workflow.lib import style
from workflow.lib.caption import BATHS, goodness, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import fit_power, with_error
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result

DRAWN = 4000  # samples of the currents, for errors good to 1 %
TOP = 1.15  # of what is drawn from 0 on, over its largest value
COEFFICIENTS = ("L_uu", "L_un", "L_nu", "L_nn")


@dataclass(frozen=True)
class Response:
    """Currents of a run and the forces that drive them."""

    cells: int
    forces: np.ndarray  # X_u, X_n
    currents: np.ndarray  # J_u, J_n
    covariance: np.ndarray
    temperature: float  # geometric mean of the baths'
    sound: bool

    @classmethod
    def of(cls, result: Result) -> "Response":
        rates, temperatures = (
            np.array([float(result.parameters[f"{name}-{side}"]) for side in ("left", "right")])
            for name in ("nu", "temperature")
        )
        potentials = np.log(rates / np.sqrt(temperatures))
        quantities = [result[name] for name in ("energy_current", "particle_current")]
        errors = np.array([float(quantity.error) for quantity in quantities])
        correlation = float(result["current_correlation"].mean)
        return cls(
            int(result.parameters["cells"]),
            np.array([np.diff(1 / temperatures)[0], -np.diff(potentials)[0]]),
            np.array([float(quantity.mean) for quantity in quantities]),
            np.outer(errors, errors) * np.array([[1, correlation], [correlation, 1]]),
            float(np.sqrt(np.prod(temperatures))),
            result.sound,
        )

    def drawn(self, random: np.random.Generator) -> np.ndarray:
        """Samples of the currents, by standard normal numbers that do not depend on the units."""
        errors = np.sqrt(np.diag(self.covariance))
        product = np.prod(errors)
        correlation = self.covariance[0, 1] / product if product else 0.0
        first, second = random.standard_normal((2, DRAWN))
        both = np.stack([first, correlation * first + np.sqrt(1 - correlation**2) * second], axis=1)
        currents: np.ndarray = self.currents + errors * both
        return currents


def onsager(temperature: Response, pressure: Response) -> dict[str, float]:
    """L from a run at equal pressure and one at equal temperature, and kappa = -J_u N/(T_R - T_L) of the former. The errors
    are those of currents that are drawn anew from normal distributions with the runs' covariances."""
    runs = (temperature, pressure)
    inverse = np.linalg.inv(np.stack([run.forces for run in runs], axis=1)) * temperature.cells
    currents = np.stack([run.currents for run in runs], axis=1)
    random = np.random.default_rng(0)
    drawn = np.stack([run.drawn(random) for run in runs], axis=2)
    matrix, spread = currents @ inverse, drawn @ inverse
    row: dict[str, float] = {"usable": all(run.sound for run in runs)}
    for index, name in enumerate(COEFFICIENTS):
        place = divmod(index, 2)
        row[name], row[f"{name}_error"] = matrix[place], spread[:, *place].std()

    def heat(found: np.ndarray) -> np.ndarray:
        convected = found[..., 0, 1] * found[..., 1, 0] / found[..., 1, 1]
        kappa: np.ndarray = (found[..., 0, 0] - convected) / pressure.temperature**2
        return kappa

    row["kappa_0"], row["kappa_0_error"] = float(heat(matrix)), float(heat(spread).std())
    per_current = temperature.cells / (temperature.forces[0] * temperature.temperature**2)
    row["kappa"] = per_current * temperature.currents[0]
    row["kappa_error"] = abs(per_current) * np.sqrt(temperature.covariance[0, 0])
    asymmetry = spread[:, 0, 1] - spread[:, 1, 0]
    row["asymmetry"], row["asymmetry_error"] = matrix[0, 1] - matrix[1, 0], asymmetry.std()
    return row


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per gas and size."""
    runs: dict[tuple[str, int], dict[bool, Response]] = {}
    for result in results:
        response = Response.of(result)
        key = gas(result), response.cells
        runs.setdefault(key, {})[bool(response.forces[0])] = response
    rows = [{"gas": key[0], "cells": key[1]} | onsager(pair[True], pair[False]) for key, pair in runs.items()]
    return pd.DataFrame(rows).sort_values("cells", ignore_index=True)


def growth(part: pd.DataFrame, column: str) -> str:
    """Exponent of a power law through all sizes, or that there is none, and the exponents between the smallest and the largest two."""
    law = fit_power(part.cells, part[column], part[f"{column}_error"])
    _, slope, error = local_exponents(part.cells, part[column], part[f"{column}_error"])
    first, last = (with_error(slope[k], error[k]) for k in (0, -1))
    whole = "no single power" if law.rejected else f"N^{with_error(law.exponent, law.error)}"
    return f"{whole} ({goodness(law.chi_square, law.freedom)}), local exponents from {first} to {last}"


def crossed(table: pd.DataFrame) -> str:
    unsound = int((~table.usable.astype(bool)).sum())
    return (
        f" Crosses: {unsound} points of which a run is not stationary or missed its target error."
        if unsound
        else ""
    )


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table = tabulate(results)
    figure, (left, right, local) = plt.subplots(1, 3, figsize=(2.1 * style.COLUMN, style.HEIGHT))
    said, spacing = [], spacings(results)
    for name, part in table.groupby("gas", sort=False):
        marker, color = LOOKS[name]
        look = {"marker": marker, "color": color, **style.POINTS}
        per_cell = part.L_nn / part.cells
        label = rf"$\lambda = {spacing[name]}$"
        left.errorbar(part.cells, per_cell, part.L_nn_error / part.cells, label=label, **look)
        right.errorbar(part.cells, part.kappa_0, part.kappa_0_error, **look)
        local.errorbar(*local_exponents(part.cells, part.kappa_0, part.kappa_0_error), **look)
        for axes, column in ((left, per_cell), (right, part.kappa_0)):
            style.cross_out(axes, part.cells.to_numpy(), column.to_numpy(), ~part.usable.to_numpy(dtype=bool))
        grows = [
            f"{symbol} {growth(part, column)}" for symbol, column in (("L_nn", "L_nn"), ("κ_0", "kappa_0"))
        ]
        said.append(f"at spacing {spacing[name]} {', '.join(grows)}")
    size = np.array([table.cells.min(), table.cells.max()], dtype=float)
    guide = 0.6 * table.kappa_0.min() * (size / size[0]) ** (1 / 3)
    right.plot(size, guide, **style.GUIDE)
    right.text(size[1], 0.85 * guide[1], "$N^{1/3}$", size=8, ha="right", va="top")
    for axes in (left, right, local):
        axes.set(xscale="log", xlabel="number of cells $N$")
        style.label_sizes(axes.xaxis)
    right.set(yscale="log", ylabel=rf"$\kappa_0$ at $J_n = 0$ ({style.UNITS})")
    style.label_within_decades(right.yaxis)
    left.set(ylabel=rf"$L_{{nn}}/N$ ({style.UNITS})", ylim=(0, TOP * (table.L_nn / table.cells).max()))
    local.set(ylabel=r"$d\ln\kappa_0/d\ln N$", ylim=(0, None))
    style.guide_at(local, 1 / 3, "1/3")
    left.legend(loc="lower left")
    style.letter(left, right, local)
    ratio = table.kappa_0 / table.kappa
    pulls = table.asymmetry / table.asymmetry_error
    worst = table.loc[pulls.abs().idxmax()]
    caption = (
        f"Linear response at γ = N, {parameters(results, 'sigma')}, from a difference of temperature at equal pressure and one "
        f"of pressure at equal temperature ({parameters(results, *BATHS)}), {replicas(results)}: N J_i = Σ L_ik X_k with the forces X_u, the "
        "difference of the inverse temperatures, and X_n, that of ln(ν/√T). (a) Coefficient of the particle current over N; without friction in the bulk, as momentum is "
        "conserved, it would be constant. (b) Heat conductivity without a current of "
        f"particles, κ_0 = (L_uu - L_un L_nu / L_nn)/T^2, {ratio.min():.1f} to {ratio.max():.1f} times −J_U N/(T_R − T_L) at equal "
        f"pressure, where particles carry energy against the heat. (c) Its local exponents between neighbouring sizes, which share one. Growth over all sizes: {'; '.join(said)}. Onsager's symmetry "
        f"L_un = L_nu: {goodness(float(np.sum(pulls**2)), len(pulls))}, the farthest off by {100 * worst.asymmetry / worst.L_un:.1f} % "
        f"at N = {worst.cells} and spacing {spacing[worst.gas]}.{crossed(table)} Error bars: standard errors over replicas."
    )
    return figure, by_spacing(table, spacing), caption


if __name__ == "__main__":
    units = {"L_uu": "energy^2/time", "L_un": "energy/time", "L_nu": "energy/time", "L_nn": "1/time"}
    units |= {
        "kappa": "energy/(time temperature)",
        "kappa_0": "energy/(time temperature)",
        "asymmetry": "energy/time",
    }
    run(
        draw,
        "Linear response of energy and particle currents",
        **units,
        **{f"{k}_error": v for k, v in units.items()},
    )
