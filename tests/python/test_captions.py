"""Captions take their numbers from the data."""

import ast
import re
from collections.abc import Iterator

import numpy as np
import pytest

from tests.python.conftest import ROOT
from workflow.lib.caption import goodness, listed, number, parameters, replicas
from workflow.lib.load import Quantity, Result

SPEAKING = [*sorted((ROOT / "workflow/figures").glob("*.py")), ROOT / "workflow/lib/caption.py"]

# Numbers that do not depend on data: in names of figures, values of gamma and of ideal exponents, exact ends of an axis.
NAMES = re.compile(
    r"(?:figs?|ext|eq)\. \d+|(?:γ|gamma) = 1\b|σ [=≠] 0\b|α < 1\b|t = 0\b|\b[xp] = [01]\b|\b[124]/[2356]\b|\b1/N\b|\bminus 1\b"
)
NUMBER = re.compile(r"(?<![\w.^/])\d+(?:\.\d+)?")  # excludes digits within a symbol, as in T_1, chi^2 or λ/2t


def words(node: ast.AST) -> Iterator[str]:
    """String literals in the code of a function, without format specifications and docstrings."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    documented = isinstance(node, ast.FunctionDef) and ast.get_docstring(node)
    for name, field in ast.iter_fields(node):
        if name == "format_spec":
            continue
        children = field if isinstance(field, list) else [field]
        for child in children[1 if documented and name == "body" else 0 :]:
            if isinstance(child, ast.AST):
                yield from words(child)


def speaks(node: ast.AST) -> bool:
    """Whether a node is a function that returns a text, or the assignment of a text to the name `caption`."""
    if isinstance(node, ast.FunctionDef):
        return isinstance(node.returns, ast.Name) and node.returns.id == "str"
    names = node.targets if isinstance(node, ast.Assign) else []
    return any(isinstance(name, ast.Name) and name.id == "caption" for name in names)


def typed_numbers(source: str) -> set[str]:
    texts = [text for node in ast.walk(ast.parse(source)) if speaks(node) for text in words(node)]
    return {found for text in texts for found in NUMBER.findall(NAMES.sub("", text))}


@pytest.mark.parametrize("path", SPEAKING, ids=lambda path: path.stem)
def test_no_number_is_typed(path) -> None:
    assert typed_numbers(path.read_text()) == set()


def test_a_typed_number_is_found() -> None:
    said = 'def caption(x) -> str:\n    """In 3 words."""\n    return f"in fig. 8 at γ = 1 {x:.2f} of 0.33 and 64 replicas"'
    assert typed_numbers(said) == {"0.33", "64"}
    assert typed_numbers('caption = ("a" f"{x} of 7")') == {"7"}


def result(**options: object) -> Result:
    count = np.array([32, 64]) if "replicas" in options else None
    quantity = Quantity(np.zeros(2), None, None, count, {}, "1", {}, {}, None)
    return Result(ROOT, options, {}, {"a": quantity})


def test_words_of_parameters() -> None:
    runs = [result(sigma=sigma, gamma=gamma, replicas=2) for sigma, gamma in ((0.5, "N"), (-0.5, 1.0))]
    assert parameters(runs, "sigma", "gamma", "cells") == "σ = −1/2 and 1/2, γ = 1 and N"
    assert replicas([*runs, result(sigma=0.5)]) == "64 replicas"
    assert [number(value) for value in (-0.05, 100 / 3, 1100 / 9, 50000.0, 1 / 3, 2)] == [
        "−0.05",
        "100/3",
        "122.2",
        "50000",
        "1/3",
        "2",
    ]
    assert listed(["a"]) == "a"
    assert listed(["a", "b", "c"]) == "a, b and c"


def test_p_values_near_zero_are_bounds() -> None:
    assert goodness(12, 4) == "χ² = 12.0 for 4, p = 0.017"
    assert goodness(1e3, 4) == "χ² = 1000.0 for 4, p < 10⁻⁶"
    assert goodness(0.0, 0) == "no degree of freedom to test it"
