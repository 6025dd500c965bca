"""The picture of the verdicts: from judgements of known truth to the plotted positions and the table."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from scipy.stats import t as student

from tests.python.conftest import ROOT, planned
from tests.python.test_release import results_of_release
from workflow.lib import style
from workflow.study import typeset, verdicts
from workflow.study.judge import Judgement, judge_all, read_claims
from workflow.study.report import numbers_file
from workflow.study.results import Results
from workflow.study.verdict import Band, Estimate, Verdict

LEVEL = 0.01
HALF = student.isf(LEVEL / 2, 9)  # half of an interval over its standard error
INF, NAN = math.inf, math.nan


def number(value: float, error: float, systematic: float = 0.0) -> Estimate:
    return Estimate(f"value {value:g}", value, error, 9, systematic)


# Acceptance band, number, verdict; position and half of the interval on the scale of the band.
CLAIMS: dict[str, tuple[Band, Estimate, str, float, float]] = {
    "inside": (Band(2, 4), number(3.5, 0.1, 0.05), "reproduced", 0.5, HALF * 0.1 + 0.05),
    "far below": (Band(0, 1), number(-7, 0.1), "contradicted", -15, HALF * 0.2),
    "far above": (Band(0, 1), number(9, 0.1), "contradicted", 17, HALF * 0.2),
    "just above": (Band(0, 1), number(1.5, 0.1), "contradicted", 2, HALF * 0.2),
    "straddling": (Band(0, 1), number(1.0, 0.1), "undecided", 1, HALF * 0.2),
    "above": (Band(0.5, INF), number(0.9, 0.01), "reproduced", 40 / HALF - 1, 1),
    "not above": (Band(0.5, INF), number(0.1, 0.01), "contradicted", -40 / HALF - 1, 1),
    "below": (Band(-INF, -0.5), number(-0.7, 0.01), "reproduced", -20 / HALF + 1, 1),
    "at the edge": (Band(-INF, 0), number(0, 0.1), "undecided", 1, 1),
    "unbounded": (Band(0, 1), number(0.5, 0.1, INF), "undecided", 0, INF),
    "unknown": (Band(0, 1), number(NAN, NAN), "undecided", NAN, NAN),
}


def row(claim: str, kind: str = "as printed") -> dict[str, str]:
    return {"number": claim, "kind": kind, "panel": "fig01", "statement": claim, "short": ""}


JUDGED = [Judgement(row(name), Verdict(band, (one,), LEVEL)) for name, (band, one, *_) in CLAIMS.items()]
MISSING = Judgement(row("missing", "as meant"), Verdict(Band(0, 1), (), LEVEL), "no run")


@pytest.fixture(autouse=True)
def close() -> Iterator[None]:
    yield
    plt.close("all")


def plotted(table: pd.DataFrame) -> tuple[Axes, dict[int, list[Any]]]:
    """The axes, and by row the lines in units of the scale: intervals of two points and symbols."""
    figure, _, _ = verdicts.plotted(table)
    (axes,) = figure.axes
    by_row: dict[int, list[Any]] = {}
    for line in axes.get_lines():
        y = line.get_ydata()
        if line.get_transform() == axes.transData and y[0] == round(y[0]):
            by_row.setdefault(int(y[0]), []).append(line)
    return axes, by_row


def test_table_and_picture_have_the_numbers() -> None:
    table = verdicts.tabulate([*JUDGED, MISSING])
    axes, lines = plotted(table)
    assert [*table.verdict] == [verdict for _, _, verdict, *_ in CLAIMS.values()] + ["undecided"]
    for y, (band, one, verdict, position, half) in enumerate(CLAIMS.values()):
        interval = {"position": position, "position_low": position - half, "position_high": position + half}
        numbers = {"value": one.value, "error": one.error, "systematic": one.systematic}
        known = interval | numbers | {"band_low": band.low, "band_high": band.high}
        found = table.loc[y, [*known]].astype(float)
        np.testing.assert_allclose(found, [*known.values()], rtol=1e-9, atol=1e-12)
        *bar, symbol = lines[y]
        low, high = (
            edge if math.isnan(end) else min(max(end, -3.3), 3.3)
            for end, edge in ((position - half, -3.3), (position + half, 3.3))
        )
        if low < high:
            np.testing.assert_allclose(bar[0].get_xdata(), [low, high], rtol=1e-9, atol=1e-12)
        else:
            assert not bar  # beyond the frame: the arrow alone
        np.testing.assert_allclose(symbol.get_xdata(), [np.clip(position, -3, 3)])  # NaN is not plotted
        look = {"reproduced": ("o", style.BLUE), "contradicted": ("X", style.VERMILLION)}
        marker, color = look.get(verdict, ("D", style.BLACK))
        marker = "<" if position < -3 else ">" if position > 3 else marker
        assert symbol.get_marker() == marker
        assert to_hex(symbol.get_color()) == to_hex(color) == to_hex(symbol.get_markerfacecolor())
    assert len(table) - 1 not in lines
    assert [text.get_text() for text in axes.texts].count("not measured") == 1


def test_bands_with_one_edge_are_open() -> None:
    """Rectangles from the edge of the strip to that of the frame. Detected mistake: open to the other
    side."""
    table = verdicts.tabulate(JUDGED)
    axes, _ = plotted(table)
    strip, *found = (
        (*sorted((one.get_x(), one.get_x() + one.get_width())), one.get_y() + 0.5) for one in axes.patches
    )
    assert strip[:2] == (-1, 1)
    names = [*CLAIMS]
    right, left = (
        [names.index(one) for one in ("above", "not above")],
        [names.index(one) for one in ("below", "at the edge")],
    )
    assert found == [(1, 3.3, y) for y in right] + [(-3.3, -1, y) for y in left]


def test_the_band_of_nearly_reproduced_statements_is_wider_and_those_as_meant_are_hollow() -> None:
    """Three times as wide as the acceptance band, about its centre."""
    near = Judgement(row("near", "as meant"), Verdict(Band(0, 1), (number(1.6, 0.01),), LEVEL, Band(-1, 2)))
    axes, lines = plotted(verdicts.tabulate([near]))
    _, wide = axes.patches
    assert (wide.get_x(), wide.get_width()) == (-3, 6)
    assert (lines[0][-1].get_marker(), lines[0][-1].get_markerfacecolor()) == ("s", "white")


def test_statements_are_typeset() -> None:
    for claim in read_claims(ROOT):
        text = typeset.mathtext(claim["short"] or claim["statement"])
        assert "^" not in text.replace("$^{", "")
        assert "_" not in text.replace("$_{", "")


def test_the_panel_has_the_results_of_all_claims() -> None:
    """Results of the panels in `uses` give the numbers of all. Detected mistakes: `uses` misses a panel, so
    that its claims are not measured; series of the user count."""
    uses = {run.panel for run in planned("paper")["verdicts"].plotted}
    every = results_of_release()
    results = [result for result in every if result.path.parent.name in uses]
    mine = [replace(one, path=one.path.with_name(f"mine_{one.path.name}")) for one in results]
    assert numbers_file(judge_all(Results([*mine, *results]))) == numbers_file(judge_all(Results(every)))
