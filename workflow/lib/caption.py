"""Text that captions share. Every number in a caption comes from the result files."""

from collections.abc import Iterable, Sequence
from fractions import Fraction

import numpy as np

from workflow.lib.load import NOT_STATIONARY, NOT_TESTED, Result

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
}
BATHS = ("nu_left", "nu_right", "temperature_left", "temperature_right")
PAPERS_BATHS = (220, 180, 900 / 11, 1100 / 9)

RULE_PHRASES = {"random-direction": "random directions"}  # in words, where the name of --rule is no phrase
FEW = 3  # runs that are named one by one
DOUBTS = {NOT_STATIONARY: "Not stationary", NOT_TESTED: "With too few replicas to test whether stationary"}
ERRORS = "Bars show standard errors."
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def format_number(value: float) -> str:
    """The value with four digits, or as a fraction of up to three digits over 2, 3 or 9, and with a
    typographic minus sign."""
    fraction = Fraction(value).limit_denominator(10)
    exact = fraction.denominator > 1 and abs(fraction - Fraction(value)) < 1e-12
    if exact and fraction.denominator in (2, 3, 9) and abs(fraction.numerator) < 1000:
        text = str(fraction)
    else:
        text = f"{value:.0f}" if abs(value) >= 1e4 else f"{value:.4g}"
    return text.replace("-", "−")


def listed(texts: Iterable[str]) -> str:
    """The texts as an English list: a, b and c."""
    *most, last = texts
    return f"{', '.join(most)} and {last}" if most else last


def parameters(results: Sequence[Result], *names: str) -> str:
    """The named parameters that the results have, with all their values: `N = 11, σ = −1/2 and 1/2`; by
    the name of the option without a symbol."""
    texts = []
    for name in names:
        values = {result.parameters[name] for result in results if name in result.parameters}
        numbers = sorted(value for value in values if not isinstance(value, str))
        words = sorted(value for value in values if isinstance(value, str))
        if values:
            texts.append(
                SYMBOLS.get(name, f"{name.replace('_', '-')} = {{}}").format(
                    listed([*map(format_number, numbers), *words])
                )
            )
    return ", ".join(texts)


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
    """The caption, with a sentence on results that are not stationary, and one on those that were not
    tested. Panels with a point for each also cross them out."""
    for doubt, text in DOUBTS.items():
        runs = [result.run for result in results if doubt in result.doubts]
        if runs:
            caption += f" {text}: {listed(runs) if len(runs) <= FEW else f'{len(runs)} runs'}."
    return caption


def baths(result: Result) -> str:
    """`the paper's baths`, or others as `baths ν = 100, T = 100 and 120`, left and right; equal values are
    given once."""
    values = [float(result.parameters[name]) for name in BATHS]
    if np.allclose(values, PAPERS_BATHS):
        return "the paper's baths"
    both = [listed(dict.fromkeys(map(format_number, result.ends(name)))) for name in ("nu", "temperature")]
    return f"baths ν = {both[0]}, T = {both[1]}"


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
