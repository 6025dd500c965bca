"""Options of a program: which values they admit, and the words of a command line. Standard library only.

An option is described as `PROGRAM --describe` describes it: type, minimum, exclusive_minimum, maximum, word, choices.
"""

import math
import re
import sys
from typing import Any

Options = dict[str, Any]  # name, without dashes: number, text, or bool for a flag

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE)


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
        multiple = symbol and value.endswith(symbol) and _in_range(option, _number(value[: -len(symbol)]))
        return value == option.get("word") or bool(multiple)
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
    return text + (
        f", or {option.get('word') or f'such a number followed by {_symbol(kind)}'}" if other else ""
    )


def _symbol(kind: str) -> str:
    """Of the size whose multiples an option of this type admits."""
    return kind.partition("multiple of ")[2]


def _number(text: str) -> float:
    return float(text) if NUMBER.fullmatch(text) else math.nan


def _in_range(option: dict[str, Any], number: float) -> bool:
    """False for nan and the infinities."""
    lowest, largest = option.get("minimum", -sys.float_info.max), option.get("maximum", sys.float_info.max)
    return lowest <= number <= largest and number > option.get("exclusive_minimum", -math.inf)
