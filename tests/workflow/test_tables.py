"""The tables of the figures: every column scales with the results according to its units."""

import importlib
import json
from dataclasses import replace
from functools import cache
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd
import pytest

from tests.python.known_results import plan
from tests.python.scale import OTHER, ROUNDING, agree
from workflow.lib import style
from workflow.lib.columns import BY_ROW, UNITS_LINE, as_csv
from workflow.lib.load import NOT_REACHED, load
from workflow.lib.units import UnitsError
from workflow.pipeline.plan import data_of

PLAN = {name: panel for name, panel in plan("smoke").items() if panel.runs or panel.uses}


def stated(folder: Path, panel: str) -> tuple[dict[str, str], str]:
    """Units and caption in the head of a table."""
    _, units, caption, _ = (folder / f"figures/smoke/{panel}.csv").read_text().split("\n", maxsplit=3)
    assert units.startswith(UNITS_LINE)
    return json.loads(units.removeprefix(UNITS_LINE)), caption.removeprefix("# caption: ")


@cache
def tables(folder: Path, panel: str) -> list[pd.DataFrame]:
    """Tables from the results in the default units and in other ones. All runs missed their targets, which no panel and no caption may need."""
    draw = importlib.import_module(f"workflow.figures.{PLAN[panel].script}").draw
    given = [load(folder / path) for path in data_of(PLAN, panel, "smoke")]
    missed = [replace(result, provenance=result.provenance | {"converged": NOT_REACHED}) for result in given]
    style.apply()
    drawn = []
    for results in (missed, [OTHER.result(result) for result in missed]):
        _, table, caption = draw(results)
        assert len(table)
        assert "nan" not in caption.split()
        drawn.append(table)
    plt.close("all")
    return drawn


OPTION_AS_GIVEN = "spacing"  # a label: 1/N, or a length as it is configured


def scales(folder: Path, panel: str, name: str, text: str) -> bool:
    """Whether a column scales according to these units."""
    plain, scaled = tables(folder, panel)
    by_row = text.startswith(BY_ROW)
    factor = plain[text.removeprefix(BY_ROW)].map(OTHER).to_numpy() if by_row else OTHER(text)
    values, converted = (table[name].to_numpy(dtype=float) for table in (plain, scaled))
    return agree(values, converted / factor, 1, ROUNDING)


@pytest.mark.parametrize("panel", PLAN)
def test_every_column_scales_as_its_units_and_every_panel_has_a_caption(smoke: Path, panel: str) -> None:
    plain, scaled = tables(smoke, panel)
    units, caption = stated(smoke, panel)
    assert len(caption) >= 200
    assert len(caption.split()) <= 70
    labels = [name for name in plain if name not in units and name != OPTION_AS_GIVEN]
    pd.testing.assert_frame_equal(plain[labels], scaled[labels])
    for name, text in units.items():
        assert scales(smoke, panel, name, text), name
        mutant = "energy" if text in ("1", "second") else "1"
        seen = plain[name].abs().max() > 0
        assert scales(smoke, panel, name, mutant) != seen, name


def test_columns_without_units_are_refused() -> None:
    table = pd.DataFrame({"sigma": [0.5, 1], "label": ["a", 1], "sound": [True, False], "time": [1, 2]})
    with pytest.raises(UnitsError, match="the columns sigma, time have no units"):
        as_csv(table, {})
    with pytest.raises(UnitsError, match="'second/furlong'"):
        as_csv(table, {"sigma": "1", "time": "second/furlong"})
    text = as_csv(table, {"sigma": "1", "time": "time", "absent": "1"})
    assert text.splitlines()[0] == '# units: {"sigma": "1", "time": "time"}'
