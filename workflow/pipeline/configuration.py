"""Loads YAML files of panels, as paper.yaml, and quality/*.yaml beside them, and validates them against the
declared options of the programs."""

import json
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator, ValidationError
from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.nodes import MappingNode, Node, SequenceNode

from workflow.lib.identity import ROOT
from workflow.lib.suggestion import suggestion
from workflow.pipeline.described import options_of_programs
from workflow.pipeline.sources import programs as names_of_programs
from workflow.render.files import format_os_error

Options = dict[str, Any]  # by name without leading dashes: a number, text, or a bool for a flag
Schema = dict[str, Any]
Keys = tuple[Any, ...]  # path in nested mappings and lists

STUDY = ROOT / "workflow/study/study.yaml"
# Files with panels: the paper's, those of the study, those of the user, which are not in git.
PANELS = (ROOT / "workflow/config/paper.yaml", STUDY, ROOT / "own/panels.yaml")
SCRIPTS = {STUDY: "workflow/study", PANELS[2]: "own"}  # folders of their scripts
ERROR = "error"  # relative error, in place of a number of replicas
EFFORT_OPTIONS = ("cells", "observation-time", "pairs-per-replica", "replicas", ERROR)
ALSO_PHYSICS = ("cells", "observation-time")  # given in paper.yaml, too
SCALE: Schema = {"type": "number", "exclusiveMinimum": 0, "allowed": "a number greater than 0"}
FRACTION = {**SCALE, "exclusiveMaximum": 1, "allowed": "a number greater than 0 and less than 1"}
OF_SERIES: Schema = {
    "program": True,
    "target-scale": SCALE,  # reference value of ERROR where the target may be 0
}
NAME: Schema = {"type": "string", "pattern": "^[A-Za-z0-9_-]+$", "allowed": "letters, digits, _ and -"}
# Names of panels are rules of Snakemake.
PANEL_NAME = NAME | {
    "pattern": "^(?!(figures|report|gallery|simulate)$)[A-Za-z0-9_-]+$",
    "allowed": "letters, digits, _ and -, but not figures, report, gallery or simulate",
}
NAMED: Schema = {"type": "object", "propertyNames": NAME, "minProperties": 1}
NAMES: Schema = {"type": "array", "items": {"type": "string"}, "minItems": 1, "uniqueItems": True}
NEW = " (after a change of the programs: run make build)"
SAFE = YAML(typ="safe", pure=True)
DECIMAL = re.compile(r"(?<![\w.])[0-9]*\.[0-9]+(?:[eE][-+]?[0-9]+)?")


class ConfigurationError(ValueError):
    """One line per error: file, line, column, key, problem and allowed values."""


@dataclass(frozen=True)
class Document:
    """A YAML file."""

    file: Path
    root: Node | None
    content: Any

    @property
    def name(self) -> str:
        """The path relative to the project's folder."""
        return _shown(self.file)

    def check(self, schema: Schema) -> None:
        """Validates the content. Raises ConfigurationError."""
        complaints: dict[tuple[int, int], str] = {}  # a shared mapping is reported once
        for keys in _not_finite(self.content):
            complaints[self._position(keys)] = self.complaint(keys, "is not a finite number: give one")
        for error in Draft202012Validator(schema).iter_errors(self.content):
            for keys, problem in _problems(error):
                complaints.setdefault(self._position(keys), self.complaint(keys, problem))
        if complaints:
            raise ConfigurationError("\n".join(complaints[position] for position in sorted(complaints)))

    def complaint(self, keys: Keys, problem: str) -> str:
        line, column = self._position(keys)
        return f"{self.name}:{line}:{column}: {'.'.join(map(str, keys)) or 'the file'}: {problem}"

    def _position(self, keys: Keys) -> tuple[int, int]:
        """Line and column of a key or an item; of a merged key, in the mapping that defines it."""
        node, position = self.root, (1, 1)
        for key in keys:
            if member := _member(node, key):
                mark, node = member
                position = mark.line + 1, mark.column + 1
        return position


def read(path: Path) -> Document:
    """Reads a YAML 1.2 file. Raises ConfigurationError, also for duplicate keys and rounding errors."""
    try:
        text = path.read_text("utf-8")
        refuse_rounding_errors(text, f"{_shown(path)}:")
        root = SAFE.compose(text)
        # This also merges the mappings of the node.
        content = SAFE.constructor.construct_document(root) if root else None
        return Document(path, root, content)
    except OSError as error:
        raise ConfigurationError(format_os_error(error)) from error
    except MarkedYAMLError as error:
        mark = error.problem_mark
        position = f"{mark.line + 1}:{mark.column + 1}"
        raise ConfigurationError(f"{_shown(path)}:{position}: {error.problem}") from error
    except (YAMLError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"{_shown(path)}: {' '.join(str(error).split())}") from error


def refuse_rounding_errors(text: str, where: str = "") -> None:
    """Raises ConfigurationError for a number that differs from one of 12 digits by a rounding error, as
    0.30000000000000004 from a loop: it would name another run, with another seed. where: before the line."""
    for line, content in enumerate(text.splitlines(), 1):
        for number in DECIMAL.findall(content.partition("#")[0]):
            short = f"{float(number):.12g}"
            if 0 < abs(float(number) - float(short)) < 1e-14 * abs(float(short)):
                position = f"{where}{line}: " * bool(where)
                raise ConfigurationError(
                    f"{position}{number} is {short} with a rounding error: write {short}"
                )


def _shown(path: Path) -> str:
    """A path of the project relative to its folder."""
    return str(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path)


def panel_names(files: Sequence[Path] = PANELS) -> list[str]:
    """Names of the panels, also before the programs are compiled. Raises ConfigurationError."""
    documents = [read(file) for file in files if file.exists()]
    for document in documents:
        document.check(_object({"panels": NAMED}) | {"required": ["panels"]})
    require_distinct(documents)
    return [name for document in documents for name in document.content["panels"]]


def require_distinct(documents: Sequence[Document]) -> None:
    """Raises ConfigurationError if two files have a panel of one name."""
    names: dict[str, Document] = {}
    for document in documents:
        for name in document.content["panels"]:
            if name in names:
                text = f"is a panel of {names[name].name}: choose another name"
                raise ConfigurationError(document.complaint(("panels", name), text))
            names[name] = document


def load_configuration(quality: str, file: Path, first: Path) -> tuple[Document, Document]:
    """Validated panels of a YAML file, and their efforts in `quality/<quality>.yaml` beside it, which has the
    default effort for the first of the files. Options of a program that is not compiled are not validated:
    reading needs no compiler, and nothing is computed before. Raises ConfigurationError."""
    programs: dict[str, Schema] = {name: {} for name in names_of_programs()} | options_of_programs()
    panels, effort = read(file), file.parent / f"quality/{quality}.yaml"
    efforts = read(effort) if effort.exists() or file == first else Document(effort, None, {"panels": {}})
    panels.check(_panels(programs))
    panels.check(_physics(panels.content, programs))
    required = ["default"] if file == first else ["panels"]
    efforts.check(_efforts(panels, programs, required))
    return panels, efforts


def programs_of(panel: dict[str, Any]) -> dict[str, str]:
    """Program of each series."""
    return {
        series: own.get("program", panel.get("program")) for series, own in panel.get("series", {}).items()
    }


def merge_efforts(options: Options, *efforts: Options) -> Options:
    """Options with efforts, of which later ones replace earlier ones; of replicas and error, each of which
    determines the number of replicas, the last one given counts."""
    for effort in efforts:
        if {"replicas", ERROR} & effort.keys():
            options = {key: value for key, value in options.items() if key not in ("replicas", ERROR)}
        options = options | effort
    return options


def arguments(options: Options) -> list[str]:
    """Command-line arguments of the options, in one order and with one text for equal numbers."""
    words = []
    for name, value in sorted(options.items()):
        if value is not False:
            number = int(value) if isinstance(value, float) and value.is_integer() else value
            words += [f"--{name}"] if value is True else [f"--{name}", str(number)]
    return words


def _panels(programs: dict[str, Schema]) -> Schema:
    """Schema of the structure of paper.yaml, without options."""
    program = {"enum": [*programs]}
    series = {"type": "object", "properties": OF_SERIES | {"program": program}}
    panel = _object(
        {
            "program": program,
            "script": NAME,
            "uses": NAMES,
            "inputs": NAMES,
            "common": {"type": "object"},
            "series": NAMED | {"additionalProperties": series},
        }
    )
    panel["if"] = {"not": {"required": ["program"]}}
    panel["then"] = {"properties": {"series": {"additionalProperties": {"required": ["program"]}}}}
    named = NAMED | {"propertyNames": PANEL_NAME, "additionalProperties": panel}
    return _object({"panels": named}) | {"required": ["panels"]}


def _physics(paper: dict[str, Any], programs: dict[str, Schema]) -> Schema:
    """Schema of the options in paper.yaml: all but effort."""
    elsewhere = {name: "belongs into quality/*.yaml" for name in EFFORT_OPTIONS if name not in ALSO_PHYSICS}
    elsewhere["seed"] = "follows from the names of panel and run; `make panel SEED=7` chooses another"
    common = {name: _options(name, options, elsewhere) for name, options in programs.items()}
    series = {name: own | {"properties": OF_SERIES | own["properties"]} for name, own in common.items()}
    panels = {}
    for name, panel in paper["panels"].items():
        used = programs_of(panel)
        by_series = {"properties": {key: series[program] for key, program in used.items()}}
        every = {"allOf": [True, *(common[program] for program in sorted({*used.values()}))]}
        panels[name] = {"properties": {"common": every, "series": by_series}}
    return {"properties": {"panels": {"properties": panels}}}


def _efforts(panels: Document, programs: dict[str, Schema], required: list[str]) -> Schema:
    """Schema of quality/*.yaml: the default effort of all sampled runs, that of all sampled series of a panel,
    and that of single series."""
    physics = {name for options in programs.values() for name in options if name not in EFFORT_OPTIONS}
    elsewhere = dict.fromkeys(physics, f"is the same at all qualities: give it in {panels.name}")
    series = {name: _options(name, options, elsewhere) for name, options in programs.items()}
    every: Schema = dict.fromkeys(EFFORT_OPTIONS, True)
    for one in series.values():
        every |= one["properties"]
    listed = {}
    for name, panel in panels.content["panels"].items():
        of_series = {key: series[program] for key, program in programs_of(panel).items()}
        missing = {"unknown": f"is not a series of {name} in {panels.name}: remove it here"}
        omit = {"type": "array", "items": {"enum": [*of_series], **missing}, "uniqueItems": True}
        listed[name] = _object({**every, "omit": omit, **of_series}) | missing
    default = _object({name: every[name] for name in ("replicas", ERROR)})
    known = _object(listed) | {"unknown": f"is not a panel in {panels.name}: remove it here"}
    return _object({"default": default, "panels": known}) | {"required": required}


def _options(program: str, options: Schema, elsewhere: dict[str, str]) -> Schema:
    """Schema of the options of a program, each with a value or a list of distinct values. Without options,
    of a program that is not compiled, anything is valid."""
    if not options:
        return {"properties": {}}
    several = {"minItems": 1, "uniqueItems": True}
    if "replicas" in options:
        options = options | {ERROR: FRACTION}
    schemas = {
        name: {"if": {"type": "array"}, "then": {"items": option} | several, "else": option}
        for name, option in options.items()
        if name not in elsewhere
    }
    return _object(schemas) | {"title": program, "elsewhere": elsewhere}


def _object(properties: Schema) -> Schema:
    return {"type": "object", "properties": properties, "additionalProperties": False}


def _not_finite(content: Any, keys: Keys = ()) -> Iterator[Keys]:
    """Paths of .nan and .inf, which no schema refuses."""
    if isinstance(content, float) and not math.isfinite(content):
        yield keys
    members = (
        content.items()
        if isinstance(content, dict)
        else enumerate(content)
        if isinstance(content, list)
        else ()
    )
    for key, member in members:
        yield from _not_finite(member, (*keys, key))


def _problems(error: ValidationError) -> Iterator[tuple[Keys, str]]:
    """Path and description of each problem that a validation error reports."""
    keys, schema = tuple(error.absolute_path), error.schema
    assert isinstance(schema, dict)
    value = json.dumps(error.instance, default=str, ensure_ascii=False)
    if error.validator == "additionalProperties" and isinstance(error.instance, dict):
        for name in error.instance.keys() - schema["properties"].keys():
            unknown = schema.get("unknown", "unknown key")
            unknown = f"{schema['title']} has no such option" if "title" in schema else unknown
            remedy = suggestion(str(name), schema["properties"]) + (NEW if "title" in schema else "")
            yield (*keys, name), schema.get("elsewhere", {}).get(name, f"{unknown}; {remedy}")
    elif error.validator == "enum":
        unknown, new = schema.get("unknown", "is unknown"), "" if "unknown" in schema else NEW
        yield keys, f"{value} {unknown}; {suggestion(str(error.instance), schema['enum'])}{new}"
    elif error.validator == "uniqueItems" and isinstance(error.instance, list):
        repeated = next(one for one in error.instance if error.instance.count(one) > 1)
        yield keys, f"{json.dumps(repeated)} is listed more than once: give it once"
    elif "allowed" in schema:
        keys = (
            (*keys, str(error.instance)) if schema in (NAME, PANEL_NAME) else keys
        )  # the error of a name is at its mapping
        yield keys, f"{value} is invalid; allowed: {schema['allowed']}"
    else:
        yield keys, error.message


def _member(node: Node | None, key: Any) -> tuple[Any, Node] | None:
    """Start and node of a member of a mapping or of a sequence."""
    if isinstance(node, SequenceNode):
        return node.value[key].start_mark, node.value[key]
    members = node.value if isinstance(node, MappingNode) else ()
    return {name.value: (name.start_mark, value) for name, value in members}.get(str(key))
