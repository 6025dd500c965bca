"""YAML that means the same to every reader: what versions of YAML read differently is refused, not guessed.

Numbers are decimal. An anchor names a flat mapping of options, which other mappings may share or merge.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import yaml

STRING = "tag:yaml.org,2002:str"
MERGE = "tag:yaml.org,2002:merge"
NUMBER = r"-?(0|[1-9][0-9]*)"
# Plain words by their meaning, with the characters that they may begin with.
MEANINGS = {
    "int": (NUMBER, "-0123456789"),
    "float": (rf"{NUMBER}(\.[0-9]+)?([eE][+-]?[0-9]+)?", "-0123456789"),
    "bool": ("true|false", "tf"),
    "null": ("null|", ["n", ""]),
    "merge": ("<<", "<"),
}
OCTAL = re.compile(r"[+-]?0[0-9_]+|0o[0-7]+")  # to some readers; others take 08 and 0o7 for text
DIGITS = 100  # of a number; more mean a mistake, and more than 4300 Python refuses to read
PLAIN = "a decimal number, true, false, null, or text in quotation marks"

Keys = tuple[str, ...]


class ConfigurationError(ValueError):
    """The configuration cannot be used; the message names file, key, value, line, column and what is allowed."""


@dataclass(frozen=True)
class Document:
    """What a file holds, and the line and column of each key's value; of what is shared, those of the alias."""

    name: str
    content: Any
    places: dict[Keys, tuple[int, int]]

    def complaint(self, keys: Iterable[str], text: str, value: str = "") -> ConfigurationError:
        keys = tuple(keys)
        key = ".".join(keys) or "the whole file"
        while keys not in self.places:
            keys = keys[:-1]
        line, column = self.places[keys]
        given = f" = {value}" if value else ""
        return ConfigurationError(f"{self.name}: {key}{given} (line {line}, column {column}): {text}")


def nearest(name: str, names: Iterable[str]) -> str:
    """A remark on the one that was meant, if there is one that is written nearly so."""
    found = get_close_matches(str(name), [*names], 1)
    return f"; the nearest is {found[0]}" if found else ""


def read(path: Path) -> Document:
    """Raises ConfigurationError if it is not a file that holds a mapping in plain YAML."""
    loader = None
    try:
        if path.exists() and not path.is_file():
            raise ConfigurationError(f"{path.name} is not a file: put the YAML of the repository there")
        loader = _Loader(path.read_bytes().decode())
        loader.name = path.name
        content = loader.get_single_data()
    except FileNotFoundError as error:
        raise ConfigurationError(f"{path.name} is missing") from error
    except OSError as error:
        raise ConfigurationError(f"{path.name} cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ConfigurationError(
            f"{path.name} is not UTF-8 text: {error.reason}, byte {error.start}"
        ) from error
    except yaml.YAMLError as error:
        raise ConfigurationError(f"{path.name} is not valid YAML: {_on_one_line(error)}") from error
    except RecursionError as error:
        raise ConfigurationError(f"{path.name} is not valid YAML: it is nested too deeply") from error
    if not isinstance(content, dict):
        found = (
            "is empty"
            if content is None
            else "holds a list"
            if isinstance(content, list)
            else "holds one value"
        )
        raise ConfigurationError(f"{path.name} {found} (allowed: keys with values)")
    return Document(path.name, content, loader.places)


def _on_one_line(error: yaml.YAMLError) -> str:
    place = str(error)
    if isinstance(error, yaml.MarkedYAMLError) and (mark := error.problem_mark):
        place = f"line {mark.line + 1}, column {mark.column + 1}: {error.problem}"
    return " ".join(place.split())


class _Loader(yaml.SafeLoader):
    """Refuses while the tree of nodes is made, where keys and places are known."""

    yaml_implicit_resolvers: dict[str, Any] = {}  # noqa: RUF012  # PyYAML's own name and type

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.keys: list[str] = []
        self.places: dict[Keys, tuple[int, int]] = {}
        self.complete: list[yaml.Node] = []

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node:
        event = self.peek_event()  # type: ignore[no-untyped-call]  # the stub gives it no types
        key = index.value if isinstance(index, yaml.ScalarNode) else getattr(index, "id", index)
        self.keys += [] if key is None else [str(key)]
        place = event.start_mark.line + 1, event.start_mark.column + 1
        self.places.setdefault(tuple(self.keys), place)
        if getattr(event, "tag", None):
            self._refuse("tags are not read", event.tag, PLAIN)
        if isinstance(event, yaml.AliasEvent) and event.anchor not in self.anchors:
            self._refuse("there is no such anchor above", f"*{event.anchor}", "the name of one")
        node: yaml.Node = super().compose_node(parent, index)  # type: ignore[assignment]  # None is in the stub only
        if isinstance(event, yaml.ScalarEvent):
            self._check_scalar(event)
        elif isinstance(event, yaml.AliasEvent):
            self._check_shared(node, event)
        elif isinstance(node, yaml.MappingNode):
            self._check_keys(node)
        self.complete.append(node)
        if key is not None:
            self.keys.pop()
        return node

    def _check_scalar(self, event: yaml.ScalarEvent) -> None:
        text = event.value
        if event.style:
            return
        if _tag(self, text) != STRING:
            if len(text) > DIGITS:
                shown = f"{text[:DIGITS]}..."
                self._refuse(
                    "the number is too long", shown, f"at most {DIGITS} characters", event.start_mark
                )
            return
        if _tag(yaml.SafeLoader(""), text) != STRING or OCTAL.fullmatch(text):
            self._refuse("versions of YAML differ on what this means", text, PLAIN, event.start_mark)

    def _check_shared(self, node: yaml.Node, alias: yaml.AliasEvent) -> None:
        flat = isinstance(node, yaml.MappingNode) and not any(
            isinstance(value, yaml.MappingNode) for key, value in node.value if key.tag != MERGE
        )
        if not flat or not any(node is one for one in self.complete):
            self._refuse(
                "only a flat mapping can be shared", f"*{alias.anchor}", "an anchor at a mapping of options"
            )

    def _check_keys(self, node: yaml.MappingNode) -> None:
        seen: set[str] = set()
        for key, value in node.value:
            name = key.value if isinstance(key, yaml.ScalarNode) else f"a {key.id}"
            place = key.start_mark
            if key.tag == MERGE and not isinstance(value, yaml.MappingNode):
                self._refuse("only a mapping can be merged", "<<", "an alias of one", place)
            if key.tag not in (STRING, MERGE):
                self._refuse("a key is a name", str(name), "text, with quotation marks if need be", place)
            if name in seen:
                self._refuse("the key stands here twice", str(name), "each key once", place)
            seen.add(name)

    def _refuse(self, text: str, value: str, allowed: str, place: Any = None) -> None:
        """place: a mark, of which PyYAML has two types. Raises ConfigurationError."""
        keys = tuple(self.keys)
        if place:
            self.places[keys] = place.line + 1, place.column + 1
        document = Document(self.name, None, self.places)
        raise document.complaint(keys, f"{text} (allowed: {allowed})", value)


for _meaning, (_pattern, _first) in MEANINGS.items():
    _Loader.add_implicit_resolver(
        f"tag:yaml.org,2002:{_meaning}", re.compile(rf"(?:{_pattern})\Z"), [*_first]
    )


def _tag(loader: Any, text: str) -> str:
    """What a loader takes a plain word for."""
    return str(loader.resolve(yaml.ScalarNode, text, (True, False)))


def _number(loader: _Loader, node: yaml.ScalarNode) -> float:
    """PyYAML takes 1e3 without a point for a number only if it is told so."""
    return float(node.value)


_Loader.add_constructor("tag:yaml.org,2002:float", _number)
