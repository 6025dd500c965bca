"""Captions take their numbers from the data."""

import ast
import re
from collections.abc import Iterator

import numpy as np
import pandas as pd
import pytest

from tests.python.conftest import ROOT
from workflow.figures.ext02 import definitions, glide, local, otherwise
from workflow.lib.caption import goodness, listed, number, parameters, replicas
from workflow.lib.load import Quantity, Result

SPEAKING = [*sorted((ROOT / "workflow/figures").glob("*.py")), ROOT / "workflow/lib/caption.py"]

# Numbers that no data could give: names of figures, the values of gamma and of ideal exponents, exact ends of an axis.
NAMES = re.compile(
    r"(?:figs?|ext|eq)\. \d+|(?:γ|gamma) = 1\b|σ = 0\b|\b[xp] = [01]\b|\b[12]/[2356]\b|\b1/N\b|\bminus 1\b"
)
NUMBER = re.compile(r"(?<![\w.^/])\d+(?:\.\d+)?")  # none within a symbol, as in T_1, chi^2 or λ/2t


def words(node: ast.AST) -> Iterator[str]:
    """Texts, but for formats and documentation."""
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
    """A function that returns a text, or a text that is called a caption."""
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
    assert [number(value) for value in (-0.05, 100 / 3, 50000.0, 1 / 3, 2)] == [
        "−0.05",
        "100/3",
        "50000",
        "1/3",
        "2",
    ]
    assert listed(["a"]) == "a"
    assert listed(["a", "b", "c"]) == "a, b and c"


def test_p_values_near_zero_are_bounds() -> None:
    assert goodness(12, 4) == "χ² = 12.0 for 4, p = 0.017"
    assert goodness(1e3, 4) == "χ² = 1000.0 for 4, p < 1e-06"
    assert goodness(0.0, 0) == "no degree of freedom to test it"


@pytest.mark.parametrize(
    ("change", "verb"), [(0.02, "rises"), (-0.02, "falls"), (0.002, "has no steady trend")]
)
def test_a_change_is_named_beyond_three_errors(change: float, verb: str) -> None:
    """Errors of 1 %, from which the ends alone would not tell: 0.36(2) and 0.45(2) where it rises."""
    kappa = growing(change)
    part = pd.DataFrame({"cells": 16 * 2.0 ** np.arange(8)})
    for name in ("kappa", "kappa_particle", "kappa_baths"):
        part[name], part[f"{name}_error"] = kappa, 0.01 * kappa
    said = glide(part, local(part))
    assert said.startswith(f"{verb}, from {0.3 + change * np.log(16 * np.sqrt(2)):.3f}(20) about N = 23 to ")


def growing(change: float) -> np.ndarray:
    """At sizes from 16 on, with an exponent that changes with the logarithm of the size."""
    size = np.log(16 * 2.0 ** np.arange(8))
    return np.exp(0.3 * size + change / 2 * size**2)


def test_another_definition_with_another_trend_is_told() -> None:
    part = pd.DataFrame({"cells": 16 * 2.0 ** np.arange(8), "gas": "dense"})
    for name, change in (("kappa", 0.02), ("kappa_particle", 0.03), ("kappa_baths", -0.02)):
        part[name] = growing(change)
        part[f"{name}_error"] = 0.01 * part[name]
    assert otherwise(part, {"dense": "0.1"}) == "; at spacing 0.1 with those of the baths it falls"
    part["kappa_baths"] = part.kappa
    assert otherwise(part, {"dense": "0.1"}) == ""


def test_what_a_definition_changes_is_told_at_both_ends() -> None:
    found = pd.DataFrame({"size": [23.0, 90.0], "exponent": [0.3, 0.3]})
    found["exponent_particle"], found["exponent_baths"] = [0.35, 0.28], [0.2, 0.31]
    assert definitions(found) == "0.10 about N = 23 and 0.02 about N = 90"
