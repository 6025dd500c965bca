"""Captions: numbers with names, and what the renderer adds to any of them."""

import re
from collections.abc import Iterable, Sequence
from string import Formatter

from workflow.lib.load import NOT_STATIONARY, NOT_TESTED, UNDEFINED, Result
from workflow.lib.text import listed

FEW = 3  # runs that are named one by one
WARNINGS = {UNDEFINED: "Without a value", NOT_STATIONARY: "Not stationary"}
WARNINGS |= {NOT_TESTED: "Stationarity not tested, too few replicas"}


def fill(text: str, **numbers: str | None) -> str:
    """A text with named numbers, as "The slope is {slope}.", as one paragraph. Sentences without one of their
    numbers, which is then None, are left out."""
    missing = {name for name, number in numbers.items() if number is None}
    sentences = re.split(r"(?<=\.)\s+(?=[A-Z({])", " ".join(text.split()))
    names = {one: {name for _, name, *_ in Formatter().parse(one)} for one in sentences}
    return " ".join(one.format(**numbers) for one in sentences if not missing & names[one])


def quoted(names: Iterable[str]) -> str:
    """Names of runs or series as a list: `cold` and `warm`."""
    return listed(f"`{name}`" for name in names)


def warnings(results: Sequence[Result]) -> list[str]:
    """A sentence on results without a value, one on those that are not stationary, and one on those that were
    not tested. Panels with a point for each also cross them out."""
    sentences = []
    for warning, text in WARNINGS.items():
        if runs := [result.run for result in results if warning in result.warnings]:
            sentences.append(f"{text}: {quoted(runs) if len(runs) <= FEW else f'{len(runs)} runs'}.")
    return sentences
