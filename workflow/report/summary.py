"""The summary in one picture: every claim with its acceptance band, the measured values and the verdict."""

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.claims.verdict import Outcome
from workflow.lib import style
from workflow.report import words
from workflow.report.strip import WIDTH, Strip

LINE, TOP, BOTTOM = 0.31, 0.32, 0.42  # inches
UP, DOWN, HALF = 0.2, 0.26, 0.24  # of the two lines of a row, and half the height of a band
KEY = (
    "Runs of the quality {quality}. Each row has its own scale. Grey: acceptance band. Points: measured values, with "
    "intervals in which they lie\nwith 95 % for all claims together, systematic errors included; orange diamonds: intervals wholly outside "
    "the grey. The number shown decides the verdict,\nwith its name and acceptance band; of claims reproduced in meaning, the number that "
    "decides the literal statement, which is not confirmed."
)
COLUMNS = {"quantity": 0.045, "paper": 0.315, "strip": 0.6, "short": 0.72, "verdict": 0.885}  # left ends
# Characters that the font lacks.
RAISED = {ord(one): f"$^{number}$" for number, one in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")}
LOWERED = {ord(one): f"$_{number}$" for number, one in enumerate("₀₁₂₃₄₅₆₇₈₉")}
COLORS = {
    Outcome.REPRODUCED: style.BLUE,
    Outcome.IN_MEANING: "#2A7FA5",
    Outcome.CONTRADICTED: style.VERMILLION,
    Outcome.UNDECIDED: "0.45",
    Outcome.NOT_TESTABLE: "0.45",
}


def draw_strip(axes: Axes, strip: Strip, height: float) -> None:
    """The acceptance band, and the numbers with their intervals."""
    low, high = strip.band
    axes.fill_between([low, high], height - HALF, height + HALF, color="0.86", linewidth=0)
    for first, value, last, outside in strip.points:
        color = style.VERMILLION if outside else style.BLACK
        axes.plot([first, last], [height, height], color=color, linewidth=0.8, zorder=2 + outside)
        axes.plot(value, height, "D" if outside else "o", color=color, markersize=2.2, zorder=2 + outside)


def typeset(text: str) -> str:
    """As matplotlib sets it, with what the font lacks."""
    set_so = words.set_mathematics(text, "$^{{{}}}$", r"$_{{\mathrm{{{}}}}}$")
    return set_so.translate(RAISED | LOWERED)


def draw(claims: Sequence[Mapping[str, Any]], quality: str) -> Figure:
    """claims: as content.claim() gives them."""
    figure = plt.figure(figsize=(2.6 * style.COLUMN, TOP + LINE * len(claims) + BOTTOM), layout="none")
    rows = len(claims)
    share = TOP / figure.get_figheight()
    foot = BOTTOM / figure.get_figheight()
    text = figure.add_axes((0, foot, 1, 1 - share - foot))
    strips = figure.add_axes((COLUMNS["strip"], foot, 0.115, 1 - share - foot))
    figure.text(0.01, 0.15 * foot, KEY.format(quality=quality), size=7)
    text.set(xlim=(0, 1), ylim=(-0.5, rows - 0.5))
    strips.set(xlim=(0, WIDTH), ylim=(-0.5, rows - 0.5))
    for axes in (text, strips):
        axes.axis("off")
        axes.invert_yaxis()
    for name, head in zip(
        COLUMNS, ("claim of the paper on", "paper", "measured", "", "verdict"), strict=True
    ):
        figure.text(COLUMNS[name], 1 - 0.6 * share, head, size=8, weight="bold")
    for row, claim in enumerate(claims):
        outcome = Outcome(claim["outcome"])
        if row % 2:
            text.axhspan(row - 0.5, row + 0.5, color="0.96", zorder=-1)
        text.text(0.01, row - UP, claim["id"], size=7.5, va="center", color="0.35")
        for name in ("quantity", "paper", "short"):
            text.text(COLUMNS[name], row - UP, typeset(claim[name]), size=7.5, va="center")
        if claim["label"]:
            told = typeset(f"{claim['label']}; acceptance band {claim['acceptance_band']}")
            text.text(COLUMNS["strip"], row + DOWN, told, size=6.5, va="center", color="0.35")
        text.text(COLUMNS["verdict"], row - UP, outcome.name.replace("_", " ").lower(), size=7.5, va="center",
                  color=COLORS[outcome], weight="bold")  # fmt: skip
        if claim["strip"]:
            draw_strip(strips, claim["strip"], row - UP)
    return figure
