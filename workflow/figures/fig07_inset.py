"""Inset of fig. 7: exponent alpha of the spreading against sigma, with the paper's random total momentum and with none."""

from collections.abc import Sequence

import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, GAS, format_number, parameters
from workflow.lib.figure import Parts, main, plots
from workflow.lib.fit import format_with_error
from workflow.lib.load import NOT_REACHED, Result

TICKS = (-1, -0.5, 0, 0.5, 1)

# By zero total momentum: label, marker, colour, fill colour.
CURVES = {
    False: ("random total momentum, as in the paper", "o", style.BLUE, style.BLUE),
    True: ("zero total momentum", "s", style.VERMILLION, "white"),
}


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run."""
    rows = [
        {
            "sigma": float(result.parameters["sigma"]),
            "zero_total_momentum": bool(result.parameters["zero-total-momentum"]),
            **result.columns("alpha"),
            "converged": result.converged,
        }
        for result in results
    ]
    return pd.DataFrame(rows).sort_values(["zero_total_momentum", "sigma"], ignore_index=True)


def draw_curve(axes: Axes, table: pd.DataFrame, zero: bool) -> None:
    label, marker, color, face = CURVES[zero]
    part = table[table.zero_total_momentum == zero]
    axes.errorbar(part.sigma, part.alpha, part.alpha_error, **style.points(marker, color, face, label=label))


def caption(table: pd.DataFrame, results: Sequence[Result]) -> str:
    generic = table[table.sigma != 0].sort_values("alpha")  # at σ = 0 momenta are only exchanged
    least = format_with_error(*generic[~generic.zero_total_momentum][["alpha", "alpha_error"]].iloc[0])
    most = format_with_error(*generic[generic.zero_total_momentum][["alpha", "alpha_error"]].iloc[-1])
    options = results[0].parameters
    first = options["observation-time"] / 10 ** options["fit-decades"]
    return f"""
        Exponent α of the spreading of tagged particles, closed chains, {parameters(results, "cells", "gamma", *GAS)}, fitted from t =
        {format_number(first)} on. (a) With random total momentum, as in the paper, and with none; dashed: ballistic, diffusive. (b) The latter
        enlarged. For σ ≠ 0, α is at least {least} with and at most {most} without total momentum. {ERRORS}"""


@plots("all zero-momentum")
def draw(results: Sequence[Result]) -> Parts:
    table = tabulate(results)
    figure, (above, below) = style.stacked(2, 1, height=1.6)
    for zero in CURVES:
        draw_curve(above, table, zero)
    draw_curve(below, table, True)
    style.cross_out(above, table.sigma, table.alpha, table.converged == NOT_REACHED)
    for axes, value in ((above, 1), (above, 2), (below, 1)):
        axes.axhline(value, **style.GUIDE)
    above.set(ylabel=r"exponent $\alpha$", xlim=(-1, 1), ylim=(0.8, 2.2))
    below.set(xlabel=r"mass ratio $\sigma$", ylabel=r"$\alpha$ without drift")
    below.set_xticks(TICKS, [format_number(sigma) for sigma in TICKS])
    figure.legend(*above.get_legend_handles_labels(), loc="outside upper left")
    return figure, table, caption(table, results)


if __name__ == "__main__":
    main(draw, "Exponent of the mean square displacement against the mass ratio")
