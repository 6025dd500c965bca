"""Numbers and lists as text."""

import math
from collections.abc import Iterable
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from workflow.lib.load import Index, Quantity

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


def format_with_error(value: float, error: float, systematic: float = 0) -> str:
    """Value and error with two digits of the error: 1.8620(54), or 745.0(8.2) for errors of 1 and above;
    1.0(?) if the error is unknown, `unknown` for NaN. An error of 0 is not written. The bound on the
    systematic error follows in its own brackets, unless it is below the last digit: 0.299(8)(52); ∞ if it is
    unknown."""
    if not np.isfinite(value):
        return "unknown"
    if not (np.isfinite(error) and error > 0):
        text = (f"{value:.0f}" if abs(value) >= 1e4 else f"{value:z.4g}").replace("-", "−")
        return text if error == 0 else f"{text}(?)" if "." in text else f"{text}.0(?)"
    error = float(f"{error:.1e}")
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    errors = [error] if systematic * 10**digits <= 0.5 else [error, systematic]
    brackets = (
        "∞" if not np.isfinite(one) else f"{one:.{digits}f}" if error >= 1 else f"{round(one * 10**digits)}"
        for one in errors
    )
    return "".join([f"{value:z.{digits}f}", *(f"({number})" for number in brackets)]).replace("-", "−")


def format_quantity(quantity: "Quantity", index: "Index" = (), unit: float = 1) -> str:
    """Value and error of a quantity at an index, as 1.8620(54)."""
    return format_with_error(unit * float(quantity.mean[index]), unit * float(quantity.error[index]))


def scientific(value: float, digits: int = 2) -> str:
    """The value with this number of digits and a power of ten: 3.8·10⁻¹⁵."""
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}·{power_of_ten(int(power))}".replace("-", "−")


def scientific_in_tex(value: float) -> str:
    """The value with one digit and a power of ten, for matplotlib: 2 \\cdot 10^{-3}, 10^{-6}."""
    digit, power = f"{value:.0e}".split("e")
    return rf"{digit} \cdot 10^{{{int(power)}}}".removeprefix(r"1 \cdot ")


def power_of_ten(power: int) -> str:
    """The power as text: 10⁻¹⁵."""
    return f"10{str(power).translate(SUPERSCRIPTS)}"


def listed(texts: Iterable[str]) -> str:
    """The texts as an English list: a, b and c."""
    *most, last = texts
    return f"{', '.join(most)} and {last}" if most else last
