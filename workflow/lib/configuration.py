"""paper.yaml and quality/*.yaml as they are read: checked against schema.yaml, which says what they may hold."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator

from workflow.lib.options import Options, admissible, admits
from workflow.lib.strict_yaml import ConfigurationError, Document, nearest, read

__all__ = ["Admissible", "ConfigurationError", "load_checked", "nearest", "paper_schema", "quality_schema"]

FOLDER = Path(__file__).parents[1] / "config"


@dataclass(frozen=True)
class Admissible:
    """Options that the configuration may give, by program. A place is `paper.yaml: panels.fig05.common`."""

    programs: dict[str, dict[str, dict[str, Any]]]
    effort: tuple[str, ...]
    not_physics: tuple[str, ...]
    folder: Path

    @classmethod
    def of(cls, folder: Path) -> "Admissible":
        """Raises ConfigurationError."""
        return cls(**load_checked(folder / "schema.yaml", admissible_schema()), folder=folder)

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
            hint = "" if program is None else nearest(program, self.programs)
            allowed = ", ".join(self.programs)
            text = f"{missing}{hint} (allowed: {allowed}; `make describe` adds new ones)"
            raise self._complaint(place, text)

    def _check(self, program: str, options: Options, names: list[str], place: str) -> None:
        for name, given in options.items():
            here = f"{place}.{name}"
            if name not in names:
                text = (
                    f"{program} has no such option here{nearest(name, names)} (allowed: {', '.join(names)})"
                )
                raise self._complaint(here, text, given)
            if isinstance(given, list):
                if not given or any(given.count(value) > 1 for value in given):
                    text = "the list is empty or repeats a value (allowed: different ones)"
                    raise self._complaint(here, text, given)
                for i, value in enumerate(given):
                    self._check_value(program, name, value, f"{here}.{i}")
            else:
                self._check_value(program, name, given, here)

    def _check_value(self, program: str, name: str, value: object, place: str) -> None:
        option = self.programs[program][name]
        if not admits(option, value):
            text = f"{program} does not accept it (allowed: {admissible(option)})"
            raise self._complaint(place, text, value)

    def _complaint(self, place: str, text: str, value: object = None) -> ConfigurationError:
        """With line and column, for which the file is read once more."""
        name, _, keys = place.partition(": ")
        path = self.folder / name if name == "paper.yaml" else self.folder / "quality" / name
        return read(path).complaint(keys.split("."), text, "" if value is None else json.dumps(value))


def load_checked(path: Path, schema: dict[str, Any]) -> dict[str, Any]:
    """Raises ConfigurationError."""
    document = read(path)
    errors = sorted(
        Draft202012Validator(schema).iter_errors(document.content),
        key=lambda error: len(error.absolute_path),
    )
    if errors:
        deepest = errors[-1]
        while deepest.context:  # of the alternatives, the last is a list of values
            deepest = max(deepest.context, key=lambda error: len(error.absolute_path))
        raise _complaint(document, deepest)
    content: dict[str, Any] = document.content
    return content


def _complaint(document: Document, error: Any) -> ConfigurationError:
    keys = [str(part) for part in error.absolute_path]
    if error.validator == "additionalProperties":
        known = [*error.schema["properties"]]
        name = next(name for name in error.instance if name not in known)
        text = f"there is no such key here{nearest(name, known)} (allowed: {', '.join(known)})"
        return document.complaint([*keys, name], text)
    limits = {
        name: error.schema[name]
        for name in ("type", "minimum", "exclusiveMinimum", "maximum", "enum", "const", "pattern")
        if isinstance(error.schema, dict) and name in error.schema
    }
    allowed = ", ".join(f"{name} {value}" for name, value in limits.items())
    plain = not isinstance(error.instance, (dict, list))
    text = error.message + (f" (allowed: {allowed})" if allowed else "")
    return document.complaint(keys, text, json.dumps(error.instance) if plain else "")


def admissible_schema() -> dict[str, Any]:
    """Of schema.yaml itself."""
    number, text = {"type": "number"}, {"type": "string"}
    texts = {"type": "array", "items": text}
    option = _object(
        {name: number for name in ("minimum", "exclusive_minimum", "maximum")}
        | {"type": text, "word": text, "units": text, "choices": texts},
        required=("type",),
    )
    options = {"type": "object", "additionalProperties": option}
    properties = {"effort": texts, "not_physics": texts}
    properties["programs"] = {"type": "object", "additionalProperties": options}
    return _object(properties, required=tuple(properties))


def paper_schema() -> dict[str, Any]:
    """Without the options, which depend on the program."""
    program = {"type": "string"}
    series = {"type": "object", "properties": {"program": program, "replicated": {"type": "boolean"}}}
    panel = _object(
        {
            "program": program,
            "script": {"type": "string", "pattern": "^[a-z0-9_]+$"},
            "uses": {"type": "array", "items": {"type": "string"}, "minItems": 1, "uniqueItems": True},
            "common": {"type": "object"},
            "series": _named(series),
        }
    )
    panel["anyOf"] = [{"required": ["series"]}, {"required": ["uses"]}]
    return _object({"panels": _named(panel)}, required=("panels",))


def quality_schema(paper: dict[str, Any]) -> dict[str, Any]:
    """The panels and series of the paper, without the options."""
    effort = {"type": "object"}
    panels = {
        name: _object({series: effort for series in panel.get("series", {})})
        for name, panel in paper["panels"].items()
    }
    return _object({"default": effort, "panels": _object(panels)}, required=("default",))


def _object(properties: dict[str, Any], required: tuple[str, ...] = ()) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": properties,
        "required": list(required),
        "additionalProperties": False,
    }


def _named(values: dict[str, Any]) -> dict[str, Any]:
    """A mapping from names, which become parts of file names, to values."""
    return {
        "type": "object",
        "propertyNames": {"pattern": "^[A-Za-z0-9-]+(_[A-Za-z0-9-]+)*$"},
        "additionalProperties": values,
        "minProperties": 1,
    }
