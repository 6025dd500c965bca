"""Suggested names in error messages."""

from collections.abc import Iterable
from difflib import get_close_matches


def suggestion(name: str, names: Iterable[str]) -> str:
    """`did you mean fig05?`, or a list of all names if none is similar."""
    known = [*names]
    similar = get_close_matches(name, known, 1)
    return f"did you mean {similar[0]}?" if similar else f"choose one of {', '.join(known)}"
