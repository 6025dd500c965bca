"""Text that captions share. Every number in a caption comes from the result files."""

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from workflow.lib.load import NOT_STATIONARY, NOT_TESTED, UNDEFINED, Result

SYMBOLS = {
    "cells": "N = {}",
    "particles_per_cell": "n = {}",
    "cell_length": "λ = {}",
    "sigma": "σ = {}",
    "gamma": "γ = {}",
    "temperature": "initial T = {}",
    "nu_left": "ν_L = {}",
    "nu_right": "ν_R = {}",
    "temperature_left": "T_L = {}",
    "temperature_right": "T_R = {}",
    "energy": "ε⁰ = {}",
    "pulse_energy": "ε̃ = {}",
    "times": "t = {}",
}
BATHS = ("nu_left", "nu_right", "temperature_left", "temperature_right")

RULE_PHRASES = {"random-direction": "random directions"}  # in words, where the name of --rule is no phrase
FEW = 3  # runs that are named one by one
DOUBTS = {UNDEFINED: "Without a value", NOT_STATIONARY: "Not stationary"}
DOUBTS |= {NOT_TESTED: "With too few replicas to test whether stationary"}
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def format_number(value: float) -> str:
    """The shortest text of the value: a fraction of up to three digits over 2, 3 or 9, or as few digits as
    give the value back; with a typographic minus sign."""
    number = float(value)
    fraction = Fraction(number).limit_denominator(9)
    exact = math.isclose(fraction, number, rel_tol=1e-12) and fraction.denominator in (2, 3, 9)
    digits, _, power = repr(number).partition("e")
    text = str(fraction) if exact and abs(fraction.numerator) < 1000 else digits.removesuffix(".0")
    return text.replace("-", "−") + (f"·{power_of_ten(int(power))}" if power else "")


def listed(texts: Iterable[str]) -> str:
    """The texts as an English list: a, b and c."""
    *most, last = texts
    return f"{', '.join(most)} and {last}" if most else last


def parameters(results: Sequence[Result], *names: str, paper: Mapping[str, list[Any]] | None = None) -> str:
    """The named parameters that the results have, with all their values: `N = 11, σ = −1/2 and 1/2`; by
    the name of the option without a symbol. paper: what it states (physics/paper.py). All parameters that
    differ from it are named, with its values: `n = 40 (paper: 20)`; equal baths are `the paper's baths`."""
    stated, texts = paper or {}, {}
    for name in dict.fromkeys((*names, *stated)):
        values = {result.parameters[name] for result in results if name in result.parameters}
        differ = name in stated and not all(_agrees(value, stated[name]) for value in values)
        if values and (differ or name in names):
            text = SYMBOLS.get(name, f"{name.replace('_', '-')} = {{}}").format(_as_list(values))
            texts[name] = f"{text} (paper: {_as_list(stated[name])})" if differ else text
    if {*BATHS} <= texts.keys() & stated.keys() and not any("paper" in texts[name] for name in BATHS):
        texts = {name: text for name, text in texts.items() if name not in BATHS} | {"": "the paper's baths"}
    return ", ".join(texts.values())


def _agrees(value: Any, stated: Collection[Any]) -> bool:
    return value in stated or (not isinstance(value, str) and f"{value:.3f}" in stated)


def _as_list(values: Collection[Any]) -> str:
    """Numbers in ascending order, then words."""
    numbers = sorted(value for value in values if not isinstance(value, str))
    return listed(
        [*map(format_number, numbers), *sorted(value for value in values if isinstance(value, str))]
    )


def rule(result: Result) -> str:
    """The collision rule with the values of its options, which are named after it: `elastic`, `random
    directions`, `reversal (0.03)`."""
    name = str(result.parameters["rule"])
    own = [
        value
        for option, value in result.parameters.items()
        if option.startswith(f"{name}_") and value != "none"
    ]
    values = f" ({', '.join(map(format_number, own))})" if own else ""
    return RULE_PHRASES.get(name, name) + values


def with_doubts(caption: str, results: Sequence[Result]) -> str:
    """The caption, with a sentence on results without a value, one on those that are not stationary, and one
    on those that were not tested. Panels with a point for each also cross them out."""
    for doubt, text in DOUBTS.items():
        runs = [result.run for result in results if doubt in result.doubts]
        if runs:
            caption += f" {text}: {listed(runs) if len(runs) <= FEW else f'{len(runs)} runs'}."
    return caption


def replicas(results: Sequence[Result]) -> str:
    """Number of replicas: `64 replicas` or `32 to 64 replicas`."""
    counts = [result.replicas for result in results if "seed" in result.parameters]
    low, high = min(counts), max(counts)
    return f"{low} replicas" if low == high else f"{low} to {high} replicas"


def scientific(value: float, digits: int = 2) -> str:
    """The value with this number of digits and a power of ten: 3.8·10⁻¹⁵."""
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}·{power_of_ten(int(power))}".replace("-", "−")


def power_of_ten(power: int) -> str:
    """The power as text: 10⁻¹⁵."""
    return f"10{str(power).translate(SUPERSCRIPTS)}"
