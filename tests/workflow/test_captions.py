"""Captions and labels state the parameters of their results, and the paper's where they differ."""

import importlib
import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from tests.workflow.test_tables import OF_RUNS, PLAN, units_and_caption
from workflow.lib import style
from workflow.lib.caption import SYMBOLS, format_number, listed
from workflow.lib.load import Result, load
from workflow.physics.paper import PAPER

NAMES = {text.partition(" = ")[0]: name for name, text in SYMBOLS.items() if name != "times"}
VALUE = r"−?(?:\d+(?:\.\d+)?(?:/\w+)?|N)(?!\d|\.\d|/|\(\d| (?:[%s=\\]|at )|\^|·)"
STATEMENT = re.compile(rf"(?<![\w|])({'|'.join(NAMES)}) [=≤] ({VALUE}(?:(?:, | and ){VALUE})*)")
NOTE = re.compile(r" \(paper: [^)]*\)")
TEX = {"$": "", r"\sigma": "σ", r"\gamma": "γ", r"\lambda": "λ", r"\nu": "ν"}
NUMBER = re.compile(r"(?<![\w.^(−⁻|])−?\d+(?:\.\d+)?(?:·10[⁻\w]+)?(?![\w⁻(/]|\.\d)")
# Numbers of methods and symbols, by panel: T/2, x = 0, x = 1, 1 % of the largest F, ∫F dp = 1, Π = 0, |σ| ≤ 0.9 ...
METHOD = {"fig02_upper": "2", "fig03": "0 1", "fig03_inset": "1 0", "fig05": "0 0.9", "fig06": "50"}
METHOD |= {"fig10a": "2 3", "accuracy": "1", "momentum": "1 8", "stability": "2", "fig07_inset": "0"}


COUNTED = ("events", "achieved_error", "error_without_control_variates")


def changed(value: Any) -> Any:
    """Another value of a parameter, the same one for equal values."""
    if isinstance(value, str | bool | np.bool_):
        return np.float64(0.1) if value == "1/N" else value
    if -1 <= value <= 1 and not isinstance(value, np.integer):
        return type(value)(0.9 * value + 0.0625)
    return type(value)(value + 3)


def changed_result(result: Result, number: float) -> Result:
    """The result with other parameters, and other values of its quantities, also relative to each other."""

    def tilted(mean: np.ndarray) -> np.ndarray:
        return mean * (1.23 + 0.02 * number + 0.1 * np.sin(np.arange(mean.size)).reshape(mean.shape))

    quantities = {
        name: each if np.isin(each.mean, (0, 1)).all() else replace(each, mean=tilted(each.mean))
        for name, each in result.quantities.items()
    }
    parameters = {name: changed(value) for name, value in result.parameters.items()}
    counted = {
        name: (1.3 + number) * result.provenance[name] for name in COUNTED if name in result.provenance
    }
    return replace(
        result, parameters=parameters, quantities=quantities, provenance=result.provenance | counted
    )


def statements(text: str) -> Iterator[tuple[str, str]]:
    """Name and value of the parameters that a text states."""
    for symbol, values in STATEMENT.findall(text):
        yield from ((NAMES[symbol], value) for value in re.split(", | and ", values))


def texts_of(values: Iterable[Any]) -> list[str]:
    return [value if isinstance(value, str) else format_number(value) for value in values]


def stated_in_the_results(results: list[Result]) -> set[tuple[str, str]]:
    return {
        (name, text)
        for one in results
        for name, value in one.parameters.items()
        for text in texts_of([value])
    }


def changed_results(folder: Path, panel: str, number: float = 0) -> list[Result]:
    paths = enumerate(PLAN[panel].parents, 1)
    return [changed_result(load(folder / path), (number + each) / 5) for each, path in paths]


@cache
def drawn(folder: Path, panel: str, number: float = 0) -> tuple[Figure, str]:
    """Figure and caption from changed results."""
    style.apply()
    script = importlib.import_module(PLAN[panel].script.removesuffix(".py").replace("/", "."))
    figure, _, caption = script.draw(changed_results(folder, panel, number))
    plt.close("all")
    return figure, " ".join(caption.split())


@pytest.mark.parametrize("panel", OF_RUNS)
def test_every_parameter_of_captions_and_labels_is_that_of_the_results_or_of_the_paper(
    smoke: Path, panel: str
) -> None:
    """All parameters of the results are changed, and the values of their quantities. Detected mistakes: the
    parameters of the run in the sentence on the paper (fig06 with n = 40: it gave n = 40); λ = 1/N, n = 320, σ
    = 0.99 or γ = 10⁻³ as literals in captions, n = 20 or γ = 1 in legends; a difference that is not stated."""
    figure, caption = drawn(smoke, panel)
    labels = " ; ".join(text.get_text() for text in figure.findobj(Text))
    for tex, text in TEX.items():
        labels = labels.replace(tex, text)
    before, here, after = caption.partition(" Here")
    of_method = {*METHOD.get(panel, "").split()}
    paper = PAPER.get(panel, PAPER.get(panel[:5], {}))
    of_paper = {(name, text) for name, values in paper.items() for text in texts_of(values)}
    of_results = stated_in_the_results(changed_results(smoke, panel)) | {
        ("sigma", text) for text in of_method
    }
    assert {*statements(before)} <= (of_paper if here else of_results)
    assert {*statements(NOTE.sub("", after))} <= of_results
    assert {*statements(labels)} <= of_results
    for name, values in paper.items():
        texts = texts_of(values)
        if not {text for option, text in of_results if option == name} & {*texts}:
            symbol = SYMBOLS[name].partition(" = ")[0]
            assert re.search(rf"{symbol} = [^()]+ \(paper: {re.escape(listed(texts))}\)", after), name
    of_method |= {*NUMBER.findall(before)} if here else set()
    literal = {*NUMBER.findall(units_and_caption(smoke, panel)[1])} - of_method
    for number in (0, 9):  # twice, as few digits agree by chance
        literal = literal and literal & {*NUMBER.findall(NOTE.sub("", drawn(smoke, panel, number)[1]))}
    assert literal == set()
