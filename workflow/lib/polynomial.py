"""Option values that depend on the number of cells: a sum of numbers, each alone or followed by N or N^2, as 50+0.001N^2."""

import math
import re
from collections.abc import Callable

NUMBER = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
POWER = r"(?:(N)(?:\^(2))?)?"
TERM = re.compile(rf"([+-]?{NUMBER}){POWER}")


def pattern(number: str = NUMBER) -> str:
    """Regular expression of a sum of terms with such numbers."""
    term = rf"{number}{POWER}"
    return rf"{term}(\+{term})*"


def at_size(value: object, size: float) -> float:
    """Value at N = size; nan for other text."""
    terms = [TERM.fullmatch(term) for term in _terms(value)]
    return sum(float(term[1]) * size ** int(term[3] or bool(term[2])) if term else math.nan for term in terms)


def evaluated(value: object, size: int) -> object:
    """A polynomial as a number of twelve digits, at N = size; any other value as it is."""
    number = at_size(value, size) if isinstance(value, str) and "N" in value else math.nan
    return value if math.isnan(number) else float(f"{number:.12g}")


def scaled(value: object, change: Callable[[float], float]) -> str:
    """The value with every coefficient changed; also of a list of numbers separated by commas."""
    items = [[TERM.fullmatch(term) for term in _terms(item)] for item in str(value).split(",")]
    return ",".join(
        "+".join(f"{change(float(term[1])):.6g}{term[0][len(term[1]) :]}" for term in terms if term)
        for terms in items
    )


def _terms(value: object) -> list[str]:
    return re.split(r"(?<![eE])\+", str(value))
