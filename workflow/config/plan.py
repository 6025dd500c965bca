"""What the configuration asks for: panels, and the runs of a program that each panel needs."""

import hashlib
import itertools
import json
import shlex
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from jsonschema import Draft202012Validator

FOLDER = Path(__file__).parent
KINDS = ("pdf", "png", "svg", "csv")
QUALITIES = ("smoke", "standard", "paper", "deep")

Options = dict[str, Any]


class ConfigurationError(ValueError):
    """The configuration cannot be used; the message names file, key, value and what is allowed."""


@dataclass(frozen=True)
class Run:
    """One execution of a program; its name is unique within the panel."""

    name: str
    program: str
    options: Options
    replicated: bool = True  # over independent replicas, as opposed to computed once

    def arguments(self) -> str:
        """The options as they stand on the command line."""
        given = {key: value for key, value in self.options.items() if value is not False}
        return " ".join(
            f"--{key}" if value is True else f"--{key} {shlex.quote(str(value))}"
            for key, value in given.items()
        )


@dataclass(frozen=True)
class Panel:
    """A figure: its own runs, and the names of the panels whose runs it shows as well."""

    name: str
    script: str
    runs: tuple[Run, ...]
    uses: tuple[str, ...] = ()

    def run(self, name: str) -> Run:
        return next(run for run in self.runs if run.name == name)

    def hash(self) -> str:
        """sha256 of everything that the configuration says of the panel, effort included."""
        runs = [[run.name, run.program, run.options] for run in self.runs]
        content = [self.name, self.script, runs, self.uses]
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def load_plan(quality: str, folder: Path = FOLDER) -> dict[str, Panel]:
    """All panels at one quality, by name. Raises ConfigurationError."""
    if quality not in QUALITIES:
        raise ConfigurationError(f"QUALITY={quality} is not known: choose one of {', '.join(QUALITIES)}.")
    options = yaml.safe_load((folder / "schema.yaml").read_text())["$defs"]
    paper = _load(folder / "paper.yaml", _paper_schema(options))
    efforts = _load(folder / "quality" / f"{quality}.yaml", _quality_schema(options, paper))
    panels = {name: _panel(name, panel, efforts) for name, panel in paper["panels"].items()}
    for panel in panels.values():
        for used in panel.uses:
            if used not in panels or not panels[used].runs:
                raise ConfigurationError(f"paper.yaml: panels.{panel.name}.uses: {used} has no runs")
    return panels


def with_used(plan: dict[str, Panel], name: str) -> list[Panel]:
    """The panels whose runs a panel shows: those that it uses, then itself."""
    return [plan[one] for one in (*plan[name].uses, name)]


def data_path(quality: str, panel: str, run: str) -> str:
    return f"data/{quality}/{panel}/{run}.h5"


def data_of(plan: dict[str, Panel], name: str, quality: str) -> list[str]:
    """Paths of the results that a panel shows."""
    return [data_path(quality, panel.name, run.name) for panel in with_used(plan, name) for run in panel.runs]


def drawings_of(quality: str, panel: str) -> list[str]:
    return [f"figures/{quality}/{panel}.{kind}" for kind in KINDS]


def _panel(name: str, panel: dict, efforts: dict) -> Panel:
    runs = []
    for series, own in panel.get("series", {}).items():
        replicated = own.get("replicated", True)
        effort = efforts.get("panels", {}).get(name, {}).get(series, {})
        options = {**panel.get("common", {}), **own, **(efforts["default"] if replicated else {}), **effort}
        options.pop("replicated", None)
        if options.get("replicas") == 0:
            continue
        program = options.pop("program", panel.get("program"))
        if program is None:
            raise ConfigurationError(f"paper.yaml: panels.{name}.series.{series}: program is missing")
        listed = [key for key, value in options.items() if isinstance(value, list)]
        for values in itertools.product(*(options[key] for key in listed)):
            chosen = dict(zip(listed, values, strict=True))
            run = "_".join([series, *(f"{key}={value}" for key, value in chosen.items())])
            seed = {"seed": _seed(name, run)} if replicated else {}
            runs.append(Run(run, program, {**options, **chosen, **seed}, replicated))
    return Panel(name, panel.get("script", name), tuple(runs), tuple(panel.get("uses", ())))


def _seed(panel: str, run: str) -> int:
    """Every run has random streams of its own; its name fixes them."""
    return int.from_bytes(hashlib.sha256(f"{panel}/{run}".encode()).digest()[:4], "big")


def _load(path: Path, schema: dict) -> dict:
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


def _one_or_list(options: dict) -> dict:
    return {
        key: {"anyOf": [schema, {"type": "array", "minItems": 1, "uniqueItems": True, "items": schema}]}
        for key, schema in options.items()
    }


def _paper_schema(options: dict) -> dict:
    physics = _one_or_list(options["physics"])
    program = {"type": "string", "pattern": "^[a-z_]+$"}
    panel = _object(
        {
            "program": program,
            "script": {"type": "string", "pattern": "^[a-z0-9_]+$"},
            "uses": {"type": "array", "items": {"type": "string"}, "minItems": 1},
            "common": _object(physics),
            "series": _named(_object({"program": program, "replicated": {"type": "boolean"}, **physics})),
        }
    )
    panel["anyOf"] = [{"required": ["series"]}, {"required": ["uses"]}]
    return {**_object({"panels": _named(panel)}, required=("panels",)), "$defs": options}


def _quality_schema(options: dict, paper: dict) -> dict:
    effort = _object(_one_or_list(options["effort"]))
    panels = {
        name: _object({series: effort for series in panel.get("series", {})})
        for name, panel in paper["panels"].items()
    }
    schema = _object({"default": effort, "panels": _object(panels)}, required=("default",))
    return {**schema, "$defs": options}
