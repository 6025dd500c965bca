"""Numbers, bands and text as the report prints them."""

import math
import re

from markupsafe import Markup, escape

from workflow.lib.text import format_with_error, power_of_ten, scientific
from workflow.study.verdict import Band, Estimate

BOUND = " ± "
MINUS = "\N{MINUS SIGN}"


def typeset(text: str) -> Markup:
    """Text as HTML."""
    parts = str(escape(text)).replace("&#39;", "'").split("`")  # names of series and runs between them
    parts[::2] = [_with_scripts(part, "<sup>{}</sup>", "<sub>{}</sub>") for part in parts[::2]]
    parts[1::2] = [f"<code>{part}</code>" for part in parts[1::2]]
    return Markup("".join(parts))


def mathtext(text: str) -> str:
    """Text for matplotlib."""
    return _with_scripts(text, r"$^{{\mathrm{{{}}}}}$", r"$_{{\mathrm{{{}}}}}$")


def _with_scripts(text: str, above: str, below: str) -> str:
    """Text with superscripts after ^ and subscripts after _ in these formats, and minus signs."""
    power = r"\^(?:\(([^)]*)\)|([-−]?\d+\.\d+(?:\(\d+\))?|[-−]?\w+))"
    text = re.sub(power, lambda match: above.format(match[1] or match[2]), text)
    text = re.sub(r"_(\w+)", lambda match: below.format(match[1]), text)
    return re.sub(r"(?<![\w)])-(?=\d)|(?<=\s)-(?=\s)", MINUS, text)


def markdown(text: str) -> Markup:
    """Text with the same HTML for Markdown, also in its tables."""
    return Markup(re.sub(r"([|*`\[\]])", r"\\\1", typeset(text)))


def figure_of(panel: str) -> str:
    """The figure of the paper that a panel belongs to."""
    return f"Fig. {int(panel[3:5])}" if panel.startswith("fig") else "Text"


def acceptance(band: Band) -> str:
    low, high = (f"{edge:g}".replace("-", MINUS) for edge in (band.low, band.high))
    if math.isinf(band.high):
        return f"above {low}"
    return f"below {high}" if math.isinf(band.low) else f"{low} to {high}"


def value(number: Estimate) -> str:
    """Number with its standard error and the bound on its systematic error in units of the last digit; ±
    the bound without a standard error."""
    if not number.error and abs(number.value) < number.systematic:
        return f"0 to rounding{BOUND}{two_digits(number.systematic)}"
    size = max(abs(number.value), number.error, number.systematic)
    if 0 < size < 1e-3:
        power = math.floor(math.log10(size))
        scaled = value(number / 10.0**power)
        return f"({scaled})·{power_of_ten(power)}" if BOUND in scaled else f"{scaled}·{power_of_ten(power)}"
    if math.isnan(number.error):
        return f"{number.value:.4g} (error unknown)".replace("-", MINUS)
    bound = "" if number.error or not number.systematic else f"{BOUND}{two_digits(number.systematic)}"
    return f"{format_with_error(number.value, number.error, number.systematic)}{bound}"


def two_digits(size: float) -> str:
    """Two digits, with a power of ten where there would be many zeros."""
    return scientific(size) if 0 < size < 1e-3 else f"{size:.2g}"
