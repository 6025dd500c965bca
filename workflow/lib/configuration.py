"""paper.yaml and quality/*.yaml as they are read: checked against schema.yaml, which says what they may hold."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from jsonschema import Draft202012Validator

from workflow.lib.options import Options, admissible, admits


class ConfigurationError(ValueError):
    """The configuration cannot be used; the message names file, key, value and what is allowed."""


@dataclass(frozen=True)
class Admissible:
    """Options that the configuration may give, by program."""

    programs: dict[str, dict[str, dict]]
    effort: tuple[str, ...]
    not_physics: tuple[str, ...]

    @classmethod
    def of(cls, folder: Path) -> "Admissible":
        return cls(**yaml.safe_load((folder / "schema.yaml").read_text()))

    def check_physics(self, program: str, options: Options, place: str) -> None:
        names = [name for name in self.programs[program] if name not in self.not_physics]
        self._check(program, options, names, place)

    def check_effort(self, program: str, options: Options, place: str) -> None:
        """No replicas leave a series out."""
        names = [name for name in self.programs[program] if name in self.effort]
        given = {name: value for name, value in options.items() if (name, value) != ("replicas", 0)}
        self._check(program, given, names, place)

    def check_program(self, program: str | None, place: str) -> None:
        if program not in self.programs:
            missing = "program is missing" if program is None else f"there is no program {program}"
            allowed = ", ".join(self.programs)
            raise ConfigurationError(
                f"{place}: {missing} (allowed: {allowed}; `make describe` adds new ones)"
            )

    def _check(self, program: str, options: Options, names: list[str], place: str) -> None:
        for name, given in options.items():
            here = f"{place}.{name}"
            if name not in names:
                raise ConfigurationError(
                    f"{here}: {program} has no such option here (allowed: {', '.join(names)})"
                )
            if isinstance(given, list):
                if not given or any(given.count(value) > 1 for value in given):
                    raise ConfigurationError(
                        f"{here}: the list is empty or repeats a value (allowed: different ones)"
                    )
                for i, value in enumerate(given):
                    self._check_value(program, name, value, f"{here}.{i}")
            else:
                self._check_value(program, name, given, here)

    def _check_value(self, program: str, name: str, value: object, place: str) -> None:
        option = self.programs[program][name]
        if not admits(option, value):
            raise ConfigurationError(
                f"{place} = {json.dumps(value, default=str)}: {program} does not accept it "
                f"(allowed: {admissible(option)})"
            )


def load_checked(path: Path, schema: dict) -> dict:
    """Raises ConfigurationError."""
    try:
        content = yaml.safe_load(path.read_text())
    except FileNotFoundError as error:
        raise ConfigurationError(f"{path.name} is missing") from error
    except yaml.YAMLError as error:
        raise ConfigurationError(f"{path.name} is not valid YAML: {error}") from error
    errors = sorted(
        Draft202012Validator(schema).iter_errors(content), key=lambda error: len(error.absolute_path)
    )
    if errors:
        deepest = errors[-1]
        while deepest.context:  # of the alternatives, the last is a list of values
            deepest = max(deepest.context, key=lambda error: len(error.absolute_path))
        raise ConfigurationError(_complaint(path, deepest))
    return content


def _complaint(path: Path, error: Any) -> str:
    key = ".".join(str(part) for part in error.absolute_path) or "the whole file"
    limits = {
        name: error.schema[name]
        for name in ("type", "minimum", "exclusiveMinimum", "maximum", "enum", "const", "pattern")
        if isinstance(error.schema, dict) and name in error.schema
    }
    allowed = ", ".join(f"{name} {value}" for name, value in limits.items())
    value = f" = {json.dumps(error.instance)}" if not isinstance(error.instance, (dict, list)) else ""
    return f"{path.name}: {key}{value}: {error.message}" + (f" (allowed: {allowed})" if allowed else "")


def paper_schema() -> dict:
    """Without the options, which depend on the program."""
    program = {"type": "string"}
    series = {"type": "object", "properties": {"program": program, "replicated": {"type": "boolean"}}}
    panel = _object(
        {
            "program": program,
            "script": {"type": "string", "pattern": "^[a-z0-9_]+$"},
            "uses": {"type": "array", "items": {"type": "string"}, "minItems": 1},
            "common": {"type": "object"},
            "series": _named(series),
        }
    )
    panel["anyOf"] = [{"required": ["series"]}, {"required": ["uses"]}]
    return _object({"panels": _named(panel)}, required=("panels",))


def quality_schema(paper: dict) -> dict:
    """The panels and series of the paper, without the options."""
    effort = {"type": "object"}
    panels = {
        name: _object({series: effort for series in panel.get("series", {})})
        for name, panel in paper["panels"].items()
    }
    return _object({"default": effort, "panels": _object(panels)}, required=("default",))


def _object(properties: dict, required: tuple[str, ...] = ()) -> dict:
    return {
        "type": "object",
        "properties": properties,
        "required": list(required),
        "additionalProperties": False,
    }


def _named(values: dict) -> dict:
    """A mapping from names, which become parts of file names, to values."""
    return {
        "type": "object",
        "propertyNames": {"pattern": "^[A-Za-z0-9-]+(_[A-Za-z0-9-]+)*$"},
        "additionalProperties": values,
        "minProperties": 1,
    }
