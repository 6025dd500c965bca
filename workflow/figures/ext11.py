"""Ext. 11: linear response of the currents of energy and particles, and heat conductivity without a particle current.

J_i = sum_k L_ik X_k / N with X_u = 1/T_R - 1/T_L and X_n = (mu/T)_L - (mu/T)_R, where mu/T = ln(nu/sqrt(T)) + const for
half-Gaussian baths [eq. 29]. The heat conductivity without a current of particles is κ_0 = (L_uu - L_un L_nu/L_nn)/T^2.
Mode coupling predicts κ_0 = a + (3A/λ)(τλN/c)^(1/3), where sound leaves after the time τλN/c [mode_coupling.md, eq. M33].
"""

from collections.abc import Sequence
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from workflow.figures.ext09 import LOOKS, by_spacing, gas, spacings
from workflow.lib import style
from workflow.lib.caption import BATHS, listed, parameters, replicas
from workflow.lib.figure import Drawn, require_elastic, run
from workflow.lib.fit import Line, fit_line, with_error
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result
from workflow.lib.mode_coupling import Chain

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
        rates, temperatures = (np.array(result.ends(name)) for name in ("nu", "temperature"))
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
        return self.currents + errors * both


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
        return (found[..., 0, 0] - convected) / pressure.temperature**2

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
    transit = {}
    for result in results:
        response = Response.of(result)
        key = gas(result), response.cells
        transit[key] = sound_transit(result)
        runs.setdefault(key, {})[bool(response.forces[0])] = response
    rows = [
        {"gas": key[0], "cells": key[1], "sound_transit": transit[key]} | onsager(pair[True], pair[False])
        for key, pair in runs.items()
    ]
    return pd.DataFrame(rows).sort_values("cells", ignore_index=True)


def sound_transit(result: Result) -> float:
    """(3A/λ)(λN/c)^(1/3): the growing part of κ_0 for τ = 1, in the gas that the baths would keep in equilibrium."""
    rate, temperature = (float(np.sqrt(np.prod(result.ends(name)))) for name in ("nu", "temperature"))
    spacing, _ = style.spacing(result)
    sigma = result.parameters["sigma"]
    fugacity = rate * np.sqrt(2 / (np.pi * temperature))  # the flux of a bath at p = 0 [eq. 5]
    chain = Chain(fugacity * spacing, (1 + sigma) / (1 - sigma), temperature, spacing)
    return float(chain.conductivity(result.parameters["cells"], opening=1))


def fitted(part: pd.DataFrame) -> Line:
    """a and τ^(1/3), intercept and slope, from the sizes of one gas."""
    return fit_line(part.sound_transit, part.kappa_0, part.kappa_0_error)


def exponents(sizes: pd.Series, values: pd.Series, errors: pd.Series) -> str:
    _, slope, error = local_exponents(sizes, values, errors)
    return listed([with_error(*one) for one in zip(slope, error, strict=True)])


def crossed(table: pd.DataFrame) -> str:
    unsound = int((~table.usable).sum())
    told = f" Crosses: {unsound} points of which a run is not stationary or missed its target error."
    return told if unsound else ""


def draw(results: Sequence[Result]) -> Drawn:
    require_elastic(results, "the conductivity of mode coupling")
    table, spacing = tabulate(results), spacings(results)
    dense, thinning = (table[table.gas == name] for name in ("dense", "thinning"))
    law = fitted(dense)
    table["predicted"] = law.at(table.sound_transit)
    figure, (left, right, local) = plt.subplots(1, 3, figsize=(2.1 * style.COLUMN, style.HEIGHT))
    for name, part in table.groupby("gas", sort=False):
        look = style.points(*LOOKS[name])
        per_cell = part.L_nn / part.cells
        label = rf"$\lambda = {spacing[name]}$"
        left.errorbar(part.cells, per_cell, part.L_nn_error / part.cells, label=label, **look)
        right.errorbar(part.cells, part.kappa_0, part.kappa_0_error, **look)
        local.errorbar(*local_exponents(part.cells, part.kappa_0, part.kappa_0_error), **look)
        middle, slope, _ = local_exponents(part.cells, part.predicted, 0 * part.predicted)
        right.plot(part.cells, part.predicted, color=look["color"])
        local.plot(middle, slope, color=look["color"])
        for axes, column in ((left, per_cell), (right, part.kappa_0)):
            style.cross_out(axes, part.cells, column, ~part.usable)
    for axes in (left, right, local):
        style.against_size(axes)
    right.set(yscale="log", ylabel=rf"$\kappa_0$ at $J_n = 0$ ({style.UNITS})")
    style.label_within_decades(right.yaxis)
    left.set(ylabel=rf"$L_{{nn}}/N$ ({style.UNITS})", ylim=(0, TOP * (table.L_nn / table.cells).max()))
    local.set(ylabel=r"$d\ln\kappa_0/d\ln N$", ylim=(0, None))
    style.guide_at(local, 1 / 3, "1/3")
    left.legend(loc="lower left")
    style.letter(left, right, local)
    measured = {
        name: exponents(part.cells, part.kappa_0, part.kappa_0_error)
        for name, part in table.groupby("gas", sort=False)
    }
    slopes = local_exponents(thinning.cells, law.at(thinning.sound_transit), np.zeros(len(thinning)))[1]
    caption = (
        f"Linear response at γ = N, {parameters(results, 'sigma')}, from differences of temperature and of pressure "
        f"({parameters(results, *BATHS)}), {replicas(results)}. (a) L_nn/N, coefficient of the particle current; "
        "constant, as momentum is conserved. (b) Heat conductivity without particle current. (c) Its local exponents: "
        f"{measured['thinning']} at λ = 1/N, {measured['dense']} at λ = {spacing['dense']}. Lines: mode coupling, a + "
        f"b(τN)^(1/3), τ = {with_error(law.slope**3, 3 * law.slope**2 * law.error)} and a fitted at "
        f"λ = {spacing['dense']} (χ² = {law.chi_square:.0f} for {law.freedom}). At λ = 1/N it predicts "
        f"exponents that fall from {slopes[0]:.2f} to {slopes[-1]:.2f}.{crossed(table)}"
    )
    return figure, by_spacing(table, spacing), caption


if __name__ == "__main__":
    units = {"L_uu": "energy^2/time", "L_un": "energy/time", "L_nu": "energy/time", "L_nn": "1/time"}
    conductivities = ("kappa", "kappa_0", "sound_transit", "predicted")
    units |= dict.fromkeys(conductivities, "energy/(time temperature)") | {"asymmetry": "energy/time"}
    run(draw, "Linear response of energy and particle currents", **units)
