"""Option values in paper.yaml that depend on the number of cells: a sum of numbers, each alone or followed by
N or N^2, as 50+0.001N^2.

Programs get numbers.
"""

import re

NUMBER = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE]-?[0-9]+)?"  # without +, which separates terms
TERM = re.compile(rf"({NUMBER})(?:(N)(?:\^(2))?)?")
POLYNOMIAL = rf"{TERM.pattern}(\+{TERM.pattern})*"


def evaluated(value: object, size: object) -> object:
    """The value at N = size if it is a polynomial in N, otherwise itself."""
    polynomial = isinstance(value, str) and "N" in value and re.fullmatch(POLYNOMIAL, value)
    if not polynomial or not isinstance(size, int):
        return value
    terms = (
        float(factor) * size ** int(power or bool(n)) for factor, n, power in TERM.findall(polynomial[0])
    )
    number = float(f"{sum(terms):.12g}")
    return int(number) if number.is_integer() else number
