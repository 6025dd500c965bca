"""Suggested names in error messages."""

from collections.abc import Iterable
from difflib import get_close_matches


def suggestion(name: str, names: Iterable[str]) -> str:
    """`did you mean fig05?`, all names that begin so, or a list of all names if none is similar."""
    known = [*names]
    words = name.replace(",", " ").split()  # names are separated by spaces
    begin = {
        word: [word] if word in known else [one for one in known if one.startswith(word)] for word in words
    }
    similar = [" or ".join(begin[word] or get_close_matches(word, known, 1)) for word in words]
    return (
        f"did you mean {' '.join(similar)}?"
        if all(similar) and words
        else f"choose one of {', '.join(known)}"
    )
