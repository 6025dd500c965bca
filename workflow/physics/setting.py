"""The parameters of a panel in one sentence, and what differs from the paper in another.

Parameters of the role `physics` count, and all that the paper states (paper.py).
"""

from collections import defaultdict
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

from workflow.lib.caption import quoted
from workflow.lib.figure import TheoryError
from workflow.lib.load import Result
from workflow.lib.text import format_number, listed
from workflow.physics.paper import AXIS, BATHS, PAPER, Stated

SYMBOLS = {
    "sigma": "σ",
    "cells": "N",
    "particles_per_cell": "n",
    "temperature": "initial T",
    "gamma": "γ",
    "cell_length": "λ",
    "energy": "ε⁰",
    "pulse_energy": "ε̃",
    "fugacity": "z",
    "nu_left": "ν_L",
    "nu_right": "ν_R",
    "temperature_left": "T_L",
    "temperature_right": "T_R",
}
FEW = 4  # values that are named one by one


def sentences(results: Sequence[Result], script: str) -> str:
    """What the plotted results of a panel have: `σ = 1/2, N = 11, the paper's baths.`, and what differs: `Not
    the paper's: N = 3 (paper: 11) in `young`.`"""
    paper = stated(script)
    common: dict[str, set[Any]] = defaultdict(set)
    differing: dict[str, dict[str, set[Any]]] = defaultdict(lambda: defaultdict(set))  # by series and name
    given: set[str] = set()
    for result in results:
        for name, value in model(result, paper).items():
            given |= set() if _is_default(result, name) else {name}
            if _agrees(value, paper.get(name, AXIS)):
                common[name].add(value)
            else:
                differing[result.series][name].add(value)
    names = [name for name in dict.fromkeys([*SYMBOLS, *common]) if name in common]
    names = [name for name in names if name in (SYMBOLS if name in paper else given)]
    texts = {name: _equation(name, common[name]) for name in names if paper.get(name) != AXIS}
    if {*BATHS} <= texts.keys() & paper.keys():
        texts = {name: text for name, text in texts.items() if name not in BATHS} | {"": "the paper's baths"}
    alike: dict[str, list[str]] = defaultdict(list)  # series by what differs
    for series, values in differing.items():
        of_paper = {name: f" (paper: {as_list(paper[name])})" for name in values.keys() - common.keys()}
        each = [_equation(name, values[name]) + of_paper.get(name, "") for name in values]
        alike[", ".join(each)].append(series)
    every = {result.series for result in results}
    others = [f"{text} in {quoted(some)}" if {*some} != every else text for text, some in alike.items()]
    sentence = f"{', '.join(texts.values())}." if texts else ""
    return f"{sentence} Unlike the paper: {'; '.join(others)}.".lstrip() if others else sentence


def require_one_value(results: Sequence[Result], script: str, varied: Collection[str]) -> None:
    """Raises TheoryError if runs differ in a parameter that is not in `varied` and has one value in the
    paper: one run would be taken for another, and theories for those of other parameters."""
    paper = stated(script)
    several = {name for name, values in paper.items() if values == AXIS or len(values) > 1}
    for name in SYMBOLS.keys() - several - {*varied} if paper else ():
        values = {found[name] for result in results if name in (found := model(result, {}))}
        if len(values) > 1:
            runs = f"{name.replace('_', '-')}, and the runs have {listed(sorted(map(str, values)))}"
            raise TheoryError(f"{Path(script).name} plots one {runs}: make a panel of each")


def stated(script: str) -> Stated:
    """What the paper states for the panel of a script, or for its figure."""
    name = Path(script).stem
    return PAPER.get(name) or PAPER.get(name[:5], {})


def model(result: Result, paper: Stated) -> dict[str, Any]:
    """The parameters of the model, and others that the paper states. Those of a rule are in its name; the
    continuum has no number of cells."""
    roles = result.parameter_roles
    names = [name for name in result.parameters if roles.get(name) == "physics" or name in paper]
    found = {name: result.parameters[name] for name in names if name not in result.parameter_rules}
    found = {name: value for name, value in found.items() if value != "continuum"}
    return found | ({"rule": rule(result)} if "rule" in found else {})


def rule(result: Result) -> str:
    """The collision rule with the values of its options: `reversal (0.03)`."""
    own = [f"{result.parameters[name]:g}" for name in result.parameter_rules if name in result.parameters]
    name = str(result.parameters["rule"])
    return f"{name} ({', '.join(own)})" if own else name


def _is_default(result: Result, name: str) -> bool:
    """Whether an option was not given."""
    return f"--{name.replace('_', '-')}" not in result.provenance.get("option_words", "").split()


def _agrees(value: Any, paper: Collection[Any]) -> bool:
    number = not isinstance(value, str | bool)
    return paper == AXIS or value in paper or (number and f"{value:.3f}" in paper)


def _equation(name: str, values: Collection[Any]) -> str:
    return f"{SYMBOLS.get(name, name.replace('_', '-'))}{' ' if name == 'rule' else ' = '}{as_list(values)}"


def as_list(values: Collection[Any]) -> str:
    """Numbers in ascending order, then words; ends and number of many."""
    words = {str(value).lower() if isinstance(value, bool) else value for value in values}
    numbers = [*map(format_number, sorted(value for value in words if not isinstance(value, str)))]
    if len(numbers) > FEW:
        numbers = [f"{numbers[0]} to {numbers[-1]}"]
    return listed([*numbers, *sorted(word for word in words if isinstance(word, str))])
