"""Writes what programs say of themselves (`PROGRAM --describe`) to where it is stated again: their options to
schema.yaml, tables of options and quantities to docs/format.md, quantities to docs/format.schema.json.

Run by `make describe`.
"""

import argparse
import json
import re
import subprocess
import sys
import textwrap
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

from workflow.lib.layout import signature
from workflow.lib.options import admissible
from workflow.lib.places import regular, write_together
from workflow.lib.strict_yaml import ConfigurationError
from workflow.lib.units import UnitsError, parse

ROOT = Path(__file__).parents[2]
SCHEMA = ROOT / "workflow/config/schema.yaml"
FORMAT = ROOT / "docs/format.md"
FORMAT_SCHEMA = ROOT / "docs/format.schema.json"
LIMITS = ("type", "minimum", "exclusive_minimum", "maximum", "word", "choices")
OF_THE_MACHINE = {"threads": "processors"}  # defaults that differ between machines
WIDTH = 118


def descriptions(programs: Path) -> dict[str, dict[str, Any]]:
    """By program. A quantity that only some chains have is in the description with a flag; `always` names the rest."""
    described = {}
    for name in sorted(path.stem for path in (ROOT / "cpp/observables").glob("*.cpp")):
        plain = _describe(programs / name)
        flags = [o["name"] for o in plain["options"] if o["type"] == "flag" and o["affects_results"]]
        variants = [plain, *(_describe(programs / name, f"--{flag}") for flag in flags)]
        quantities = {q["name"]: q for variant in variants for q in variant["quantities"]}
        sets = [{q["name"] for q in variant["quantities"]} for variant in variants]
        always = [q for q in quantities if all(q in names for names in sets)]
        described[name] = plain | {"quantities": list(quantities.values()), "always": always}
    return described


def texts(described: dict[str, dict[str, Any]]) -> dict[Path, str]:
    """The files as they have to be."""
    return {
        SCHEMA: _with_options(SCHEMA.read_text(), described),
        FORMAT: _with_tables(FORMAT.read_text(), described),
        FORMAT_SCHEMA: _with_quantities(regular(FORMAT_SCHEMA).read_text(), described),
    }


def _describe(program: Path, *options: str) -> dict[str, Any]:
    said = subprocess.run([program, *options, "--describe"], check=True, capture_output=True).stdout
    description: dict[str, Any] = json.loads(said)
    return description


def _with_options(text: str, described: dict[str, dict[str, Any]]) -> str:
    programs = {
        name: {
            option["name"]: {key: option[key] for key in LIMITS if key in option} | _dimension(option)
            for option in program["options"]
            if option["affects_results"]
        }
        for name, program in described.items()
    }
    kept, start, _ = text.partition("programs:")
    if not start:
        raise ConfigurationError(f"{SCHEMA.relative_to(ROOT)} has no line 'programs:': restore it")
    return kept + yaml.safe_dump(
        {"programs": programs}, default_flow_style=None, sort_keys=False, width=WIDTH
    )


def _dimension(option: dict[str, Any]) -> dict[str, str]:
    """Units, unless the option is a pure number, a word, or has those of another quantity."""
    units = option.get("units", "1")
    try:
        return {"units": units} if parse(units) != parse("1") else {}
    except UnitsError:
        return {}


def _with_tables(text: str, described: dict[str, dict[str, Any]]) -> str:
    for name, rows in (("options", _option_rows(described)), ("quantities", _quantity_rows(described))):
        begin, end = f"<!-- {name}, by make describe -->\n", f"<!-- end of {name} -->\n"
        before, there, rest = text.partition(begin)
        if not (there and end in rest):
            raise ConfigurationError(
                f"{FORMAT.relative_to(ROOT)} has no place for the {name}: restore its line '{begin.strip()}' and its end"
            )
        table = "".join(f"| {' | '.join(_escaped(cell) for cell in row)} |\n" for row in rows)
        text = before + begin + table + end + rest.partition(end)[2]
    return text


def _escaped(cell: str) -> str:
    """Markdown takes a bar as the end of a cell and <x> as a tag."""
    return re.sub(r"[|<]", r"\\\g<0>", cell)


def _option_rows(described: dict[str, dict[str, Any]]) -> Iterator[tuple[str, ...]]:
    """What most programs share stands first, once."""
    users = Counter(json.dumps(option) for program in described.values() for option in program["options"])
    shared = [option for option, count in users.items() if count > len(described) / 2]
    yield ("program", "option", "values", "default", "units", "meaning")
    yield ("---",) * 6
    for option in map(json.loads, shared):
        lacking = [f"`{name}`" for name, program in described.items() if option not in program["options"]]
        yield (f"all{' but ' + ', '.join(lacking) if lacking else ''}", *_option_cells(option))
    for name, program in described.items():
        own = [option for option in program["options"] if json.dumps(option) not in shared]
        for i, option in enumerate(own):
            yield ("" if i else f"`{name}`", *_option_cells(option))


def _option_cells(option: dict[str, Any]) -> tuple[str, ...]:
    default = OF_THE_MACHINE.get(option["name"], option["default"])
    shown = json.dumps(default).strip('"') if not isinstance(default, float) else f"{default:.10g}"
    return f"`--{option['name']}`", admissible(option), shown, option.get("units", ""), option["description"]


def _quantity_rows(described: dict[str, dict[str, Any]]) -> Iterator[tuple[str, ...]]:
    yield ("program", "quantity", "units", "meaning")
    yield ("---",) * 4
    for name, program in described.items():
        for i, quantity in enumerate(program["quantities"]):
            axes = ", ".join(axis["name"] for axis in quantity["axes"])
            label = f"`{quantity['name']}`{f' [{axes}]' if axes else ''}"
            yield ("" if i else f"`{name}`", label, quantity["units"], quantity["description"])


def _with_quantities(text: str, described: dict[str, dict[str, Any]]) -> str:
    rules = [
        {
            "if": {"properties": {"program": {"const": name}}},
            "then": {"properties": {"quantities": _quantities(program)}},
        }
        for name, program in described.items()
    ]
    return _compact(json.loads(text) | {"allOf": rules}) + "\n"


def _quantities(program: dict[str, Any]) -> dict[str, Any]:
    """By name: units and axes, as layout.py gives them."""
    properties = {
        quantity["name"]: {
            "const": signature(quantity["units"], {axis["name"]: axis["units"] for axis in quantity["axes"]})
        }
        for quantity in program["quantities"]
    }
    return {"properties": properties, "required": program["always"], "additionalProperties": False}


def _compact(value: Any, indent: int = 0, used: int = 0) -> str:
    """JSON in lines of limited width: what fits stays on one line. `used`: the characters before it."""
    line = json.dumps(value)
    if used + len(line) < WIDTH or not isinstance(value, (dict, list)):
        return line
    inner = " " * (indent + 2)
    if isinstance(value, dict):
        keys = {key: f"{inner}{json.dumps(key)}: " for key in value}
        parts = [start + _compact(value[key], indent + 2, len(start)) for key, start in keys.items()]
        return "{\n" + ",\n".join(parts) + f"\n{' ' * indent}}}"
    if not any(isinstance(part, (dict, list)) for part in value):
        filled = textwrap.fill(
            line[1:-1], WIDTH, initial_indent=inner, subsequent_indent=inner, break_on_hyphens=False
        )
        return f"[\n{filled}\n{' ' * indent}]"
    return (
        "[\n"
        + ",\n".join(inner + _compact(part, indent + 2, indent + 2) for part in value)
        + f"\n{' ' * indent}]"
    )


def main() -> None:
    parser = argparse.ArgumentParser(
        description="Writes what the programs say of themselves to where it is stated again"
    )
    parser.add_argument("--programs", type=Path, default=ROOT / "build/bin", help="folder of the executables")
    try:
        files = texts(descriptions(parser.parse_args().programs))
    except ConfigurationError as error:
        sys.exit(f"make describe: {error}")
    write_together({path: text.encode() for path, text in files.items()})


if __name__ == "__main__":
    main()
