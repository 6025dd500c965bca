"""Inset of fig. 7: exponent alpha of the spreading against sigma, with and without the common drift."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure

from workflow.scripts import style
from workflow.scripts.figure import run
from workflow.scripts.load import NOT_REACHED, Result


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    rows = [
        {
            "sigma": float(result.parameters["sigma"]),
            "alpha": float(result["alpha"].mean),
            "alpha_error": float(result["alpha"].standard_error),
            "alpha_relative": float(result["alpha_relative"].mean),
            "alpha_relative_error": float(result["alpha_relative"].standard_error),
            "converged": result.converged,
        }
        for result in results
    ]
    table = pd.DataFrame(rows).sort_values("sigma", ignore_index=True)
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    raw = {"marker": "o", "color": style.BLUE, "label": r"$\langle x^2\rangle$, as in the paper"}
    relative = {"marker": "s", "color": style.VERMILLION, "markerfacecolor": "white"}
    axes.errorbar(table.sigma, table.alpha, table.alpha_error, **raw, **style.POINTS)
    axes.errorbar(
        table.sigma,
        table.alpha_relative,
        table.alpha_relative_error,
        label="without the centre of mass",
        **relative,
        **style.POINTS,
    )
    style.cross_out(axes, table.sigma, table.alpha, table.converged == NOT_REACHED)
    for value in (1, 2):
        axes.axhline(value, **style.GUIDE)
    axes.set(xlabel=r"mass ratio $\sigma$", ylabel=r"exponent $\alpha$", xlim=(-1, 1), ylim=(0.8, 2.35))
    axes.legend(loc="upper left")
    return figure, table


if __name__ == "__main__":
    run(draw, "Exponent of the mean square displacement against the mass ratio")
