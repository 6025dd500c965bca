"""Numbers of captions and of labels are those of the results."""

import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from tests.workflow.test_tables import OF_RUNS, PLAN, script_of, units_and_caption
from workflow.lib import style
from workflow.lib.caption import fill
from workflow.lib.load import Result, load
from workflow.lib.text import format_number
from workflow.physics.setting import SYMBOLS

NAMES = {symbol: name for name, symbol in SYMBOLS.items()}
VALUE = r"−?(?:\d+(?:\.\d+)?(?:/\w+)?|N)(?!\d|\.\d|/|\(\d| (?:[%s=\\]|at )|\^|·)"
STATEMENT = re.compile(rf"(?<![\w|])({'|'.join(NAMES)}) [=≤] ({VALUE}(?:(?:, | and ){VALUE})*)")
TEX = {"$": "", r"\sigma": "σ", r"\gamma": "γ", r"\lambda": "λ", r"\nu": "ν"}
NUMBER = re.compile(r"(?<![\w.^(−⁻|/])−?\d+(?:\.\d+)?(?:·10[⁻\w]+)?(?![\w⁻(/]|\.\d)")
# Numbers of the paper, of methods and of symbols, by panel: 0.1 %, x = 0, 1 % of the largest F, |σ| ≤ 0.9 ...
FIXED = {"fig02_upper": "1", "fig02_lower": "1", "fig03": "0 1", "fig03_inset": "0 0.1 0.01 1", "fig04a": "0"}
FIXED |= {
    "fig04b": "0",
    "fig05": "0 2",
    "fig06": "−3 −2 0 50",
    "fig07": "2",
    "fig07_inset": "0 1 2",
    "fig08": "1",
}
FIXED |= {"fig09a": "0", "fig09b": "0", "accuracy": "1", "momentum": "1 8 10", "stability": "0.3 2"}
COUNTED = ("events", "achieved_error", "error_without_control_variates")


def changed(value: Any) -> Any:
    """Another value of a parameter, the same one for equal values."""
    if isinstance(value, str | bool | np.bool_):
        return np.float64(0.1) if value == "1/N" else value
    if -1 <= value <= 1 and not isinstance(value, np.integer):
        return type(value)(0.9 * value + 0.0625)
    return type(value)(value + 3)


def changed_result(result: Result, number: float, options: bool) -> Result:
    """The result with other values of its quantities, also relative to each other. options: and of its
    parameters."""

    def tilted(mean: np.ndarray) -> np.ndarray:
        return mean * (1.23 + 0.02 * number + 0.1 * np.sin(np.arange(mean.size)).reshape(mean.shape))

    quantities = {
        name: each if np.isin(each.mean, (0, 1)).all() else replace(each, mean=tilted(each.mean))
        for name, each in result.quantities.items()
    }
    parameters = {name: changed(value) if options else value for name, value in result.parameters.items()}
    counted = {
        name: (1.3 + number) * result.provenance[name] for name in COUNTED if name in result.provenance
    }
    origin = result.provenance | counted
    return replace(result, parameters=parameters, quantities=quantities, provenance=origin)


@cache
def drawn(folder: Path, panel: str, number: float = 0) -> tuple[Figure, str, list[Result]]:
    """Figure and caption from changed results. The exact values of `stability` hold for its parameters, and
    the rings of `momentum` are long enough."""
    style.apply()
    options = panel not in ("stability", "momentum")
    paths = enumerate(PLAN[panel].parents, 1)
    results = [changed_result(load(folder / path), (number + each) / 5, options) for each, path in paths]
    figure, _, caption = script_of(panel).draw(results)
    plt.close("all")
    return figure, " ".join(caption.split()), results


@pytest.mark.parametrize("panel", OF_RUNS)
def test_every_number_of_captions_and_labels_is_that_of_the_results(smoke: Path, panel: str) -> None:
    """All parameters of the results are changed, and the values of their quantities. Detected mistakes: n =
    320, σ = 0.99 or γ = 10⁻³ as literals in captions, n = 20 or γ = 1 in legends."""
    figure, _, results = drawn(smoke, panel)
    labels = " ; ".join(text.get_text() for text in figure.findobj(Text))
    for tex, text in TEX.items():
        labels = labels.replace(tex, text)
    stated = {
        (NAMES[symbol], value)
        for symbol, values in STATEMENT.findall(labels)
        for value in re.split(", | and ", values)
    }
    of_results = {
        (name, value if isinstance(value, str) else format_number(value))
        for one in results
        for name, value in one.parameters.items()
    }
    assert stated <= of_results
    literal = {*NUMBER.findall(units_and_caption(smoke, panel)[1])} - {*FIXED.get(panel, "").split()}
    for number in (0, 9):  # twice, as few digits agree by chance
        literal = literal and literal & {*NUMBER.findall(drawn(smoke, panel, number)[1])}
    assert literal == set()


def test_a_sentence_without_its_number_is_left_out() -> None:
    """Detected mistake: a sentence ends with `fig.`"""
    text = "It is\n    {first}. Later it is {last}, {first} in fig. 8 before. The end."
    whole = "It is 1(2). Later it is 3, 1(2) in fig. 8 before. The end."
    assert fill(text, first="1(2)", last="3") == whole
    caption = fill(text, first="1(2)", last=None)
    assert caption == "It is 1(2). The end."
    with pytest.raises(KeyError, match="frist"):
        fill("It is {frist}.", first="1")
