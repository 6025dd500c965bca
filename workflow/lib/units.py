"""Grammar of units in result files and tables: a product of powers of dimensions, or a quotient of two.

    units   = product [ "/" ( factor | "(" product ")" ) ]
    product = factor { " " factor }
    factor  = word [ "^" digits ]
    word    = "1" | "length" | "time" | "momentum" | "energy" | "temperature" | "second"

With m = k_B = 1 a momentum is a length over a time, and energy and temperature are its square. A second
measures the computer, not the model.
"""

import re
from functools import cache
from typing import NamedTuple


class UnitsError(ValueError):
    """A text is not a unit, or a column of a table has none."""


class Units(NamedTuple):
    """Exponents of the independent dimensions."""

    length: int = 0
    time: int = 0
    second: int = 0


WORDS = {
    "1": Units(),
    "length": Units(length=1),
    "time": Units(time=1),
    "momentum": Units(length=1, time=-1),
    "energy": Units(length=2, time=-2),
    "temperature": Units(length=2, time=-2),
    "second": Units(second=1),
}

_FACTOR = re.compile(r"([a-z]+|1)(?:\^([1-9][0-9]?))?")
_QUOTIENT = re.compile(r"([^/()]+)(?:/(?:([^/() ]+)|\(([^/()]+)\)))?")


@cache
def parse(text: str) -> Units:
    """Dimensions of a unit. Raises UnitsError if the text does not follow the grammar."""
    quotient = _QUOTIENT.fullmatch(text)
    if quotient is None:
        raise UnitsError(
            f"'{text}' is not a unit: write a product or a quotient of two, as in 'energy/(time temperature)'"
        )
    above, single, several = quotient.groups()
    below = _product(single or several or "1", text)
    return Units(*(a - b for a, b in zip(_product(above, text), below, strict=True)))


def _product(factors: str, text: str) -> Units:
    exponents = Units()
    for factor in factors.split(" "):
        parts = _FACTOR.fullmatch(factor)
        if parts is None or parts[1] not in WORDS:
            raise UnitsError(f"'{factor}' in '{text}' is not a unit; use powers of {', '.join(WORDS)}")
        power = int(parts[2] or 1)
        exponents = Units(*(a + power * b for a, b in zip(exponents, WORDS[parts[1]], strict=True)))
    return exponents
