"""The tracked files state what the programs declare; a new option or quantity gets there by `make describe`."""

import json
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from tests.python.conftest import ROOT
from workflow.config import describe


@pytest.fixture(scope="module")
def described() -> describe.Described:
    return describe.descriptions(ROOT / "build/bin")


def test_the_tracked_files_are_up_to_date(described: describe.Described) -> None:
    stale = [path.name for path, text in describe.texts(described).items() if path.read_text() != text]
    assert stale == [], "run `make describe`"


def test_the_schema_of_an_option_is_valid_and_accepts_the_default(described: describe.Described) -> None:
    for name, program in described.items():
        for option in program["options"]:
            schema = describe.schema(option)
            Draft202012Validator.check_schema(schema)
            assert Draft202012Validator(schema).is_valid(option["default"]), (name, option)


@pytest.mark.parametrize(
    ("option", "accepted", "refused"),
    [
        ({"type": "integer", "minimum": 1}, [1, 7], [0, 1.5, True, "1"]),
        ({"type": "number", "minimum": -1.0, "maximum": 1.0}, [-1, 0.5], [2, "0.5", True]),
        ({"type": "number or word", "exclusive_minimum": 0.0, "word": "1/N"}, [1, "1/N"], [0, "N", "1", "11/N"]),
        ({"type": "numbers", "exclusive_minimum": 0.0}, [1, "0.1,2e-3,.5"], [0, "1,", "-1,2", "1;2", ""]),
        ({"type": "numbers"}, ["-1,2"], ["--1"]),
        ({"type": "number or polynomial in N", "minimum": 0.0}, [3, "3", "0.05N", "50+1e-3N^2", "1+2N"],
         [-1, "N", "-2N", "2N^3", "1/N", "1+-2N", "1e+N"]),
        ({"type": "choice", "choices": ["warm", "cold"]}, ["warm"], ["tepid", True]),
        ({"type": "flag"}, [True, False], ["yes", 1]),
        ({"type": "text"}, ["a"], [1]),
    ],
)  # fmt: skip
def test_values_of_an_option(option: dict[str, Any], accepted: list[object], refused: list[object]) -> None:
    validator = Draft202012Validator(describe.schema(option | {"units": "1"}))
    assert [value for value in accepted if not validator.is_valid(value)] == []
    assert [value for value in refused if validator.is_valid(value)] == []


def test_a_new_option_and_quantity(described: describe.Described) -> None:
    new = deepcopy(described)
    option = {"name": "colour", "type": "choice", "choices": ["red", "blue"], "default": "red"}
    new["persistence"]["options"].append(option | {"description": "Of |it|", "affects_results": True})
    axis = {"name": "cell", "units": "length", "description": "Where", "size": 3}
    quantity = {"name": "hue", "units": "1/time", "description": "How", "axes": [axis]}
    new["persistence"]["quantities"].append(quantity)
    new["persistence"]["always"].append("hue")
    texts = describe.texts(new)

    options = json.loads(texts[describe.SCHEMA])["programs"]
    assert options["persistence"]["colour"] == {"enum": ["red", "blue"], "allowed": "red or blue"}
    assert "colour" not in options["ageing"]
    assert "|  | `--colour` | red or blue | red |  | Of \\|it\\| |" in texts[describe.FORMAT]
    assert "|  | `hue` [cell] | 1/time | How |" in texts[describe.FORMAT]

    def complaints(quantities: dict[str, str]) -> list[str]:
        rules = {"allOf": json.loads(texts[describe.FORMAT_SCHEMA])["allOf"]}
        file = {"program": "persistence", "quantities": quantities}
        return [error.message for error in Draft202012Validator(rules).iter_errors(file)]

    right = dict.fromkeys(("mu", "energy_drift", "momentum_drift"), "1")
    right |= dict.fromkeys(("particle_energy", "scatterer_energy"), "energy")
    assert complaints(right | {"hue": "1/time [cell in length]"}) == []
    assert complaints(right) == ["'hue' is a required property"]
    assert complaints(right | {"hue": "1/time"}) == ["'1/time [cell in length]' was expected"]
    assert "unexpected" in complaints(right | {"hue": "1/time [cell in length]", "shade": "1"})[0]


def test_a_quantity_of_some_chains_only(described: describe.Described) -> None:
    displacement = described["displacement"]
    assert "logarithmic_power" in [quantity["name"] for quantity in displacement["quantities"]]
    assert "logarithmic_power" not in displacement["always"]
    assert "alpha" in displacement["always"]


def test_a_table_without_its_marks(
    described: describe.Described, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(describe, "FORMAT", tmp_path / "format.md")
    describe.FORMAT.write_text("<!-- options, by make describe -->\n")
    with pytest.raises(
        ValueError, match="lacks '<!-- options, by make describe -->' or '<!-- end of options -->'"
    ):
        describe.texts(described)
