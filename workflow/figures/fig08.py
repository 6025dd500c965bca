"""Fig. 8: heat conductivity against the number of cells.

Lines: the chain of as many scatterers without correlations (mean field); its distance from the points is what
correlations do. Points whose window is not stationary, or whose run stopped before its target, are crossed out and not fitted.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.fit import PowerLaw, fit_power
from workflow.lib.load import NOT_REACHED, Result

GUIDES = {"N": (1 / 3, r"$N^{1/3}$"), 1: (1, "$N$")}  # the paper's exponents, by gamma


def measured(results: Sequence[Result]) -> list[Result]:
    return [result for result in results if result.provenance["program"] == "conductivity"]


def mean_field(results: Sequence[Result]) -> pd.DataFrame:
    """kappa of the chains without correlations, sorted by N."""
    rows = []
    for result in results:
        if result.provenance["program"] == "boltzmann":
            cells, temperature = int(result.parameters["cells"]), result["temperature_scatterer"].mean
            kappa = -float(result["energy_current"].mean) * cells / (temperature[-1] - temperature[0])
            rows.append({"gamma": "N", "cells": cells, "mean_field_kappa": kappa})
    return pd.DataFrame(rows).sort_values("cells")


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, sorted by gamma and N."""
    rows = []
    for result in measured(results):
        row = {"gamma": result.parameters["gamma"], "cells": result.parameters["cells"]}
        for name in ("kappa", "kappa_particle", "kappa_plain", "kappa_printed", "energy_current"):
            row[name], row[f"{name}_error"] = (
                float(value) for value in (result[name].mean, result[name].standard_error)
            )
        row["sound"] = result.converged != NOT_REACHED and result["stationary"].mean == 1
        rows.append(row)
    return pd.DataFrame(rows).sort_values("cells")


def exponent(table: pd.DataFrame) -> PowerLaw:
    """Over the sound points of one gamma."""
    sound = table[table.sound]
    return fit_power(sound.cells, sound.kappa, sound.kappa_error)


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    table = tabulate(results)
    figure, axes = plt.subplots(figsize=(style.COLUMN, 1.2 * style.HEIGHT))
    for gamma, (marker, color) in style.BY_GAMMA.items():
        part = table[table.gamma == gamma]
        law = exponent(part)
        fitted = rf"$\kappa \sim N^{{{law.text}}}$, $\chi^2/f = {law.chi_square:.1f}/{law.freedom}$"
        label = rf"$\gamma = {gamma}$: {fitted}"
        look = {"color": color, **style.POINTS}
        axes.errorbar(part.cells, part.kappa, part.kappa_error, marker=marker, label=label, **look)
        axes.errorbar(
            part.cells, part.kappa_particle, part.kappa_particle_error, marker="|", **{**look, "alpha": 0.5}
        )
        slope, name = GUIDES[gamma]
        size = np.array([part.cells.min(), part.cells.max()])
        axes.plot(size, 0.6 * part.kappa.iloc[0] * (size / size[0]) ** slope, **style.GUIDE)
        below = 0.48 * part.kappa.iloc[0] * (size[1] / size[0]) ** slope
        axes.text(size[1], below, name, size=8, ha="center", va="top")
        style.cross_out(axes, part.cells.to_numpy(), part.kappa.to_numpy(), ~part.sound.to_numpy())
    theory = mean_field(results)
    color = style.BY_GAMMA["N"][1]
    axes.plot(theory.cells, theory.mean_field_kappa, color=color, label=r"$\gamma = N$, mean field")
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="number of cells $N$",
        ylabel=rf"conductivity $\kappa$ ({style.UNITS})",
    )
    axes.legend(loc="upper left", title="bars: from the particles' temperature", title_fontsize=7)
    axes.set_ylim(top=60 * table.kappa.max())
    return figure, table.merge(theory, how="left", on=["gamma", "cells"])


if __name__ == "__main__":
    kappa = "energy/(time temperature)"
    run(draw, "Heat conductivity against the size of the chain", mean_field_kappa=kappa)
