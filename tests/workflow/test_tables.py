"""The tables of the figures: every column scales with the results according to its units."""

import importlib
import json
import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd
import pytest

from tests.python.known_results import plan
from tests.python.scale import ROUNDING, SCALES, agree
from workflow.lib import style
from workflow.lib.columns import BY_ROW, UNITS_LINE, as_csv
from workflow.lib.load import NOT_REACHED, load
from workflow.lib.units import UnitsError
from workflow.plan import data_of

PLAN = {name: panel for name, panel in plan("smoke").items() if panel.runs or panel.uses}


def stated(folder: Path, panel: str) -> tuple[dict[str, str], str]:
    """Units and caption in the head of a table."""
    _, units, caption, _ = (folder / f"figures/smoke/{panel}.csv").read_text().split("\n", maxsplit=3)
    assert units.startswith(UNITS_LINE)
    return json.loads(units.removeprefix(UNITS_LINE)), caption.removeprefix("# caption: ")


@cache
def tables(folder: Path, panel: str) -> tuple[pd.DataFrame, ...]:
    """Tables from the results in the default units, then in others. All runs missed their targets, which no panel and no caption may need."""
    draw = importlib.import_module(f"workflow.figures.{PLAN[panel].script}").draw
    given = [load(folder / path) for path in data_of(PLAN, panel, "smoke")]
    missed = [replace(result, provenance=result.provenance | {"converged": NOT_REACHED}) for result in given]
    style.apply()
    drawn = []
    for results in (missed, *([scale.result(result) for result in missed] for scale in SCALES)):
        _, table, caption = draw(results)
        assert len(table)
        assert "nan" not in caption.split()
        drawn.append(table)
    plt.close("all")
    return tuple(drawn)


OPTION_AS_GIVEN = "spacing"  # a label: 1/N, or a length as it is configured


def scales(folder: Path, panel: str, name: str, text: str) -> bool:
    """Whether a column scales according to these units."""
    plain, *in_other_units = tables(folder, panel)
    by_row = text.startswith(BY_ROW)
    for scale, scaled in zip(SCALES, in_other_units, strict=True):
        factor = plain[text.removeprefix(BY_ROW)].map(scale).to_numpy() if by_row else scale(text)
        values, converted = (table[name].to_numpy(dtype=float) for table in (plain, scaled))
        if not agree(values, converted / factor, 1, ROUNDING):
            return False
    return True


@pytest.mark.parametrize("panel", PLAN)
def test_every_column_scales_as_its_units(smoke: Path, panel: str) -> None:
    plain, *in_other_units = tables(smoke, panel)
    units, _ = stated(smoke, panel)
    for converted in in_other_units:
        labels = [name for name in plain if name not in units and name != OPTION_AS_GIVEN]
        pd.testing.assert_frame_equal(plain[labels], converted[labels])
    for name, text in units.items():
        assert scales(smoke, panel, name, text), name
        mutant = "energy" if text in ("1", "second") else "1"
        seen = plain[name].abs().max() > 0
        assert scales(smoke, panel, name, mutant) != seen, name


@pytest.mark.parametrize("panel", PLAN)
def test_every_panel_has_a_caption(smoke: Path, panel: str) -> None:
    _, caption = stated(smoke, panel)
    assert len(caption) >= 200
    assert len(caption.split()) <= 70
    assert caption == " ".join(caption.split())


def test_columns_without_units_are_refused() -> None:
    table = pd.DataFrame({"sigma": [0.5, 1], "label": ["a", 1], "sound": [True, False], "time": [1, 2]})
    with pytest.raises(UnitsError, match="the columns sigma, time have no units"):
        as_csv(table, {})
    spaced = pd.DataFrame({"my column": [1.0]})
    with pytest.raises(UnitsError, match=re.escape('run(draw, title, **{"my column": "1"})')):
        as_csv(spaced, {})
    with pytest.raises(UnitsError, match="'second/furlong'"):
        as_csv(table, {"sigma": "1", "time": "second/furlong"})
    partly = pd.concat([table, table[["sigma", "time"]]])  # truth values are missing in its last rows
    assert as_csv(partly, {"sigma": "1", "time": "time"}).startswith(
        '# units: {"sigma": "1", "time": "time"}'
    )
    text = as_csv(table, {"sigma": "1", "time": "time", "absent": "1"})
    assert text.splitlines()[0] == '# units: {"sigma": "1", "time": "time"}'
    with pytest.raises(UnitsError, match="'a' in 'a'"):
        as_csv(table.iloc[:1], {"sigma": "1", "time": "column label"})
