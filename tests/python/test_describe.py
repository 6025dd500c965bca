"""What the programs declare: JSON Schema of their options, by which the configuration is checked."""

import pytest
from jsonschema import Draft202012Validator

from workflow.pipeline.described import described


@pytest.mark.parametrize("program", described())
def test_the_schema_of_every_option_is_valid_and_accepts_the_default(program: str) -> None:
    options = described()[program]["options"]
    Draft202012Validator.check_schema(options)
    defaults = {name: one["default"] for name, one in options["properties"].items() if "default" in one}
    assert {*options["properties"]} - {*defaults} <= {"seed"}
    assert Draft202012Validator(options).is_valid(defaults)
    assert not Draft202012Validator(options).is_valid({"other": 1})
    assert all(schema["allowed"] for schema in options["properties"].values())
