"""Option values in paper.yaml that depend on the number of cells: a sum of numbers, each alone or followed by N or N^2, as 50+0.001N^2.

Programs get numbers.
"""

import re

NUMBER = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
TERM = re.compile(rf"({NUMBER})(?:(N)(?:\^(2))?)?")


def pattern(number: str = NUMBER) -> str:
    """Regular expression of a sum of terms with such numbers."""
    term = rf"{number}(N(\^2)?)?"
    return rf"{term}(\+{term})*"


def evaluated(value: object, size: object) -> object:
    """The value at N = size if it is a polynomial in N, otherwise itself."""
    if not (
        isinstance(value, str) and "N" in value and re.fullmatch(pattern(), value) and isinstance(size, int)
    ):
        return value
    terms = [TERM.fullmatch(term) for term in re.split(r"(?<![eE])\+", value)]
    number = float(
        f"{sum(float(term[1]) * size ** int(term[3] or bool(term[2])) for term in terms if term):.12g}"
    )
    return int(number) if number.is_integer() else number
