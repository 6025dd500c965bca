"""Inset of fig. 7: exponent alpha of the spreading against sigma, with the paper's random total momentum and with none.

Subtracting the motion of the centre of mass is shown too, and is not the same: the scatterers stand still, so a conserved
total momentum moves a particle at every collision, and with waiting times ~ tau^-2 the numbers of collisions differ between
particles by a part that falls only as 1/ln t. What is left by the subtraction grows nearly as t^2.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import NOT_REACHED, Result


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    rows = [
        {
            "sigma": float(result.parameters["sigma"]),
            "zero_total_momentum": bool(result.parameters["zero-total-momentum"]),
            "alpha": float(result["alpha"].mean),
            "alpha_error": float(result["alpha"].standard_error),
            "alpha_relative": float(result["alpha_relative"].mean),
            "alpha_relative_error": float(result["alpha_relative"].standard_error),
            "converged": result.converged,
        }
        for result in results
    ]
    table = pd.DataFrame(rows).sort_values(["zero_total_momentum", "sigma"], ignore_index=True)
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    free, zero = table[~table.zero_total_momentum], table[table.zero_total_momentum]
    curves = [
        (free, "alpha", "random total momentum, as in the paper", "o", style.BLUE, style.BLUE),
        (free, "alpha_relative", "the same minus the centre of mass", "^", style.SKY, "white"),
        (zero, "alpha", "zero total momentum", "s", style.VERMILLION, "white"),
    ]
    for part, name, label, marker, color, face in curves:
        look = {"marker": marker, "color": color, "markerfacecolor": face, **style.POINTS}
        axes.errorbar(part.sigma, part[name], part[f"{name}_error"], label=label, **look)
    style.cross_out(axes, table.sigma, table.alpha, table.converged == NOT_REACHED)
    for value in (1, 2):
        axes.axhline(value, **style.GUIDE)
    axes.set(xlabel=r"mass ratio $\sigma$", ylabel=r"exponent $\alpha$", xlim=(-1, 1), ylim=(0.8, 2.6))
    axes.legend(loc="upper left")
    return figure, table


if __name__ == "__main__":
    run(draw, "Exponent of the mean square displacement against the mass ratio")
