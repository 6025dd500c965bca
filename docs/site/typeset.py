"""Hook of MkDocs: indices after _ and powers after ^ in the text of a page, as on T_0 and e^(-t)."""

import re
from typing import Any

SKIPPED = re.compile(
    r"(<(?:code|pre|script|style|svg)\b.*?</(?:code|pre|script|style|svg)>|<div class=\"arithmatex\">.*?</div>|<span class=\"arithmatex\">.*?</span>|<[^>]*>)",
    re.DOTALL,
)
INDEX = re.compile(r"(?<!\w)([^\W\d_]{1,2}|\))_(?:\{([^}]*)\}|(\w{1,2})\b)")
POWER = re.compile(r"(?<=[\w)⟩])\^(?:\(([^)]*)\)|\{([^}]*)\}|([-−]?\w+(?:/\d+)?))")


def typeset(text: str) -> str:
    text = INDEX.sub(lambda found: f"{found[1]}<sub>{found[2] or found[3]}</sub>", text)
    return POWER.sub(lambda found: f"<sup>{found[1] or found[2] or found[3]}</sup>", text)


def on_page_content(html: str, **_: Any) -> str:
    parts = SKIPPED.split(html)  # text at even positions
    return "".join(part if number % 2 else typeset(part) for number, part in enumerate(parts))
