"""What the programs declare: JSON Schema of their options, by which the configuration is checked."""

import pytest
from jsonschema import Draft202012Validator

from workflow.lib.described import declared, described, with_option


@pytest.mark.parametrize("program", described())
def test_the_schema_of_every_option_is_valid_and_accepts_the_default(program: str) -> None:
    stated = described()[program]
    assert stated["program"] == program
    Draft202012Validator.check_schema(stated["options"])
    defaults = {name: schema["default"] for name, schema in stated["options"]["properties"].items()}
    assert Draft202012Validator(stated["options"]).is_valid(defaults)
    assert not Draft202012Validator(stated["options"]).is_valid({"other": 1})
    assert all(schema["allowed"] for schema in stated["options"]["properties"].values())


@pytest.mark.parametrize(
    ("program", "name", "accepted", "refused"),
    [
        ("ageing", "cells", [1, 7], [0, 1.5, True, "1"]),
        ("ageing", "sigma", [-1, 0.5], [2, "0.5", True]),
        ("ageing", "temperature", [1e-30, 1], [0, 1e31]),
        ("ageing", "relaxation-time", [0, 1e30], [-1]),
        ("conductivity", "cell-length", [1, "1/N"], [0, "N", "1", "11/N"]),
        ("boltzmann", "cells", [4, "continuum"], [0, 2.5, "N"]),
        ("correlation", "times", [1, "0.1,2e-3,.5"], [0, "1,", "1;2", "--1", ""]),
        ("conductivity", "start", ["warm"], ["tepid", True]),
        ("ageing", "zero-total-momentum", [True, False], ["yes", 1]),
    ],
)
def test_values_of_an_option(program: str, name: str, accepted: list[object], refused: list[object]) -> None:
    validator = Draft202012Validator(declared()[program][name])
    assert [value for value in accepted if not validator.is_valid(value)] == []
    assert [value for value in refused if validator.is_valid(value)] == []


def test_options_that_determine_no_result_are_left_out() -> None:
    assert "threads" in described()["ageing"]["options"]["properties"]
    assert "threads" not in declared()["ageing"]
    assert set(described()) - set(with_option("replicas")) == {"boltzmann"}
