"""Ext. 11: linear response of the currents of energy and particles, and heat conductivity without a particle current.

J_i = sum_k L_ik X_k / N with X_u = 1/T_R - 1/T_L and X_n = (mu/T)_L - (mu/T)_R, where mu/T = ln(nu/sqrt(T)) + const for
half-Gaussian baths [eq. 29]. The heat conductivity without a current of particles is κ_0 = (L_uu - L_un L_nu/L_nn)/T^2.
Sound leaves the chain after the time t = τN/c, where c is the speed of sound in cells per time. κ_0 is that of a ring of the same gas
up to this time:
κ_0 = (√T/λ) ½ d(<Q²>/N)/dt, <Q²> measured in the units of T and λ [mode_coupling.md, eq. M33].
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.caption import BATHS, listed, parameters, replicas
from workflow.lib.conductivity import LOOKS, by_spacing, spacings
from workflow.lib.figure import Drawn, require_elastic, run
from workflow.lib.fit import with_error
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result
from workflow.lib.response import DENSE, response

TOP = 1.15  # upper end of the axis over the largest value


def crossed(table: pd.DataFrame) -> str:
    """Sentence of the caption on the crossed points; empty if there are none."""
    unsound = int((~table.usable).sum())
    text = f" Crosses: {unsound} points of which a run is not stationary or missed its target error."
    return text if unsound else ""


def draw(results: Sequence[Result]) -> Drawn:
    require_elastic(
        [result for result in results if "nu-left" in result.parameters], "the conductivity of mode coupling"
    )
    open_chains = [result for result in results if result.provenance["program"] == "conductivity"]
    spacing = spacings(open_chains)
    table, tau = response(open_chains, results)
    thinning = table[table.gas == "thinning"]
    figure, (left, right, local) = plt.subplots(1, 3, figsize=(2.1 * style.COLUMN, style.HEIGHT))
    for name, part in table.groupby("gas", sort=False):
        look = style.points(*LOOKS[name])
        per_cell = part.L_nn / part.cells
        label = rf"$\lambda = {spacing[name]}$"
        left.errorbar(part.cells, per_cell, part.L_nn_error / part.cells, label=label, **look)
        right.errorbar(part.cells, part.kappa_0, part.kappa_0_error, **look)
        local.errorbar(*local_exponents(part.cells, part.kappa_0, part.kappa_0_error), **look)
        middle, slope, error = local_exponents(part.cells, part.predicted, part.predicted_error)
        right.plot(part.cells, part.predicted, color=look["color"])
        style.band(right, part.cells, part.predicted, part.predicted_error, look["color"])
        local.plot(middle, slope, color=look["color"])
        style.band(local, middle, slope, error, look["color"])
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
    ratio = thinning.kappa_0 / thinning.predicted
    error = ratio * np.hypot(
        thinning.kappa_0_error / thinning.kappa_0, thinning.predicted_error / thinning.predicted
    )
    caption = (
        f"Linear response at γ = N, {parameters(open_chains, 'sigma')}, from differences of temperature and of pressure "
        f"({parameters(open_chains, *BATHS)}), {replicas(open_chains)}. (a) L_nn/N, coefficient of the particle current; "
        "nearly constant, as momentum is conserved. (b) Heat conductivity without particle current. Lines: a ring of the same gas in "
        "equilibrium up to the time τN/c, in which sound leaves the chain; nothing else is fitted. At λ = "
        f"{spacing[DENSE]} τ = {with_error(tau.value, tau.error)} for all N (χ² = {tau.chi_square:.1f} for {tau.freedom}); with it, "
        f"measured over predicted at λ = 1/N: {listed(map(with_error, ratio, error))}. (c) Local exponents."
        f"{crossed(table)}"
    )
    return figure, by_spacing(table, spacing), caption


if __name__ == "__main__":
    units = {"L_uu": "energy^2/time", "L_un": "energy/time", "L_nu": "energy/time", "L_nn": "1/time"}
    conductivities = ("kappa", "kappa_0", "predicted")
    units |= dict.fromkeys(conductivities, "energy/(time temperature)") | {
        "asymmetry": "energy/time",
        "tau": "1",
    }
    run(draw, "Linear response of energy and particle currents", **units)
