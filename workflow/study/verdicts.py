"""The verdicts on all statements: of every row of workflow/study/claims.csv the number that decides, with its
interval, on a scale on which the acceptance band is -1 to 1.

A band with one edge has no width: the unit is then half the interval.
"""

import math
from collections.abc import Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from workflow.lib import style
from workflow.lib.figure import Parts
from workflow.lib.load import Result
from workflow.study.judge import MEANT, PRINTED, Judgement, judge_all, label
from workflow.study.results import Results
from workflow.study.typeset import figure_of, mathtext
from workflow.study.verdict import Band, Outcome

TITLE = "Verdicts on the statements of the paper"
LABELLED = True  # rows have the panels
UNITS = dict.fromkeys(("value", "error", "systematic", "low", "high"), "1")
UNITS |= dict.fromkeys(("band_low", "band_high", "nearly_low", "nearly_high"), "1")
UNITS |= dict.fromkeys(("position", "position_low", "position_high"), "1")

EDGE = 3  # positions beyond it are arrows there
LIMIT = 3.3  # of the frame
ROW = 0.16  # inches
NEARLY: style.Look = {"color": "#d9ecf8", "zorder": -2}
NOT_MEASURED = "not measured"
CAPTION = """Bars: joint 95 % confidence intervals of the deciding numbers. Grey: acceptance band; light blue:
    nearly. Unit: half the band, or half the bar if the band has one edge, so that positions compare within a
    row only. Hollow: as meant. Triangles and cut bars: off the scale."""
LOOKS = {
    Outcome.REPRODUCED: ("o", style.BLUE),
    Outcome.NEARLY: ("s", style.SKY),
    Outcome.CONTRADICTED: ("X", style.VERMILLION),
    Outcome.UNDECIDED: ("D", style.BLACK),
}


def scale_of(band: Band, value: float, half: float) -> tuple[float, float]:
    """Origin and unit of the scale. half: half the width of the interval, the unit of a band with one edge;
    if it is 0 or unknown, the distance from the edge is."""
    if math.isfinite(band.low) and math.isfinite(band.high):
        return (band.low + band.high) / 2, (band.high - band.low) / 2
    edge, side = (band.low, -1) if math.isfinite(band.low) else (band.high, 1)
    unit = next((one for one in (half, abs(value - edge)) if math.isfinite(one) and one > 0), 1.0)
    return edge - side * unit, unit


def tabulate(judgements: Sequence[Judgement]) -> pd.DataFrame:
    """One row per statement; low, high: ends of the interval."""
    rows = []
    for row, verdict in ((one.row, one.verdict) for one in judgements):
        number, band = verdict.decisive if verdict.numbers else None, verdict.band
        names = ("value", "error", "systematic")
        value, error, systematic = (getattr(number, name) if number else math.nan for name in names)
        ends = number.interval(verdict.level / len(verdict.numbers)) if number else (math.nan, math.nan)
        origin, unit = scale_of(band, value, (ends[1] - ends[0]) / 2)
        position, low, high = ((one - origin) / unit for one in (value, *ends))
        columns: dict[str, Any] = {"claim": row["number"], "kind": row["kind"], "panel": row["panel"]}
        columns |= {"statement": label(row), "verdict": verdict.outcome.value}
        columns |= {"quantity": number.label or "value" if number else NOT_MEASURED, "value": value}
        columns |= {"error": error, "systematic": systematic, "low": ends[0], "high": ends[1]}
        for name, edges in (("band", band), ("nearly", verdict.nearly)):
            columns |= {f"{name}_{end}": getattr(edges, end, math.nan) for end in ("low", "high")}
        columns |= {"position": position, "position_low": low, "position_high": high}
        rows.append(columns)
    return pd.DataFrame(rows)


def look_of(verdict: str, kind: str) -> style.Look:
    marker, color = LOOKS[Outcome(verdict)]
    face = color if kind == PRINTED else "white"
    look: style.Look = {
        "marker": marker,
        "color": color,
        "markerfacecolor": face,
        "markersize": 4.5 if marker == "X" else 3.5,
    }
    return look | {"linestyle": "none", "markeredgewidth": 0.8}


def draw_row(axes: Axes, y: int, row: pd.Series) -> None:
    """Plots the interval as far as it is in the frame, and the number, beyond EDGE as an arrow. Intervals
    that are unknown cross the frame."""
    look = look_of(row.verdict, row.kind)
    open_ends = {-LIMIT: math.isinf(row.band_low), LIMIT: math.isinf(row.band_high)}
    for end in (end for end, is_open in open_ends.items() if is_open):
        axes.barh(y, end - math.copysign(1, end), left=math.copysign(1, end), height=1, **style.WINDOW)
    if math.isfinite(row.nearly_low):
        width = (row.nearly_high - row.nearly_low) / (row.band_high - row.band_low)
        axes.barh(y, 2 * min(width, LIMIT), left=-min(width, LIMIT), height=1, **style.WINDOW | NEARLY)
    if row.quantity == NOT_MEASURED:
        axes.text(0, y, NOT_MEASURED, size=7, ha="center", va="center", color="0.45")
        return
    low, high = (
        default if math.isnan(end) else np.clip(end, -LIMIT, LIMIT)
        for end, default in ((row.position_low, -LIMIT), (row.position_high, LIMIT))
    )
    if low < high:
        axes.plot([low, high], [y, y], color=look["color"], linewidth=1.2, solid_capstyle="butt")
    if abs(row.position) > EDGE:
        look["marker"] = ">" if row.position > 0 else "<"
    axes.plot([np.clip(row.position, -EDGE, EDGE)], [y], **look)  # NaN is not plotted


def label_rows(axes: Axes, table: pd.DataFrame) -> None:
    """Statements at the left of the frame, those as meant in italics, with their numbers and figures."""
    frame = axes.get_yaxis_transform()
    across: style.Look = {"transform": frame, "va": "center", "size": 7.5, "clip_on": False}
    line: style.Look = {"transform": frame, "color": "0.8", "linewidth": 0.5, "clip_on": False}
    former = ""
    for y, row in table.iterrows():
        group = figure_of(row.panel)
        if group != former:
            axes.text(-1.58, y, group, weight="bold", **across)
            axes.plot([-1.58, 1.06], [y - 0.5] * 2, **line)
        former, text = group, mathtext(row.statement)
        axes.text(-1.42, y, row.claim, color="0.45", **across)
        if row.kind == PRINTED:
            axes.text(-1.25, y, text, **across)
        else:
            axes.text(-1.25, y, f"{row.kind}: {text}", style="italic", **across)


def draw(results: Sequence[Result]) -> Parts:
    return plotted(tabulate(judge_all(Results(results))))


def plotted(table: pd.DataFrame) -> Parts:
    height = ROW * len(table) + 0.72
    figure = plt.figure(figsize=(2 * style.COLUMN, height), layout="none")
    axes = figure.add_axes((0.602, 0.42 / height, 0.375, ROW * len(table) / height))
    axes.axvspan(-1, 1, **style.WINDOW)
    for y, row in table.iterrows():
        draw_row(axes, y, row)
    label_rows(axes, table)
    axes.set(xlim=(-LIMIT, LIMIT), ylim=(len(table) - 0.5, -0.5), yticks=[])
    axes.set_xlabel("number, scaled so that it is accepted in the grey band", size=8)
    axes.set_xticks(range(-EDGE, EDGE + 1), [f"{tick}".replace("-", "−") for tick in range(-EDGE, EDGE + 1)])
    looks = [look_of(outcome.value, PRINTED) | {"label": outcome.value} for outcome in Outcome]
    looks.append(look_of(Outcome.REPRODUCED, MEANT) | {"label": f"hollow: {MEANT}"})
    handles = [Line2D([], [], **one) for one in looks]
    figure.legend(handles=handles, loc="upper center", ncols=5, borderpad=0.2, columnspacing=1)
    return figure, table, CAPTION
