"""The summary in one picture: every claim with what it admits, what was measured and the verdict."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.claims.verdict import Outcome
from workflow.lib import style
from workflow.report import words
from workflow.report.strip import WIDTH, Strip

LINE, TOP, BOTTOM = 0.21, 0.32, 0.3  # inches
KEY = (
    "Each line has its own scale. Grey: what the claim admits. Points with intervals: the numbers that were measured, at the level of "
    "the verdict;\nthe number written is the least certain of them, and `make report` says which it is."
)
COLUMNS = {"quantity": 0.045, "paper": 0.315, "strip": 0.6, "short": 0.72, "verdict": 0.885}  # left ends
COLORS = {
    Outcome.REPRODUCED: style.BLUE,
    Outcome.IN_SUBSTANCE: "#2A7FA5",
    Outcome.CONTRADICTED: style.VERMILLION,
    Outcome.UNDECIDED: "0.45",
    Outcome.NOT_TESTABLE: "0.45",
}


def draw_strip(axes: Axes, strip: Strip, height: float) -> None:
    """The band that the claim admits, and the numbers with their intervals."""
    low, high = strip.band
    axes.fill_between([low, high], height - 0.36, height + 0.36, color="0.86", linewidth=0)
    for first, value, last in strip.points:
        axes.plot([first, last], [height, height], color=style.BLACK, linewidth=0.8)
        axes.plot(value, height, "o", color=style.BLACK, markersize=2.2)


def typeset(text: str) -> str:
    """Powers after ^, indices after _, and minus signs, as matplotlib sets them."""
    text = re.sub(r"\^(?:\(([^)]*)\)|(-?\w+))", lambda found: f"$^{{{found[1] or found[2]}}}$", text)
    text = re.sub(r"_(\w+)", r"$_{\\mathrm{\1}}$", text)
    return re.sub(r"(?<![\w)])-(?=\d)|(?<=\s)-(?=\s)", words.MINUS, text)


def draw(claims: Sequence[Mapping[str, Any]]) -> Figure:
    """claims: as content.claim() gives them."""
    figure = plt.figure(figsize=(2.6 * style.COLUMN, TOP + LINE * len(claims) + BOTTOM), layout="none")
    rows = len(claims)
    share = TOP / figure.get_figheight()
    foot = BOTTOM / figure.get_figheight()
    text = figure.add_axes((0, foot, 1, 1 - share - foot))
    strips = figure.add_axes((COLUMNS["strip"], foot, 0.115, 1 - share - foot))
    figure.text(0.01, 0.15 * foot, KEY, size=7)
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
        text.text(0.01, row, claim["id"], size=7.5, va="center", color="0.35")
        for name in ("quantity", "paper", "short"):
            text.text(COLUMNS[name], row, typeset(claim[name]), size=7.5, va="center")
        text.text(COLUMNS["verdict"], row, outcome.name.replace("_", " ").lower(), size=7.5, va="center",
                  color=COLORS[outcome], weight="bold")  # fmt: skip
        if claim["strip"]:
            draw_strip(strips, claim["strip"], row)
    return figure
