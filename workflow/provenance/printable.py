"""Names and words that others chose, as they may be printed."""


def printable(text: str) -> str:
    """With escapes in place of the characters by which it would command a terminal."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)
