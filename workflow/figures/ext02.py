"""Ext. 2: local exponent of the heat conductivity, d ln kappa / d ln N, at the paper's spacing and at fixed spacings, with three
definitions of the temperature difference."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from workflow.figures.ext09 import LOOKS, by_spacing, spacings, tabulate
from workflow.lib import style
from workflow.lib.caption import ERRORS, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import with_error
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result

BESIDE = 1.07  # factor of the sizes at which neighbouring spacings are plotted: points would hide each other
# Suffixes of columns, and titles, by whose temperatures eq. 28 has.
DEFINITIONS = {"": "$T_1$, $T_N$", "_particle": "arriving particles", "_baths": "baths"}


def local(part: pd.DataFrame) -> pd.DataFrame:
    """Between neighbouring sizes of one spacing, for each definition of kappa."""
    found: dict[str, np.ndarray] = {}
    for name in DEFINITIONS:
        middle, slope, error = local_exponents(part.cells, part[f"kappa{name}"], part[f"kappa{name}_error"])
        found |= {"size": middle, f"exponent{name}": slope, f"exponent{name}_error": error}
    return pd.DataFrame(found)


def caption(exponents: pd.DataFrame, results: Sequence[Result]) -> str:
    ends = {
        spacing: " to ".join(with_error(*part[["exponent", "exponent_error"]].iloc[k]) for k in (0, -1))
        for spacing, part in exponents.groupby("spacing", sort=False)
    }
    ranges = ", ".join(f"{text} at λ = {spacing}" for spacing, text in ends.items())
    return f"""
        Local exponents of κ = −J_U N/ΔT between neighbouring sizes, runs of ext. 9; {parameters(results, "gamma", "sigma")},
        {replicas(results)}. ΔT is that of (a) the first and the last scatterer, as in the paper, (b) the particles that arrive there, (c) the baths. Dashed: 1/3.
        At the paper's spacing λ = 1/N the gas thins out as the chain grows; fixed λ has a thermodynamic limit. From the
        smallest to the largest sizes the exponents of (a) go from {ranges}. Neighbouring points share a size; spacings are shifted sideways. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    table, spacing = tabulate(results), spacings(results)
    gases = table.groupby("gas", sort=False)
    exponents = pd.concat([local(part).assign(gas=name) for name, part in gases])
    figure, row = plt.subplots(1, len(DEFINITIONS), sharey=True, figsize=(2 * style.COLUMN, style.HEIGHT))
    for axes, (suffix, title) in zip(row, DEFINITIONS.items(), strict=True):
        for place, (name, part) in enumerate(exponents.groupby("gas", sort=False)):
            look = style.points(*LOOKS[name], label=rf"$\lambda = {spacing[name]}$")
            size = BESIDE ** (place - 1) * part["size"]
            axes.errorbar(size, part[f"exponent{suffix}"], part[f"exponent{suffix}_error"], **look)
        style.guide_at(axes, 1 / 3, "1/3" * (axes is row[-1]))
        axes.set_title(title)
        style.against_size(axes)
    row[0].set(ylabel=r"$d\ln\kappa/d\ln N$", ylim=(0, None))
    figure.legend(*row[0].get_legend_handles_labels(), loc="outside upper center", ncols=len(spacing))
    style.letter(*row)
    whole = by_spacing(exponents, spacing)
    return figure, whole, caption(whole, results)


if __name__ == "__main__":
    exponents = {f"exponent{name}": "1" for name in DEFINITIONS}
    run(draw, "Local exponent of the heat conductivity", size="1", **exponents)
