"""Ext. 2: local exponent of the heat conductivity, d ln kappa / d ln N, at the paper's spacing and at fixed spacings, with three
definitions of the temperature difference.

Lines: exponents of κ_0 that linear response predicts at these sizes from rings in equilibrium (ext. 11). They are compared with κ for
the temperatures of the baths. At equal pressures κ is proportional to κ_0, as the ratio of convected to conducted heat does not depend
on N.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.caption import ERRORS, parameters, replicas
from workflow.lib.conductivity import LOOKS, by_spacing, drive, spacings, tabulate
from workflow.lib.figure import Drawn, require_elastic, run
from workflow.lib.fit import with_error
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result
from workflow.lib.response import response

BESIDE = (
    1.07  # ratio of the abscissas of points of equal N at neighbouring spacings, so that they do not overlap
)
# Suffix of the columns and title of the panel, by the temperatures whose difference is used in eq. 28.
DEFINITIONS = {"": "$T_1$, $T_N$", "_particle": "arriving particles", "_baths": "baths"}


def local(part: pd.DataFrame) -> pd.DataFrame:
    """Local exponents between neighbouring sizes of one spacing, for each definition of kappa."""
    columns: dict[str, np.ndarray] = {}
    for name in DEFINITIONS:
        middle, slope, error = local_exponents(part.cells, part[f"kappa{name}"], part[f"kappa{name}_error"])
        columns |= {"size": middle, f"exponent{name}": slope, f"exponent{name}_error": error}
    return pd.DataFrame(columns)


def expected(weak: Sequence[Result], results: Sequence[Result]) -> pd.DataFrame:
    """Local exponents of κ_0 between neighbouring sizes that linear response predicts, for the gases of ext. 11."""
    table, _ = response(weak, results)
    parts = []
    for name, part in table.groupby("gas", sort=False):
        size, slope, error = local_exponents(part.cells, part.predicted, part.predicted_error)
        columns = {"gas": name, "size": size, "expected": slope, "expected_error": error}
        parts.append(pd.DataFrame(columns))
    return pd.concat(parts)


def caption(exponents: pd.DataFrame, results: Sequence[Result]) -> str:
    ends = {
        spacing: " to ".join(with_error(*part[["exponent", "exponent_error"]].iloc[k]) for k in (0, -1))
        for spacing, part in exponents.groupby("spacing", sort=False)
    }
    ranges = ", ".join(f"{text} at λ = {spacing}" for spacing, text in ends.items())
    return f"""
        Local exponents of κ = −J_U N/ΔT between neighbouring sizes, runs of ext. 9; {parameters(results, "gamma", "sigma")},
        {replicas(results)}. ΔT is that of (a) the first and the last scatterer, as in the paper, (b) the particles that arrive there, (c) the baths;
        lines: linear response, from rings in equilibrium (ext. 11). Dashed: 1/3.
        At the paper's λ = 1/N the gas thins out; fixed λ has a thermodynamic limit. From the
        smallest sizes to the largest those of (a) go from {ranges}. Spacings are shifted sideways. {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    require_elastic([result for result in results if "nu-left" in result.parameters], "linear response")
    chains = [result for result in results if result.provenance["program"] == "conductivity"]
    strongest = max(map(drive, chains))
    strong = [result for result in chains if drive(result) == strongest]
    weak = [result for result in chains if drive(result) < strongest]
    table, spacing = tabulate(strong), spacings(strong)
    gases = table.groupby("gas", sort=False)
    exponents = pd.concat([local(part).assign(gas=name) for name, part in gases])
    theory = expected(weak, results)
    figure, row = plt.subplots(1, len(DEFINITIONS), sharey=True, figsize=(2 * style.COLUMN, style.HEIGHT))
    for axes, (suffix, title) in zip(row, DEFINITIONS.items(), strict=True):
        for rank, (name, part) in enumerate(exponents.groupby("gas", sort=False)):
            look = style.points(*LOOKS[name], label=rf"$\lambda = {spacing[name]}$")
            size = BESIDE ** (rank - 1) * part["size"]
            axes.errorbar(size, part[f"exponent{suffix}"], part[f"exponent{suffix}_error"], **look)
        style.guide_at(axes, 1 / 3, "1/3" * (axes is row[-1]))
        axes.set_title(title)
        style.against_size(axes)
    for name, part in theory.groupby("gas", sort=False):
        look = style.points("_", LOOKS[name][1], markersize=8, linestyle="-", capsize=0, zorder=1)
        row[-1].errorbar(part["size"], part.expected, part.expected_error, **look)
    row[0].set(ylabel=r"$d\ln\kappa/d\ln N$", ylim=(0, None))
    figure.legend(*row[0].get_legend_handles_labels(), loc="outside upper center", ncols=len(spacing))
    style.letter(*row)
    whole = by_spacing(pd.concat([exponents, theory]), spacing)
    return figure, whole, caption(whole.dropna(subset="exponent"), strong)


if __name__ == "__main__":
    exponents = {f"exponent{name}": "1" for name in DEFINITIONS}
    run(draw, "Local exponent of the heat conductivity", size="1", expected="1", **exponents)
