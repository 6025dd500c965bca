"""Identity in a name: the first digits of a hash of everything that determines a product."""

import hashlib
import json
from typing import Any

DIGITS = 12  # 48 bits: two of a million names are equal with a probability of 0.2 %
IDENTITY = f"[0-9a-f]{{{DIGITS}}}"  # regular expression of an identity


def identity(*parts: Any) -> str:
    """First digits of the sha256 of the parts, values of JSON. Equal numbers count as equal: 8 and 8.0."""
    content = json.dumps([_canonical(part) for part in parts], sort_keys=True)
    return hashlib.sha256(content.encode()).hexdigest()[:DIGITS]


def seed_of(text: str) -> int:
    """Seed from a hash of names, which gives every run its own reproducible random streams."""
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "big")


def _canonical(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _canonical(element) for key, element in value.items()}
    if isinstance(value, list | tuple):
        return [_canonical(element) for element in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value
