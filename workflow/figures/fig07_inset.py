"""Inset of fig. 7: exponent alpha of the spreading against sigma, with random total momentum,
with none, and with random directions, of the paper's footnote."""

from collections.abc import Sequence

import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.figure import Parts, plots
from workflow.lib.load import Result
from workflow.lib.text import format_number, format_with_error
from workflow.physics.setting import rule

TITLE = "Exponent of the mean square displacement against the mass ratio"

TICKS = (-1, -0.5, 0, 0.5, 1)

PAPERS, ZERO = "random total momentum", "zero total momentum"
RANDOM = "random directions"
LOOKS = {
    PAPERS: style.points("o", style.BLUE),
    ZERO: style.points("s", style.VERMILLION, "white"),
    RANDOM: style.points("D", style.GREEN),
}


def kind(result: Result) -> str:
    if result.parameters["rule"] == "elastic":
        return ZERO if result.parameters["zero_total_momentum"] else PAPERS
    return RANDOM if result.parameters["rule"] == "random-direction" else rule(result)


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run."""
    rows = [
        {
            "sigma": float(result.parameters["sigma"]),
            "kind": kind(result),
            "relaxation_time": float(result.parameters["relaxation_time"]),
            **result.columns("alpha"),
            "usable": result.usable,
        }
        for result in results
    ]
    return pd.DataFrame(rows).sort_values(["kind", "sigma", "relaxation_time"], ignore_index=True)


def draw_curve(axes: Axes, part: pd.DataFrame, name: str) -> None:
    """Plots a kind. Of several relaxation times all but the longest have open symbols."""
    look = LOOKS.get(name, style.points("P", style.BLACK, "white"))
    for time, points in part.groupby("relaxation_time"):
        own = {"label": f"{name}, $t_r = {format_number(time)}$"}
        if time < part.relaxation_time.max():
            own["markerfacecolor"] = "white"
        axes.errorbar(points.sigma, points.alpha, points.alpha_error, **look | own)


def extreme(part: pd.DataFrame, row: int) -> str | None:
    """The smallest (row 0) or the largest (row -1) exponent for σ ≠ 0; at σ = 0 momenta are only
    exchanged. None if there is none."""
    known = part[(part.sigma != 0) & part.alpha.notna()].sort_values("alpha")
    return format_with_error(*known[["alpha", "alpha_error"]].iloc[row]) if len(known) else None


def caption(table: pd.DataFrame) -> str:
    least, most = (extreme(table[table.kind == kind], row) for kind, row in ((PAPERS, 0), (ZERO, -1)))
    text = """The paper finds ⟨x²⟩ ∼ t^α with 1 < α < 2 for σ ≠ 0. For σ ≠ 0 α is at least {least} at
        random total momentum (a), and at most {most} at zero total momentum, without drift of the
        ring (b). Diamonds: random directions, as in the paper's footnote; t_r: relaxation
        time."""
    return fill(text, least=least, most=most)


@plots("all zero-momentum random")
def draw(results: Sequence[Result]) -> Parts:
    table = tabulate(results)
    figure, (above, below) = style.stacked(2, 1, height=1.6)
    for name in dict.fromkeys([*LOOKS, *table.kind]):
        for axes in (above, below) if name != PAPERS else (above,):
            draw_curve(axes, table[table.kind == name], name)
    style.cross_out(above, table.sigma, table.alpha, ~table.usable)
    for axes, value in ((above, 1), (above, 2), (below, 1)):
        axes.axhline(value, **style.GUIDE)
    above.set(ylabel=r"exponent $\alpha$", xlim=(-1, 1))
    below.set(xlabel=r"mass ratio $\sigma$", ylabel=r"$\alpha$ without drift")
    below.set_xticks(TICKS)
    figure.legend(*above.get_legend_handles_labels(), loc="outside upper left")
    return figure, table, caption(table)
