"""Whether two files of a drawing are equal but for rounding, which another processor's vector units may change.

What a file says of itself, its words and the order of what it draws must be the same. Numbers of a table may differ by
1e-9 of their size. Coordinates of a vector graphic may differ by a thousandth of a point: files hold six digits of a
point, and the smallest shift that can be seen is a hundred times larger. Of the pixels of a PNG one in 10000 may differ
by more than an eighth of the scale, where a line falls on the other side of a pixel's edge: a moved marker, of 150
pixels and more among 900 x 1000, changes twice that.
"""

import io
import re
from itertools import zip_longest
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pandas as pd
from PIL import Image
from pypdf import PdfReader
from pypdf.generic import ContentStream, DictionaryObject, IndirectObject, StreamObject

ROUNDING = 1e-9  # relative, of a number in a table
SHIFT = 1e-3  # points, of a coordinate
SHADE = 32  # of 255, of a pixel
SHARE = 1e-4  # of the pixels may differ by more
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
COORDINATES = {"d", "x", "y", "width", "height", "transform", "viewBox", "points"}  # attributes of SVG
SIZES = {"/Length", "/Length1"}  # of streams of a PDF
IDENTITY = re.compile(r"\b[a-z][0-9a-f]{10}\b")  # of markers and clips: a hash that rounding changes

Element = tuple[str, str, dict[str, str]]  # tag, text and attributes


def alike(one: Path, other: Path) -> bool:
    """False also where one of them cannot be read."""
    readers = {".csv": _tables, ".png": _pixels, ".svg": _vectors, ".pdf": _pages}
    try:
        return readers[one.suffix](one, other)
    except Exception:  # a hostile file may raise anything in the libraries that read it
        return False


def _tables(one: Path, other: Path) -> bool:
    (said, first), (also, second) = (_comments_and_rows(path) for path in (one, other))
    try:
        pd.testing.assert_frame_equal(first, second, rtol=ROUNDING, atol=0)
    except AssertionError:
        return False
    return said == also


def _comments_and_rows(path: Path) -> tuple[list[str], pd.DataFrame]:
    lines = path.read_text("utf-8").splitlines(keepends=True)
    rows = [line for line in lines if not line.startswith("#")]
    return [line for line in lines if line.startswith("#")], pd.read_csv(io.StringIO("".join(rows)))


def _pixels(one: Path, other: Path) -> bool:
    pictures, words = [], []
    for path in (one, other):
        with Image.open(path, formats=["PNG"]) as picture:
            pictures.append(np.asarray(picture.convert("RGBA"), dtype=np.int16))
            words.append((picture.mode, picture.info))
    if words[0] != words[1] or pictures[0].shape != pictures[1].shape:
        return False
    changed = np.abs(pictures[0] - pictures[1]).max(axis=2) > SHADE
    return bool(changed.mean() <= SHARE)


def _vectors(one: Path, other: Path) -> bool:
    first, second = (_elements(path) for path in (one, other))
    # What stands above the tree may name a style sheet.
    prologues = [path.read_text("utf-8").partition("<svg")[0] for path in (one, other)]
    return prologues[0] == prologues[1] and all(
        a is not None and b is not None and _same_element(a, b) for a, b in zip_longest(first, second)
    )


def _elements(path: Path) -> list[Element]:
    """In the order of the file; identities are numbered as they come."""
    order: dict[str, str] = {}

    def numbered(text: str | None) -> str:
        return IDENTITY.sub(lambda found: order.setdefault(found[0], f"#{len(order)}"), text or "")

    return [
        (
            element.tag,
            f"{element.text or ''}|{element.tail or ''}",
            {key: numbered(value) for key, value in element.attrib.items()},
        )
        for element in ElementTree.parse(path).iter()
    ]


def _same_element(one: Element, other: Element) -> bool:
    if one[:2] != other[:2] or one[2].keys() != other[2].keys():
        return False
    return all(
        _same_coordinates(value, other[2][key]) if key in COORDINATES else value == other[2][key]
        for key, value in one[2].items()
    )


def _same_coordinates(one: str, other: str) -> bool:
    first, second = (np.array(NUMBER.findall(text), dtype=float) for text in (one, other))
    same_words = NUMBER.sub("0", one) == NUMBER.sub("0", other)
    return same_words and bool(np.all(np.abs(first - second) <= SHIFT))


def _pages(one: Path, other: Path) -> bool:
    first, second = (PdfReader(path) for path in (one, other))
    if first.metadata is None or second.metadata is None:
        return False
    return _same_object(first.trailer["/Root"], second.trailer["/Root"], set()) and (
        dict(first.metadata) == dict(second.metadata)
    )


def _same_object(one: Any, other: Any, seen: set[int]) -> bool:
    """Of two PDF files, with all that the objects refer to."""
    if isinstance(one, IndirectObject) and isinstance(other, IndirectObject):
        if one.idnum in seen:
            return True
        seen.add(one.idnum)
        return _same_object(one.get_object(), other.get_object(), seen)
    if isinstance(one, float | int) and isinstance(other, float | int):
        return abs(float(one) - float(other)) <= SHIFT
    if isinstance(one, DictionaryObject) and isinstance(other, DictionaryObject):
        names = one.keys() - SIZES
        same = names == other.keys() - SIZES and all(
            _same_object(one.raw_get(name), other.raw_get(name), seen) for name in names
        )
        return same and _same_stream(one, other, seen)
    if isinstance(one, list | tuple) and isinstance(other, list | tuple):
        return len(one) == len(other) and all(
            _same_object(a, b, seen) for a, b in zip(one, other, strict=True)
        )
    return type(one) is type(other) and bool(one == other)


def _same_stream(one: Any, other: Any, seen: set[int]) -> bool:
    """What dictionaries hold beside their entries: drawings may differ by rounding, all else must be the same."""
    if not isinstance(one, StreamObject) or not isinstance(other, StreamObject):
        return not isinstance(one, StreamObject) and not isinstance(other, StreamObject)
    if one.get_data() == other.get_data():
        return True
    first, second = (ContentStream(stream, None).operations for stream in (one, other))
    return one.get("/Subtype") in (None, "/Form") and _same_object(first, second, seen)
