"""Options of a program: which values they admit, and the words of a command line. Standard library only.

An option is described as `PROGRAM --describe` describes it: type, minimum, exclusive_minimum, maximum, word, choices.
"""

import math
import re
import sys
from typing import Any

Options = dict[str, Any]  # name, without dashes: number, text, or bool for a flag

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)


def arguments(options: Options) -> list[str]:
    words = []
    for name, value in options.items():
        if value is True:
            words.append(f"--{name}")
        elif value is not False:
            words += [f"--{name}", str(value)]
    return words


def admits(option: dict[str, Any], value: object) -> bool:
    """Whether a value of the configuration is one that the program accepts."""
    kind = option["type"]
    if kind in ("flag", "text"):
        return isinstance(value, bool if kind == "flag" else str)
    if kind == "choice":
        return value in option["choices"]
    if kind == "numbers":
        numbers = [_number(text) for text in str(value).split(",")]
        return all(_in_range(option, number) for number in numbers) and numbers == sorted(set(numbers))
    if isinstance(value, str):
        symbol = _symbol(kind)
        return value == option.get("word") or bool(symbol and _polynomial_in_range(option, value, symbol))
    whole = kind.startswith("integer")
    return (
        not isinstance(value, bool)
        and isinstance(value, int if whole else (int, float))
        and _in_range(option, value)
    )


def admissible(option: dict[str, Any]) -> str:
    """What admits() accepts, in words."""
    kind = option["type"]
    if kind in ("flag", "text", "choice"):
        return {"flag": "true or false", "text": "text"}.get(kind) or " or ".join(option["choices"])
    noun, _, other = kind.partition(" or ")
    limits = {"minimum": "at least", "exclusive_minimum": "above", "maximum": "at most"}
    parts = [f"{word} {option[limit]:.15g}" for limit, word in limits.items() if limit in option]
    text = " ".join([noun, " and ".join(parts)]).strip()
    if noun == "numbers":
        return f"{text}, ascending, separated by commas"
    symbol = _symbol(kind)
    polynomial = f"a sum of such, each alone or followed by {symbol} or {symbol}^2"
    return text + (f", or {option.get('word') or polynomial}" if other else "")


def at_size(value: object, size: float, symbol: str = "N") -> float:
    """The value of a number or of a polynomial in a size, such as 50+0.0004N^2; nan if it is neither."""
    return sum(coefficient * size**power for coefficient, power in terms(str(value), symbol))


def terms(polynomial: str, symbol: str = "N") -> list[tuple[float, int]]:
    """Coefficients and powers; nan for what is not a number."""
    parts = [re.fullmatch(rf"(.*?)({symbol}(\^2)?)?", term) for term in re.split(r"(?<!e)\+", polynomial)]
    return [(_number(part[1]), 0 if not part[2] else 2 if part[3] else 1) for part in parts if part]


def _polynomial_in_range(option: dict[str, Any], text: str, symbol: str) -> bool:
    found = terms(text, symbol)
    powers = [power for _, power in found]
    return all(_in_range(option, coefficient) for coefficient, _ in found) and len(powers) == len(set(powers))


def _symbol(kind: str) -> str:
    """Of the size in which an option of this type admits a polynomial."""
    return kind.partition("polynomial in ")[2]


def _number(text: str) -> float:
    return float(text) if NUMBER.fullmatch(text) else math.nan


def _in_range(option: dict[str, Any], number: float) -> bool:
    """False for nan and the infinities."""
    lowest, largest = option.get("minimum", -sys.float_info.max), option.get("maximum", sys.float_info.max)
    return bool(lowest <= number <= largest and number > option.get("exclusive_minimum", -math.inf))
