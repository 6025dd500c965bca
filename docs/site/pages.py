"""Hook of MkDocs: the pages at the top of the project, README.md as the first, and the tables of options and quantities in format.md,
from build/describe/*.json.
"""

import json
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

from workflow.pipeline.described import described

ROOT = Path(__file__).parents[2]
TOP = {
    "README.md": "index.md",
    "CONTRIBUTING.md": "CONTRIBUTING.md",
    "CHANGELOG.md": "CHANGELOG.md",
    "CITATION.cff": "CITATION.cff",
}


def options(programs: list[dict[str, Any]]) -> Iterable[tuple[str, ...]]:
    """A row for each option, with the programs that declare it alike."""
    users: dict[str, list[str]] = {}
    for program in programs:
        for option in program["options"]["properties"].items():
            users.setdefault(json.dumps(option), []).append(program["program"])
    yield from (("option", "values", "default", "units", "meaning", "programs"), ("---",) * 6)
    for option, names in sorted(users.items(), key=lambda item: -len(item[1])):
        name, schema = json.loads(option)
        default = (
            str(schema["default"]).lower() if schema.get("type") == "boolean" else f"{schema['default']}"
        )
        by = "all" if len(names) == len(programs) else ", ".join(f"`{each}`" for each in names)
        yield f"`--{name}`", schema["allowed"], default, schema.get("units", ""), schema["description"], by


def quantities(programs: list[dict[str, Any]]) -> Iterable[tuple[str, ...]]:
    yield from (("program", "quantity", "units", "meaning"), ("---",) * 4)
    for program in programs:
        for quantity in program["quantities"]:
            axes = ", ".join(axis["name"] for axis in quantity["axes"])
            label = f"`{quantity['name']}`{f' [{axes}]' if axes else ''}"
            yield f"`{program['program']}`", label, quantity["units"], quantity["description"]


def on_files(files: Files, config: MkDocsConfig) -> Files:
    for source, page in TOP.items():
        text = (ROOT / source).read_text("utf-8").replace("(docs/", "(").replace("(README.md", "(index.md")
        files.append(File.generated(config, page, content=text))
    return files


def on_page_markdown(markdown: str, **_: Any) -> str:
    programs = [*described().values()]
    for name, rows in {"options": options(programs), "quantities": quantities(programs)}.items():
        lines = (" | ".join(re.sub(r"[|<]", r"\\\g<0>", cell) for cell in row) for row in rows)
        table = "\n".join(f"| {line} |" for line in lines)
        markdown = markdown.replace(f"<!-- table of {name} -->", table)
    return markdown
