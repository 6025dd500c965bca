"""The renderer states what plotted runs have: every change of the model is in the caption, or refused."""

import importlib
import re
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from tests.python.conftest import ROOT
from tests.python.described import options_of_programs
from workflow.figures import stability
from workflow.lib.figure import Plot, TheoryError, holds
from workflow.lib.load import Result
from workflow.physics import setting
from workflow.physics.paper import AXIS, BATHS
from workflow.pipeline.plan import Panel, Plan, Run

FILES = ("paper.yaml", "study.yaml")  # panels of other files are the user's own
PLOTTED = [panel for panel in Plan("paper") if panel.file.name in FILES and panel.plotted]
PANELS = {panel.name: panel for panel in PLOTTED if setting.stated(panel.script)}
WORDS = {"start": "cold", "scatterer_temperature": 300.0, "cell_length": 0.1, "gamma": 7.0, "cells": 9}
MOST = 43  # words of the parameters of a shipped panel


def script_of(panel: Panel) -> ModuleType:
    return importlib.import_module(panel.script.removesuffix(".py").replace("/", "."))


def result_of(run: Run) -> Result:
    """A result with the parameters of a run, and no numbers."""
    options = options_of_programs()[run.program]
    given = {
        name: option["default"]
        for name, option in options.items()
        if "default" in option and "rule" not in option
    }
    given = {name.replace("-", "_"): value for name, value in (given | run.options).items()}
    described = {name.replace("-", "_"): option for name, option in options.items()}
    roles = {name: described[name]["role"] for name in given}
    rules = {name: described[name]["rule"] for name in given if "rule" in described[name]}
    provenance = {"option_words": run.options_text, "program": run.program}
    return Result(Path(run.path), given, provenance, {}, parameter_roles=roles, parameter_rules=rules)


def shown(panel: Panel) -> list[Result]:
    draw, results = script_of(panel).draw, [result_of(run) for run in panel.plotted]
    return draw.shown(results) if isinstance(draw, Plot) else results


def test_plotted_series_exist() -> None:
    """Detected mistake: a misspelled name in @plots, whose series would not be plotted."""
    series = defaultdict(set)
    for panel in PLOTTED:
        series[panel.script] |= {run.series for run in panel.plotted}
    for panel in PLOTTED:
        draw = script_of(panel).draw
        assert not isinstance(draw, Plot) or {*draw.series} <= series[panel.script]


def text_of(panel: Panel, results: Sequence[Result]) -> str:
    """The sentences of the renderer. Raises TheoryError."""
    draw = script_of(panel).draw
    if isinstance(draw, Plot):
        setting.require_one_value(results, panel.script, draw.varied)
    return setting.sentences(results, panel.script)


def with_another(result: Result, name: str) -> Result:
    """The result with another value of an option, which is then given."""
    value = result.parameters[name]
    rules, roles = result.parameter_rules, result.parameter_roles
    if name == "rule":
        own = {"rule": "reversal", "reversal_probability": 0.5}
        rules, roles = {"reversal_probability": "reversal"}, roles | {"reversal_probability": "physics"}
        others = {
            option: value
            for option, value in result.parameters.items()
            if option not in result.parameter_rules
        }
        result = replace(result, parameters=others)
    elif isinstance(value, bool):
        own = {name: not value}
    elif isinstance(value, str):
        own = {name: WORDS[name]}
    else:
        own = {name: value + 1 if isinstance(value, int) else value / 2 + 0.11}
    words = f"{result.provenance['option_words']} --{name.replace('_', '-')} other"
    provenance = result.provenance | {"option_words": words}
    return replace(
        result,
        parameters=result.parameters | own,
        provenance=provenance,
        parameter_rules=rules,
        parameter_roles=roles,
    )


def states(text: str, results: Iterable[Result], name: str) -> bool:
    """Whether a text has the value of each of the results, after the symbol."""
    before = (
        rf"(?:^|[,;:] ){re.escape(setting.SYMBOLS.get(name, name.replace('_', '-')))} (?:= )?(?:[^=;]*[ ,])?"
    )
    values = {setting.as_list([setting.model(one, {})[name]]) for one in results}
    return all(re.search(rf"{before}{re.escape(value)}(?=[ ,.;]|$)", text) for value in values)


@pytest.mark.parametrize("name", PANELS)
def test_every_change_of_the_model_is_stated_or_refused(name: str) -> None:
    """Each option of the model is changed, in each series alone and in all together, to a value that is not
    the paper's. Detected mistakes: fig. 8 with the rule that ends the growth of κ, fig. 6 with scatterers of
    another temperature, and captions that do not say so."""
    panel = PANELS[name]
    paper = setting.stated(panel.script)
    plotted, number = shown(panel), 0
    every = {result.series for result in plotted}
    for group in (every, *({series} for series in every)):
        chosen = [result for result in plotted if result.series in group]
        for option in {option for result in chosen for option in setting.model(result, {})}:
            changed = [one for one in chosen if option in setting.model(one, {})]
            others = {id(one): with_another(one, option) for one in changed}
            values = [setting.model(one, {})[option] for one in others.values()]
            if paper.get(option) == AXIS or any(value in paper.get(option, ()) for value in values):
                continue
            results = [others.get(id(one), one) for one in plotted]
            number += 1
            try:
                text = text_of(panel, results)
            except TheoryError:
                continue
            assert states(text, others.values(), option), (sorted(group), option, text)
            having = {result.series for result in plotted if option in setting.model(result, {})}
            all_changed = {result.series for result in changed} == having
            assert all_changed or option not in paper or "` " in text or "`." in text
    assert number > 0


@pytest.mark.parametrize("name", PANELS)
def test_shipped_panels_have_a_series_with_the_papers_parameters(name: str) -> None:
    """And state them in few words. That of fig. 10 is a series of fig. 9."""
    panel = PANELS[name]
    text, paper = text_of(panel, shown(panel)), setting.stated(panel.script)
    assert "(paper:" not in text
    assert len(text.split()) <= MOST
    assert ("the paper's baths" in text) == ({*BATHS} <= paper.keys())


def test_what_differs_is_named_with_its_series_and_the_papers_value() -> None:
    plotted = shown(PANELS["fig08"])
    rule = [with_another(one, "rule") if "rule" in one.parameters else one for one in plotted]
    text = "baths. Unlike the paper: rule reversal (0.5) (paper: elastic) in `deterministic`,"
    assert text in text_of(PANELS["fig08"], rule)
    gamma = [with_another(one, "gamma") if one.series == "rare" else one for one in plotted]
    text = "baths. Unlike the paper: γ = 2 in `rare`."
    assert text_of(PANELS["fig08"], gamma).endswith(text)
    rings = [replace(one, parameters=one.parameters | {"cells": 3}) for one in shown(PANELS["fig07_inset"])]
    assert "N = 3 (paper: 11)" in text_of(PANELS["fig07_inset"], rings)


@pytest.mark.parametrize(
    ("parameters", "values", "expected"),
    [
        ({"rule": "elastic"}, {}, True),
        ({"rule": "reversal"}, {}, False),
        ({}, {"gamma": "N"}, True),
        ({"gamma": 3.0}, {"gamma": "N"}, False),
        ({"gamma": 3.0}, {"gamma": (2, 3)}, True),
    ],
)
def test_a_theory_holds_for_the_elastic_rule_and_the_values_given(
    parameters: dict[str, Any], values: dict[str, Any], expected: bool
) -> None:
    assert holds([Result(ROOT, parameters, {}, {})], **values) == expected


@pytest.mark.parametrize("script", ["fig05", "fig03_inset"])
def test_a_panel_of_deviations_from_a_theory_needs_it(script: str) -> None:
    draw = importlib.import_module(f"workflow.figures.{script}").draw
    with pytest.raises(TheoryError, match="holds for rule elastic only"):
        draw([Result(ROOT, {"rule": "random-direction", "nu_left": 1}, {}, {})])


@pytest.mark.parametrize("changed", [{"rule": "reversal"}, {"sigma": 0.3}])
def test_extreme_chains_are_compared_where_their_current_is_known(changed: dict[str, Any]) -> None:
    chain = {"rule": "elastic", "sigma": 0.0, "gamma": "N", "cells": 4, "nu_left": 2, "nu_right": 1}
    chain |= {"temperature_left": 1, "temperature_right": 1}
    assert stability.exact_current(Result(ROOT, chain, {}, {})) == 0.5
    with pytest.raises(TheoryError):
        stability.exact_current(Result(ROOT, chain | changed, {}, {}))


@pytest.mark.parametrize(
    ("script", "name"),
    [("fig08", "sigma"), ("fig04", "sigma"), ("fig03_inset", "nu_left"), ("fig06", "particles_per_cell")],
)
def test_a_panel_plots_one_value_of_each_other_parameter(script: str, name: str) -> None:
    """Detected mistakes: slopes between runs of different sigma; a theory for other parameters."""
    runs = [Result(ROOT, {name: value}, {}, {}, parameter_roles={name: "physics"}) for value in (1, 2)]
    with pytest.raises(TheoryError, match=rf"plots one {name.replace('_', '-')}, and the runs have 1 and 2"):
        setting.require_one_value(runs, script, ())
