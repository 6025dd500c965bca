"""Loads YAML files of panels, as paper.yaml, and quality/*.yaml beside them.

Their structure is checked here, by schema.yaml; options are checked by the programs (program.require_valid).
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator
from jsonschema.exceptions import best_match
from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.nodes import MappingNode, Node, SequenceNode

from workflow.lib.identity import ROOT
from workflow.lib.suggestion import suggestion
from workflow.pipeline.sources import programs
from workflow.render.files import format_os_error

Options = dict[str, Any]  # by name without leading dashes: a number, text, or a bool for a flag
Keys = tuple[Any, ...]  # path in nested mappings and lists

STUDY = ROOT / "workflow/study/study.yaml"
OWN = ROOT / "own/panels.yaml"  # of the user, not in git
# Files with panels: the paper's, those of the study, those of the user.
PANELS = (ROOT / "workflow/config/paper.yaml", STUDY, OWN)
SCRIPTS = {STUDY: "workflow/study", OWN: "own"}  # folders of their scripts
ERROR = "error"  # relative error, in place of a number of replicas
SAFE = YAML(typ="safe", pure=True)
SCHEMA = SAFE.load((ROOT / "workflow/pipeline/schema.yaml").read_text("utf-8"))


class ConfigurationError(ValueError):
    """One line per error: file, line, keys, problem and allowed values."""


@dataclass(frozen=True)
class Document:
    """A YAML file."""

    file: Path
    root: Node | None = None
    content: Any = None

    @property
    def name(self) -> str:
        """The path relative to the project's folder."""
        return str(self.file.relative_to(ROOT) if self.file.is_relative_to(ROOT) else self.file)

    def check(self, kind: str) -> None:
        """Validates the structure, by the schema of this name. Raises ConfigurationError."""
        complaints = set()
        schema = SCHEMA[kind] | {"$defs": SCHEMA["$defs"]}
        for error in Draft202012Validator(schema).iter_errors(self.content):
            nearest = best_match([error])  # of alternatives
            remedy = nearest.schema.get("description")
            problem = f"{nearest.instance}: {remedy}" if remedy else nearest.message
            complaints.add(self.complaint(tuple(nearest.absolute_path), problem))
        if complaints:
            raise ConfigurationError("\n".join(sorted(complaints)))

    def position(self, keys: Keys) -> str:
        """File, line and keys."""
        return f"{self.name}:{self._line(keys)}: {'.'.join(map(str, keys)) or 'the file'}"

    def complaint(self, keys: Keys, problem: str) -> str:
        return f"{self.position(keys)}: {problem}"

    def require(self, name: str | None, known: Collection[str], keys: Keys, kind: str) -> None:
        """Raises ConfigurationError if a name is unknown."""
        if name not in known:
            text = f"{name} is not a {kind}; {suggestion(str(name), known)}"
            raise ConfigurationError(self.complaint(keys, text))

    def _line(self, keys: Keys) -> int:
        """Line of a key or an item; of a merged key, that of the mapping into which it is merged."""
        node, line = self.root, 1
        for key in keys:
            if isinstance(node, SequenceNode):
                node = node.value[key]
                line = node.start_mark.line + 1
            elif isinstance(node, MappingNode):
                node, line = next(
                    (
                        (value, name.start_mark.line + 1)
                        for name, value in node.value
                        if name.value == str(key)
                    ),
                    (None, line),
                )
        return line


def read(path: Path, kind: str) -> Document:
    """Reads and validates a YAML 1.2 file. Raises ConfigurationError, also for duplicate keys."""
    name = Document(path).name
    try:
        text = path.read_text("utf-8")
        root = SAFE.compose(text)
        _refuse_duplicates(root, name)
        # Merges the mappings of another tree: that of the root keeps its lines.
        document = Document(path, root, SAFE.load(text))
    except OSError as error:
        raise ConfigurationError(format_os_error(error)) from error
    except MarkedYAMLError as error:
        mark = error.problem_mark
        raise ConfigurationError(f"{name}:{mark.line + 1}:{mark.column + 1}: {error.problem}") from error
    except (YAMLError, UnicodeDecodeError) as error:
        raise ConfigurationError(f"{name}: {' '.join(str(error).split())}") from error
    document.check(kind)
    return document


def _refuse_duplicates(node: Node | None, where: str) -> None:
    """Raises ConfigurationError for a key that a mapping has twice. The library does not see it beside
    `<<`."""
    if isinstance(node, MappingNode):
        keys: set[Any] = set()
        for key, value in node.value:
            if key.value in keys:
                mark = key.start_mark
                text = f"duplicate key {key.value}: give it once"
                raise ConfigurationError(f"{where}:{mark.line + 1}:{mark.column + 1}: {text}")
            keys.add(key.value)
            _refuse_duplicates(value, where)
    elif isinstance(node, SequenceNode):
        for item in node.value:
            _refuse_duplicates(item, where)


def load_configuration(quality: str, file: Path, first: Path) -> tuple[Document, Document]:
    """Panels of a YAML file, and their efforts in `quality/<quality>.yaml` beside it, which has the default
    effort for the first of the files. Raises ConfigurationError."""
    panels, effort = read(file, "panels"), file.parent / f"quality/{quality}.yaml"
    efforts = read(effort, "quality") if effort.exists() or file == first else Document(effort, content={})
    if file == first:
        if "default" not in efforts.content:
            raise ConfigurationError(efforts.complaint((), "add default: {replicas: 32}"))
    elif "default" in efforts.content:
        text = f"is given in {first.parent.name}/quality alone: give the replicas of each panel here"
        raise ConfigurationError(efforts.complaint(("default",), text))
    known = panels.content["panels"]
    for name, panel in known.items():
        for series, program in programs_of(panel).items():
            panels.require(program, programs(), ("panels", name, "series", series), "program")
    for name, own in efforts.content.get("panels", {}).items():
        efforts.require(name, known, ("panels", name), f"panel of {panels.name}: remove it here")
        for one in [*own.get("omit", ()), *(key for key, value in own.items() if isinstance(value, dict))]:
            where = f"series of {name} in {panels.name}: remove it here"
            efforts.require(one, known[name].get("series", {}), ("panels", name, one), where)
    return panels, efforts


def require_distinct(documents: Sequence[Document]) -> None:
    """Raises ConfigurationError if two files have a panel of one name."""
    names: dict[str, Document] = {}
    for document in documents:
        for name in document.content["panels"]:
            if name in names:
                text = f"is a panel of {names[name].name}: choose another name"
                raise ConfigurationError(document.complaint(("panels", name), text))
            names[name] = document


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
