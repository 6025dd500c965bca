"""Every panel of the release, drawn from its results in data/paper, has the recorded caption, table,
lines, error bars and bands.

What was wrong when it was recorded stays: a new table needs a test with numbers calculated by hand. The
results are read by name, whatever sources and configuration are now. After an intended change of a figure
`.venv/bin/python -m tests.python.test_release` records what is drawn now.
"""

import io
import json
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from numpy.typing import ArrayLike

from tests.python.conftest import ROOT
from workflow.lib.identity import sha256
from workflow.lib.load import FormatError, Result, load
from workflow.pipeline.plan import Plan
from workflow.render.__main__ import draw

RECORD = Path(__file__).with_name("release.json")
Fingerprint = str | list[float]
Panel = dict[str, Any]  # caption, and fingerprints of lines, of error bars and of every column


@cache
def stored(path: Path) -> Result:
    return load(path)


def results_of_release() -> list[Result]:
    """All of them, for other tests."""
    try:
        return [stored(path) for path in sorted((ROOT / "data/paper").glob("*/*.h5"))]
    except FormatError:
        pytest.skip("data/paper has another format, which tests/python/test_release.py reports")


def result(run: str) -> Result:
    """The result of the release of a run, PANEL/RUN."""
    panel, _, name = run.partition("/")
    (path,) = (
        one for one in (ROOT / "data/paper" / panel).glob("*.h5") if one.name.rsplit(".", 2)[0] == name
    )
    return stored(path)


def fingerprint(values: ArrayLike) -> Fingerprint:
    """Hash of texts; of numbers their count, and weighted sums of their signs and logarithms, which a
    relative change of one number changes by as much. What is 0 to rounding differs between processors."""
    cells = np.asarray(values)
    if cells.dtype.kind != "f":
        return sha256("\n".join(map(str, cells)).encode())[:8]
    negligible = np.abs(cells) < 1e-11 * np.nanmax(np.abs(cells), initial=0)
    defined = np.isfinite(cells) & (cells != 0) & ~negligible
    weights = np.random.default_rng(1).uniform(1, 2, cells.size)[defined]
    sums = weights @ np.sign(cells[defined]), weights @ np.log(np.abs(cells[defined]))
    return [cells.size, int(defined.sum()), *(round(float(each), 8) for each in sums)]


def points(curves: Iterable[np.ndarray]) -> list[Fingerprint]:
    """Of the coordinates x and y of all curves of a frame, for which 0 to rounding is relative to the
    largest."""
    both = np.concatenate([np.empty((0, 2)), *curves])
    return [fingerprint(coordinate) for coordinate in both.T]


def agree(now: Any, recorded: Any) -> bool:
    """Equal texts, or sums that differ by less than a relative change of 1e-6 of one number."""
    if isinstance(now, list) and isinstance(recorded, list) and len(now) == len(recorded):
        return all(map(agree, now, recorded))
    return now == recorded or (isinstance(now, float) and abs(now - recorded) < 1e-6)


def drawn(script: str, runs: list[str]) -> Panel:
    figure, text, words = draw(script, [result(run) for run in runs])
    plt.close(figure)
    table = pd.read_csv(io.StringIO(text), comment="#")
    lines = [points(line.get_xydata() for line in axes.get_lines()) for axes in figure.axes]
    bars = [
        points(path.vertices for one in axes.collections for path in one.get_paths()) for axes in figure.axes
    ]
    return {
        "caption": str(words),
        "lines": lines,
        "error bars and bands": bars,
        **{name: fingerprint(cells) for name, cells in table.items()},
    }


def test_every_panel_of_the_release_is_as_recorded() -> None:
    """Without the panels of the study if there is none. Detected mistake: a line of a script, of `lib` or
    of `physics` changes a number or a caption."""
    found, recorded = {}, json.loads(RECORD.read_text())
    for panel, (script, runs, expected) in recorded.items():
        if (ROOT / script).exists():
            now = drawn(script, runs)
            names = now.keys() | expected.keys()
            changed = {name for name in names if not agree(now.get(name), expected.get(name))}
            found |= {f"{panel}: {name}": now.get(name) for name in changed}
    assert found == {}, "after an intended change: .venv/bin/python -m tests.python.test_release"


def record() -> None:
    panels = {}
    for panel in Plan("paper").reported:
        runs = [f"{run.panel}/{run.name}" for run in panel.plotted]
        panels[panel.name] = panel.script, runs, drawn(panel.script, runs)
    RECORD.write_text(json.dumps(panels, indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    record()
