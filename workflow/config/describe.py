"""Writes what the programs declare (`PROGRAM --describe`) to the files that state it again: the schema of the options,
and in docs the tables of options and quantities and the schema of the quantities. Run by `make describe`.
"""

import argparse
import json
import re
import subprocess
import textwrap
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from workflow.lib.files import write_together
from workflow.lib.layout import signature
from workflow.lib.units import SCHEMA, UnitsError, parse

ROOT = Path(__file__).parents[2]
FORMAT = ROOT / "docs/format.md"
FORMAT_SCHEMA = ROOT / "docs/format.schema.json"
NUMBER = r"([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?"
LIMITS = {  # keyword of a JSON Schema, and words
    "minimum": ("minimum", "at least"),
    "exclusive_minimum": ("exclusiveMinimum", "above"),
    "maximum": ("maximum", "at most"),
}
OF_THE_MACHINE = {"threads": "processors"}  # defaults that differ between machines
WIDTH = 118

Described = dict[str, dict[str, Any]]  # by program


def descriptions(programs: Path) -> Described:
    """A quantity that only some chains have is in the description with a flag; `always` names the rest."""
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


def texts(described: Described) -> dict[Path, str]:
    """The files as they have to be."""
    options = {
        name: {o["name"]: schema(o) for o in program["options"] if o["affects_results"]}
        for name, program in described.items()
    }
    text = "JSON Schemas of the programs' options, written by make describe"
    rules = [
        {
            "if": {"properties": {"program": {"const": name}}},
            "then": {"properties": {"quantities": _quantities(one)}},
        }
        for name, one in described.items()
    ]
    return {
        SCHEMA: _compact({"title": text, "programs": options}) + "\n",
        FORMAT: _with_tables(FORMAT.read_text(), described),
        FORMAT_SCHEMA: _compact(json.loads(FORMAT_SCHEMA.read_text()) | {"allOf": rules}) + "\n",
    }


def schema(option: dict[str, Any]) -> dict[str, Any]:
    """JSON Schema of an option. Patterns say what ranges cannot, and the program checks the rest. `allowed` is for messages
    and tables, `units` for the columns of tables."""
    noun, _, other = option["type"].partition(" or ")
    if noun in ("flag", "text"):
        return (
            {"type": "boolean", "allowed": "true or false"}
            if noun == "flag"
            else {"type": "string", "allowed": "text"}
        )
    if noun == "choice":
        return {"enum": option["choices"], "allowed": " or ".join(option["choices"])}
    limits = {LIMITS[name][0]: option[name] for name in LIMITS if name in option}
    words = " and ".join(f"{LIMITS[name][1]} {option[name]:.15g}" for name in LIMITS if name in option)
    allowed, number = (
        f"{noun} {words}".strip(),
        NUMBER if {"minimum", "exclusiveMinimum"} & {*limits} else f"-?{NUMBER}",
    )
    pattern = None
    if noun == "numbers":
        pattern, allowed = f"{number}(,{number})*", f"{allowed}, ascending, separated by commas"
    elif "word" in option:
        pattern, allowed = option["word"], f"{allowed}, or {option['word']}"
    elif other:
        term = rf"{number}(N(\^2)?)?"
        pattern, allowed = (
            rf"{term}(\+{term})*",
            f"{allowed}, or a sum of such, each alone or followed by N or N^2",
        )
    kind = noun.rstrip("s")
    found = {"type": [kind, "string"], "pattern": f"^({pattern})$"} if pattern else {"type": kind}
    return (
        found
        | limits
        | {"allowed": allowed}
        | ({"units": option["units"]} if _is_dimension(option["units"]) else {})
    )


def _is_dimension(units: str) -> bool:
    """Not of pure numbers, nor of an error in the units of its quantity."""
    try:
        return parse(units) != parse("1")
    except UnitsError:
        return False


def _describe(program: Path, *options: str) -> dict[str, Any]:
    written = subprocess.run([program, *options, "--describe"], check=True, capture_output=True).stdout
    description: dict[str, Any] = json.loads(written)
    return description


def _with_tables(text: str, described: Described) -> str:
    for name, rows in (("options", _option_rows(described)), ("quantities", _quantity_rows(described))):
        table = "".join(f"| {' | '.join(_escaped(cell) for cell in row)} |\n" for row in rows)
        before, begin, rest = text.partition(f"<!-- {name}, by make describe -->\n")
        _, end, after = rest.partition(f"<!-- end of {name} -->\n")
        if not end:
            raise ValueError(
                f"{FORMAT} has no lines '<!-- {name}, by make describe -->' and '<!-- end of {name} -->'"
            )
        text = before + begin + table + end + after
    return text


def _escaped(cell: str) -> str:
    """Markdown takes a bar as the end of a cell and <x> as a tag."""
    return re.sub(r"[|<]", r"\\\g<0>", cell)


def _option_rows(described: Described) -> Iterator[tuple[str, ...]]:
    """Options that most programs share come first."""
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
    return (
        f"`--{option['name']}`",
        schema(option)["allowed"],
        shown,
        option.get("units", ""),
        option["description"],
    )


def _quantity_rows(described: Described) -> Iterator[tuple[str, ...]]:
    yield ("program", "quantity", "units", "meaning")
    yield ("---",) * 4
    for name, program in described.items():
        for i, quantity in enumerate(program["quantities"]):
            axes = ", ".join(axis["name"] for axis in quantity["axes"])
            label = f"`{quantity['name']}`{f' [{axes}]' if axes else ''}"
            yield ("" if i else f"`{name}`", label, quantity["units"], quantity["description"])


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


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", type=Path, default=ROOT / "build/bin", help="folder of the executables")
    files = texts(descriptions(parser.parse_args().programs))
    write_together({path: text.encode() for path, text in files.items()})
