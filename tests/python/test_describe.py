"""What the programs say of themselves is what the tracked files state; a new option or quantity gets there by itself."""

import json
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest
import yaml
from jsonschema import Draft202012Validator

from tests.python.conftest import ROOT
from workflow.config import describe
from workflow.lib.options import admits
from workflow.lib.strict_yaml import ConfigurationError


@pytest.fixture(scope="module")
def described() -> dict[str, dict[str, Any]]:
    return describe.descriptions(ROOT / "build/bin")


def test_the_tracked_files_are_up_to_date(described: dict[str, dict[str, Any]]) -> None:
    stale = [path.name for path, text in describe.texts(described).items() if path.read_text() != text]
    assert stale == [], "run `make describe`"


def test_every_default_is_admitted(described: dict[str, dict[str, Any]]) -> None:
    for name, program in described.items():
        for option in program["options"]:
            assert admits(option, option["default"]), (name, option)


def test_a_new_option_and_quantity(described: dict[str, dict[str, Any]]) -> None:
    new = deepcopy(described)
    option = {"name": "colour", "type": "choice", "choices": ["red", "blue"], "default": "red"}
    new["persistence"]["options"].append(option | {"description": "Of |it|", "affects_results": True})
    axis = {"name": "cell", "units": "length", "description": "Where", "size": 3}
    quantity = {"name": "hue", "units": "1/time", "description": "How", "axes": [axis]}
    new["persistence"]["quantities"].append(quantity)
    new["persistence"]["always"].append("hue")
    texts = describe.texts(new)

    options = yaml.safe_load(texts[describe.SCHEMA])["programs"]
    assert options["persistence"]["colour"] == {"type": "choice", "choices": ["red", "blue"]}
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


def test_a_quantity_of_some_chains_only(described: dict[str, dict[str, Any]]) -> None:
    displacement = described["displacement"]
    assert "logarithmic_power" in [quantity["name"] for quantity in displacement["quantities"]]
    assert "logarithmic_power" not in displacement["always"]
    assert "alpha" in displacement["always"]


@pytest.mark.parametrize(
    ("file", "mark"),
    [
        ("SCHEMA", "programs:"),
        ("FORMAT", "<!-- options, by make describe -->"),
        ("FORMAT", "<!-- end of quantities -->"),
    ],
)
def test_a_place_that_is_missing_is_named(
    described: dict[str, dict[str, Any]],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    file: str,
    mark: str,
) -> None:
    damaged = tmp_path / "damaged"
    damaged.write_text(getattr(describe, file).read_text().replace(mark, ""))
    monkeypatch.setattr(describe, file, damaged)
    monkeypatch.setattr(describe, "ROOT", tmp_path)
    with pytest.raises(ConfigurationError, match=r"damaged has no .*restore"):
        describe.texts(described)
