"""The parameters of a panel in one sentence, and what differs from the paper in another.

Parameters of the role `physics` count, and all that the paper states. Expected are its values and those that
this project chooses (paper.py), where there are neither the default of the program. All others are named.
"""

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any

from workflow.lib.caption import quoted
from workflow.lib.figure import TheoryError
from workflow.lib.identity import panel_of
from workflow.lib.load import Result
from workflow.lib.text import format_number, listed
from workflow.physics.paper import ALL, AXIS, BATHS, CHOICES, PAPER, Stated

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
    paper, choices = _entry(PAPER, script), _entry(CHOICES, script)
    common: dict[str, set[Any]] = defaultdict(set)
    differing: dict[str, dict[str, set[Any]]] = defaultdict(lambda: defaultdict(set))  # by name and series
    having: dict[str, set[str]] = defaultdict(set)  # series with a parameter
    several = len({panel_of(result.path) for result in results}) > 1
    for result in results:
        series = f"{panel_of(result.path)}/{result.series}" if several else result.series
        general, own = expected(result, script)
        for name, value in model(result, general).items():
            having[name].add(series)
            allowed = [*general.get(name, []), *own.get(name, [])]
            if not (_agrees(value, allowed) if allowed else _is_default(result, name)):
                differing[name][series].add(value)
            elif name not in own and allowed != AXIS:
                common[name].add(value)
    listed_names = [name for name in SYMBOLS if name in common and name in {**paper, **choices.get(ALL, {})}]
    texts = {name: _equation(name, common[name]) for name in listed_names}
    if {*BATHS} <= texts.keys() and not {*BATHS} & differing.keys():
        texts = {name: text for name, text in texts.items() if name not in BATHS} | {"": "the paper's baths"}
    plain, unlike = [*texts.values()], list[str]()
    for name, by_series in differing.items():
        to = unlike if name in paper else plain
        to.extend(_differences(name, by_series, having[name], paper.get(name)))
    text = f"{', '.join(plain)}." if plain else ""
    return f"{text} Not the paper's: {'; '.join(unlike)}.".lstrip() if unlike else text


def require_one_value(results: Sequence[Result], script: str) -> None:
    """Raises TheoryError if runs differ in a parameter in which neither the paper's nor this project's do:
    they would be taken for one another, and theories for those of other parameters."""
    paper, choices = _entry(PAPER, script), _entry(CHOICES, script)
    of_all = paper | choices.get(ALL, {})
    varying = {name for name, stated in of_all.items() if stated is AXIS or len(stated) > 1}
    varying |= {name for series, stated in choices.items() if series != ALL for name in stated}
    for name in {name for result in results for name in model(result, {})} - varying:
        given = [result.parameters for result in results if name in result.parameters]
        values = {parameters[name] for parameters in given}
        if name == "cell_length" and not any(isinstance(value, str) for value in values):
            # One length of all chains is one value, too.
            values = {f"{one[name] * one['cells']:.9g}" for one in given} if len(values) > 1 else values
        if paper and len(values) > 1:
            option = name.replace("_", "-")
            raise TheoryError(
                f"{script}.py plots one {option}, and the runs have {listed(sorted(map(str, values)))}: "
                "make a panel of each"
            )


def _entry(table: Mapping[str, Any], *names: str) -> Any:
    """The entry of the first of the names that has one, or whose figure has."""
    return next((table[key] for name in names for key in (name, name[:5]) if key in table), {})


def expected(result: Result, script: str) -> tuple[Stated, Stated]:
    """Expected values of the parameters: those of all series, and those of the series of a result. Results of
    another panel have its own."""
    names = (panel_of(result.path), script)
    choices = _entry(CHOICES, *names)
    general = _entry(PAPER, *names) | choices.get(ALL, {})
    return general, choices.get(result.series, {})


def model(result: Result, stated: Stated) -> dict[str, Any]:
    """The parameters of the model, and others that are stated. Those of a rule are in its name."""
    roles = result.parameter_roles
    names = [name for name in result.parameters if roles.get(name) == "physics" or name in stated]
    found = {name: result.parameters[name] for name in names if name not in result.parameter_rules}
    return found | ({"rule": rule(result)} if "rule" in found else {})


def rule(result: Result) -> str:
    """The collision rule with the values of its options: `reversal (0.03)`."""
    own = [f"{result.parameters[name]:g}" for name in result.parameter_rules if name in result.parameters]
    name = str(result.parameters["rule"])
    return f"{name} ({', '.join(own)})" if own else name


def _is_default(result: Result, name: str) -> bool:
    """Whether an option was not given."""
    return f"--{name.replace('_', '-')}" not in result.provenance.get("option_words", "").split()


def _agrees(value: Any, stated: Collection[Any]) -> bool:
    number = not isinstance(value, str | bool)
    return stated == AXIS or value in stated or (number and f"{value:.3f}" in stated)


def _differences(
    name: str, by_series: Mapping[str, set[Any]], having: set[str], stated: Any
) -> Iterable[str]:
    """A text for all series with the same values."""
    groups: dict[frozenset[Any], list[str]] = defaultdict(list)
    for series, values in by_series.items():
        groups[frozenset(values)].append(series)
    for same, names in groups.items():
        paper = f" (paper: {as_list(stated)})" if stated and name != "rule" else ""
        where = f" in {quoted(names)}" if {*names} != having else ""
        yield f"{_equation(name, same)}{paper}{where}"


def _equation(name: str, values: Collection[Any]) -> str:
    return f"{SYMBOLS.get(name, name.replace('_', '-'))}{' ' if name == 'rule' else ' = '}{as_list(values)}"


def as_list(values: Collection[Any]) -> str:
    """Numbers in ascending order, then words; ends and number of many."""
    words = {str(value).lower() if isinstance(value, bool) else value for value in values}
    numbers = [*map(format_number, sorted(value for value in words if not isinstance(value, str)))]
    if len(numbers) > FEW:
        numbers = [f"{numbers[0]} to {numbers[-1]}"]
    return listed([*numbers, *sorted(word for word in words if isinstance(word, str))])
