"""Ext. 11: linear response of the currents of energy and particles, and heat conductivity without a particle current, against rings in
equilibrium (workflow/physics/response.py).

Open symbols: local exponents at the strong drive of ext. 9, of κ with the temperatures of the baths. At equal pressures κ is
proportional to κ_0, as the ratio of convected to conducted heat does not depend on N.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.caption import ERRORS, format_number, parameters
from workflow.lib.figure import Parts, main, plots, require_elastic
from workflow.lib.fit import format_with_error
from workflow.lib.load import Result
from workflow.physics.conductivity import LOOKS, by_spacing, drive, gas, spacings, tabulate
from workflow.physics.growth import local_exponents
from workflow.physics.response import DENSE, Mean, response

TOP = 1.15  # upper end of the axis over the largest value
THINNING = "thinning"
OPEN = "thinning thinning-large dense dense-large "  # of ext. 9
FORCES = "thinning-temperature dense-temperature dense-temperature-large thinning-pressure dense-pressure dense-pressure-large "
CLOSED = "ring-16 ring-32 ring-64 ring-128 ring-256 dense dense-long dense-longest dilute dilute-long dilute-longest"  # and ext. 13
BESIDE = 1.07  # ratio of the abscissas of open and full symbols, so that they do not overlap


def strong_exponents(results: Sequence[Result]) -> pd.DataFrame:
    """Local exponents of κ between neighbouring sizes of the gases of `results`."""
    parts = []
    for name, part in tabulate(results).groupby("gas", sort=False):
        size, slope, error = local_exponents(part.cells, part.kappa_baths, part.kappa_baths_error)
        parts.append(pd.DataFrame({"gas": name, "size": size, "exponent": slope, "exponent_error": error}))
    return pd.concat(parts, ignore_index=True)


def caption(table: pd.DataFrame, tau: Mean, weak: Sequence[Result], strong: Sequence[Result]) -> str:
    spacing = spacings(weak)
    last = table[table.gas == THINNING].iloc[-1]
    ratio = last.kappa_0 / last.predicted
    error = ratio * np.hypot(last.kappa_0_error / last.kappa_0, last.predicted_error / last.predicted)
    crosses = " Crosses: not stationary." if not table.usable.all() else ""
    return f"""
        Linear response to small differences of temperature and pressure, {parameters(weak, "gamma", "sigma")}. (a) L_nn/N of the particle current.
        (b) Conductivity κ_0 without it; lines: rings until τN/c, when sound leaves the chain, τ = {format_with_error(tau.value, tau.error)}
        from λ = {spacing[DENSE]}. At λ = 1/N, κ_0 is in the end {format_with_error(ratio, error)} of the line. (c) Exponents; open: κ at T_R/T_L =
        {format_number(drive(strong[0]))}.{crosses} {ERRORS}"""


@plots(OPEN + FORCES + CLOSED)
def draw(results: Sequence[Result]) -> Parts:
    open_chains = [result for result in results if "nu-left" in result.parameters]
    require_elastic(open_chains, "the conductivity of mode coupling")
    strongest = max(map(drive, open_chains))
    weak = [result for result in open_chains if drive(result) < strongest]
    strong = [result for result in open_chains if drive(result) == strongest]
    spacing = spacings(weak)
    table, tau = response(weak, results)
    driven = strong_exponents([result for result in strong if gas(result) in spacing])
    figure, (left, right, local) = plt.subplots(1, 3, figsize=(2.1 * style.COLUMN, style.HEIGHT))
    for name, part in table.groupby("gas", sort=False):
        look, color = style.points(*LOOKS[name]), LOOKS[name][1]
        per_cell = part.L_nn / part.cells
        label = rf"$\lambda = {spacing[name]}$"
        left.errorbar(part.cells, per_cell, part.L_nn_error / part.cells, label=label, **look)
        right.errorbar(part.cells, part.kappa_0, part.kappa_0_error, **look)
        local.errorbar(*local_exponents(part.cells, part.kappa_0, part.kappa_0_error), **look)
        middle, slope, error = local_exponents(part.cells, part.predicted, part.predicted_error)
        right.plot(part.cells, part.predicted, color=color)
        style.band(right, part.cells, part.predicted, part.predicted_error, color)
        local.plot(middle, slope, color=color)
        style.band(local, middle, slope, error, color)
        for axes, column in ((left, per_cell), (right, part.kappa_0)):
            style.cross_out(axes, part.cells, column, ~part.usable)
        stronger = driven[driven.gas == name]
        open_look = style.points(*LOOKS[name], "white")
        local.errorbar(BESIDE * stronger["size"], stronger.exponent, stronger.exponent_error, **open_look)
    for axes in (left, right, local):
        style.against_size(axes)
    right.set(yscale="log", ylabel=rf"$\kappa_0$ at $J_n = 0$ ({style.UNITS})")
    style.label_within_decades(right.yaxis)
    left.set(ylabel=rf"$L_{{nn}}/N$ ({style.UNITS})", ylim=(0, TOP * (table.L_nn / table.cells).max()))
    local.set(ylabel=r"local exponent of $\kappa_0$, $\kappa$", ylim=(0, None))
    style.guide_at(local, 1 / 3, "1/3")
    left.legend(loc="lower left")
    style.letter(left, right, local)
    whole = by_spacing(pd.concat([table, driven]), spacing)
    return figure, whole, caption(table, tau, weak, strong)


if __name__ == "__main__":
    units = {"L_uu": "energy^2/time", "L_un": "energy/time", "L_nu": "energy/time", "L_nn": "1/time"}
    units |= dict.fromkeys(("kappa", "kappa_0", "predicted"), "energy/(time temperature)")
    units |= {"asymmetry": "energy/time", "tau": "1", "size": "1", "exponent": "1"}
    main(draw, "Linear response of energy and particle currents", **units)
