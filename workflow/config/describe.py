"""Writes the schema of the options, and the tables and the schema in docs/format.*, from `PROGRAM --describe` (`make describe`)."""

import argparse
import json
import re
import subprocess
import textwrap
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from workflow import polynomial
from workflow.files import write_together
from workflow.identity import ROOT
from workflow.lib.units import SCHEMA

FORMAT = ROOT / "docs/format.md"
FORMAT_SCHEMA = ROOT / "docs/format.schema.json"
SIMPLE = {
    "flag": {"type": "boolean", "allowed": "true or false"},
    "text": {"type": "string", "allowed": "text"},
}
LIMITS = {  # keyword of JSON Schema, and text
    "minimum": ("minimum", "at least"),
    "exclusive_minimum": ("exclusiveMinimum", "above"),
    "maximum": ("maximum", "at most"),
}
PURE = ("1", "that of the target quantity")  # options without units of their own
OF_THE_MACHINE = {"threads": "processors"}  # defaults that depend on the machine
WIDTH = 118

Described = dict[str, dict[str, Any]]  # descriptions by program


def built(programs: Path = ROOT / "build/bin") -> list[str]:
    """Names of the programs that CMake builds into this folder."""
    return sorted(path.stem for path in (programs.parent / "build_info").glob("*.cpp"))


def with_option(name: str) -> list[str]:
    """The built programs that declare this option."""
    declared = json.loads(SCHEMA.read_text())["programs"]
    return [program for program in built() if name in declared.get(program, ())]


def descriptions(programs: Path) -> Described:
    """Descriptions of all programs. Some quantities exist only with a flag; `always` lists the others."""
    described = {}
    for name in built(programs):
        plain = _describe(programs / name)
        flags = [
            option["name"]
            for option in plain["options"]
            if option["type"] == "flag" and option["affects_results"]
        ]
        variants = [plain, *(_describe(programs / name, f"--{flag}") for flag in flags)]
        quantities = {
            quantity["name"]: quantity for variant in variants for quantity in variant["quantities"]
        }
        every = Counter(quantity["name"] for variant in variants for quantity in variant["quantities"])
        always = [quantity for quantity in quantities if every[quantity] == len(variants)]
        described[name] = plain | {"quantities": [*quantities.values()], "always": always}
    return described


def texts(described: Described) -> dict[Path, str]:
    """Path and text of each file to write."""
    options: dict[str, Any] = {"title": "Options of the programs, by make describe", "programs": {}}
    rules = []
    for name, program in described.items():
        determining = [option for option in program["options"] if option["affects_results"]]
        options["programs"][name] = {option["name"]: schema(option) for option in determining}
        quantities = {quantity["name"]: {"const": _signature(quantity)} for quantity in program["quantities"]}
        own = {"properties": quantities, "required": program["always"], "additionalProperties": False}
        condition = {"properties": {"program": {"const": name}}}
        rules.append({"if": condition, "then": {"properties": {"quantities": own}}})
    tables = _with_table(FORMAT.read_text(), "options", _option_rows(described))
    return {
        SCHEMA: _compact(options) + "\n",
        FORMAT: _with_table(tables, "quantities", _quantity_rows(described)),
        FORMAT_SCHEMA: _compact(json.loads(FORMAT_SCHEMA.read_text()) | {"allOf": rules}) + "\n",
    }


def schema(option: dict[str, Any]) -> dict[str, Any]:
    """JSON Schema of an option. A text option has a pattern; only the program checks the range of the numbers in it. `allowed` is for messages and tables,
    `units` for the columns of tables."""
    kind, _, alternative = option["type"].partition(" or ")
    if kind in SIMPLE:
        return SIMPLE[kind]
    if kind == "choice":
        return {"enum": option["choices"], "allowed": " or ".join(option["choices"])}
    limits = {key: option[name] for name, (key, _) in LIMITS.items() if name in option}
    ranges = [f"{words} {option[name]:.15g}" for name, (_, words) in LIMITS.items() if name in option]
    allowed = " ".join([kind, *" and ".join(ranges).split()])
    number = polynomial.NUMBER if {*limits} - {"maximum"} else f"-?{polynomial.NUMBER}"
    pattern = ""
    if kind == "numbers":
        kind, pattern, allowed = (
            "number",
            f"{number}(,{number})*",
            f"{allowed}, ascending, separated by commas",
        )
    elif "word" in option:
        pattern, allowed = option["word"], f"{allowed}, or {option['word']}"
    elif alternative:
        pattern = polynomial.pattern(number)
        allowed += ", or a sum of such, each alone or followed by N or N^2"
    types = {"type": [kind, "string"], "pattern": f"^({pattern})$"} if pattern else {"type": kind}
    units = {} if option["units"] in PURE else {"units": option["units"]}
    return types | limits | {"allowed": allowed} | units


def signature(units: str, axes: dict[str, str]) -> str:
    """Units and axes of a quantity in short: `1/(time momentum) [bond in 1, momentum in momentum]`."""
    return f"{units} [{', '.join(f'{name} in {unit}' for name, unit in axes.items())}]" if axes else units


def _describe(program: Path, *options: str) -> dict[str, Any]:
    written = subprocess.run([program, *options, "--describe"], check=True, capture_output=True).stdout
    return json.loads(written)


def _signature(quantity: dict[str, Any]) -> str:
    return signature(quantity["units"], {axis["name"]: axis["units"] for axis in quantity["axes"]})


def _with_table(text: str, name: str, rows: Iterable[tuple[str, ...]]) -> str:
    """Replaces a table in Markdown, where bars and angle brackets in cells are escaped."""
    cells = ([re.sub(r"[|<]", r"\\\g<0>", cell) for cell in row] for row in rows)
    before, begin, rest = text.partition(f"<!-- {name}, by make describe -->\n")
    _, end, after = rest.partition(f"<!-- end of {name} -->\n")
    if not end:
        raise ValueError(f"{FORMAT} lacks '<!-- {name}, by make describe -->' or '<!-- end of {name} -->'")
    return before + begin + "".join(f"| {' | '.join(row)} |\n" for row in cells) + end + after


def _option_rows(described: Described) -> Iterator[tuple[str, ...]]:
    """Rows of the table of options. Options of most programs are first."""
    users = Counter(json.dumps(option) for program in described.values() for option in program["options"])
    shared = [json.loads(option) for option, count in users.items() if count > len(described) / 2]
    lacking = [
        [f"`{name}`" for name in described if option not in described[name]["options"]] for option in shared
    ]
    labelled = [
        (f"all{' but ' * bool(names)}{', '.join(names)}", option)
        for names, option in zip(lacking, shared, strict=True)
    ]
    for name, program in described.items():
        own = [option for option in program["options"] if option not in shared]
        labelled += [("" if i else f"`{name}`", option) for i, option in enumerate(own)]
    yield from (("program", "option", "values", "default", "units", "meaning"), ("---",) * 6)
    for label, option in labelled:
        default = OF_THE_MACHINE.get(option["name"], option["default"])
        shown = f"{default:.10g}" if isinstance(default, float) else json.dumps(default).strip('"')
        values, units = schema(option)["allowed"], option.get("units", "")
        yield label, f"`--{option['name']}`", values, shown, units, option["description"]


def _quantity_rows(described: Described) -> Iterator[tuple[str, ...]]:
    yield from (("program", "quantity", "units", "meaning"), ("---",) * 4)
    for name, program in described.items():
        for i, quantity in enumerate(program["quantities"]):
            axes = ", ".join(axis["name"] for axis in quantity["axes"])
            label = f"`{quantity['name']}`{f' [{axes}]' if axes else ''}"
            yield "" if i else f"`{name}`", label, quantity["units"], quantity["description"]


def _compact(value: Any, indent: int = 0, used: int = 0) -> str:
    """JSON with values on one line if they fit its width. used: number of characters before the value."""
    line, inner = json.dumps(value), " " * (indent + 2)
    if used + len(line) < WIDTH or not isinstance(value, dict | list):
        return line
    if isinstance(value, dict):
        keys = {key: f"{inner}{json.dumps(key)}: " for key in value}
        parts = [start + _compact(value[key], indent + 2, len(start)) for key, start in keys.items()]
    elif any(isinstance(element, dict | list) for element in value):
        parts = [inner + _compact(element, indent + 2, indent + 2) for element in value]
    else:
        parts = [
            textwrap.indent(textwrap.fill(line[1:-1], WIDTH - len(inner), break_on_hyphens=False), inner)
        ]
    return "\n".join([line[0], ",\n".join(parts), " " * indent + line[-1]])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", type=Path, default=ROOT / "build/bin", help="folder of the executables")
    files = texts(descriptions(parser.parse_args().programs))
    write_together({path: text.encode() for path, text in files.items()})
