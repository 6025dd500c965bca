"""The tables of the figures: every column scales with the results according to its units."""

import importlib
import io
import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import ModuleType

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest

from tests.python.scale import ROUNDING, agree, factor, other_result
from workflow.lib import style
from workflow.lib.columns import UNITS_LINE, TableError, as_csv, as_text
from workflow.lib.figure import Plot
from workflow.lib.load import NOT_REACHED, Quantity, Result, load
from workflow.lib.units import UnitsError
from workflow.pipeline.load_panel import load_panel
from workflow.pipeline.plan import Plan

REPORTED = Plan("smoke").reported  # not those of the user
SHIPPED = {panel.name for panel in REPORTED}
PLAN = {panel.name: panel for panel in REPORTED if panel.plotted}

# `verdicts` plots no runs: its labels and its bands are in the default units, and a series of the user counts
# for no claim (test_verdicts_panel.py).
OF_RUNS = [name for name in PLAN if name != "verdicts"]


def units_and_caption(folder: Path, panel: str) -> tuple[dict[str, str], str]:
    """Units and caption in the head of a table."""
    _, units, caption, _ = (folder / f"figures/smoke/{panel}.csv").read_text().split("\n", maxsplit=3)
    assert units.startswith(UNITS_LINE)
    return json.loads(units.removeprefix(UNITS_LINE)), caption.removeprefix("# caption: ")


def script_of(panel: str) -> ModuleType:
    return importlib.import_module(PLAN[panel].script.removesuffix(".py").replace("/", "."))


@cache
def tables(folder: Path, panel: str) -> list[pd.DataFrame]:
    """Tables from the results in the default units and in other ones. All runs missed their targets, which
    no panel and no caption may need."""
    draw = script_of(panel).draw
    given = [load(folder / path) for path in PLAN[panel].parents]
    missed = [replace(result, provenance=result.provenance | {"converged": NOT_REACHED}) for result in given]
    style.apply()
    drawn = []
    for results in (missed, [*map(other_result, missed)]):
        _, table, caption = draw(results)
        assert len(table)
        assert "nan" not in caption.split()
        drawn.append(table)
    plt.close("all")
    return drawn


OPTIONS_AS_GIVEN = "spacing", "limit"  # labels that hold a length or a rate as it is configured


def scales(folder: Path, panel: str, name: str, text: str) -> bool:
    """Whether a column scales according to these units."""
    plain, scaled = tables(folder, panel)
    values, converted = (table[name].to_numpy(dtype=float) for table in (plain, scaled))
    return agree(values, converted / factor(text), 1, ROUNDING)


@pytest.mark.parametrize("panel", OF_RUNS)
def test_every_column_scales_as_its_units(smoke: Path, panel: str) -> None:
    plain, scaled = tables(smoke, panel)
    units, _ = units_and_caption(smoke, panel)
    labels = [name for name in plain if name not in units and name not in OPTIONS_AS_GIVEN]
    pd.testing.assert_frame_equal(plain[labels], scaled[labels])
    for name, text in units.items():
        assert scales(smoke, panel, name, text), name
        mutant = "energy" if text in ("1", "second") else "1"
        seen = plain[name].abs().max() > 0
        assert scales(smoke, panel, name, mutant) != seen, name


def of_the_user(result: Result, number: int) -> Result:
    """A result of another series, whose options agree with those of no shipped one."""
    other = {"cells": 22, "sigma": 0.25, "gamma": 3, "particles_per_cell": 40, "rule": "reversal"}
    changed = {name: value for name, value in other.items() if name in result.parameters}
    path = result.path.with_name(f"mine_cells={number}.h5")
    return replace(result, path=path, parameters=result.parameters | {"reversal_probability": 0.2} | changed)


@pytest.mark.parametrize("panel", [name for name in OF_RUNS if name != "accuracy"])  # which plots all runs
def test_another_series_is_plotted_or_named_and_changes_nothing_else(smoke: Path, panel: str) -> None:
    draw = script_of(panel).draw
    given = [*load_panel(panel, "smoke").values()]
    own = [result for result in given if result.path.parent == given[-1].path.parent]
    mine = [of_the_user(result, number) for number, result in enumerate(own)]
    _, table, caption = draw(given)
    figure, with_mine, other_caption = draw([*given[: -len(own)], *mine, *own])
    if isinstance(draw, Plot):
        assert "mine" in draw.not_shown([*given[: -len(own)], *mine, *own])
        assert other_caption == caption
        pd.testing.assert_frame_equal(with_mine, table)
    else:
        assert "mine" in str([text.get_text() for legend in figure.legends for text in legend.get_texts()])
    plt.close("all")


@pytest.mark.parametrize("panel", PLAN)
def test_every_panel_is_rendered_from_one_replica(smoke: Path, panel: str) -> None:
    """REPLICAS=1: no error is known. Detected mistakes: a fit that fails, a mean without weights, an axis
    without numbers."""

    def alone(quantity: Quantity) -> Quantity:
        if quantity.count is None:
            return quantity
        nothing = np.full_like(quantity.mean, np.nan)
        return replace(quantity, standard_error=nothing, count=np.ones_like(quantity.count))

    results = [load(smoke / path) for path in PLAN[panel].parents]
    single = [
        replace(result, quantities={name: alone(each) for name, each in result.quantities.items()})
        for result in results
    ]
    figure, _, _ = script_of(panel).draw(single)
    figure.canvas.draw()
    plt.close("all")


def test_columns_without_units_are_refused() -> None:
    table = pd.DataFrame({"sigma": [0.5, 1], "label": ["a", 1], "sound": [True, False], "time": [1, 2]})
    with pytest.raises(UnitsError, match="the columns sigma, time have no units"):
        as_csv(table, {})
    with pytest.raises(UnitsError, match="'second/furlong'"):
        as_csv(table, {"sigma": "1", "time": "second/furlong"})
    text = as_csv(table, {"sigma": "1", "time": "time", "absent": "1"})
    assert text.splitlines()[0] == '# units: {"sigma": "1", "time": "time"}'


FRAME = pd.DataFrame({"sigma": [0.5, 1], "label": ["a", "b"]})


@pytest.mark.parametrize(
    "table",
    [
        FRAME.groupby("sigma").max(),
        FRAME.set_axis(["x", "y"]),
        FRAME.rename(columns={"label": "#"}),
        FRAME.assign(label=["NA", "b"]),
    ],
)
def test_a_table_that_its_csv_would_not_hold_is_refused(table: pd.DataFrame) -> None:
    with pytest.raises(TableError):
        as_csv(table, {"sigma": "1"})


def test_labels_stay_apart_and_numbers_have_one_kind() -> None:
    """Detected mistake: labels 010 and 10 become equal numbers."""
    labels = ["010", "10", "1e3", "N", 2]
    table = pd.DataFrame({"label": labels, "sigma": [1, 2.5, 1e20, np.nan, -3.0], "count": range(5)})
    text = as_text(table)
    assert text.splitlines()[1] == "label=010,1,0"
    read = pd.read_csv(io.StringIO(text))
    assert read.label.nunique() == len(labels)
    assert read[["sigma", "count"]].equals(table[["sigma", "count"]])


def test_rows_may_be_selected_and_unknown() -> None:
    table = pd.concat([FRAME, FRAME.assign(sigma=np.nan)])[1:]
    text = as_csv(table, {"sigma": "1"}).partition("\n")[2]
    assert pd.read_csv(io.StringIO(text), comment="#").equals(table.reset_index(drop=True))
