"""How what the report says is written: by the templates in pages."""

from pathlib import Path
from typing import Any

import jinja2

from workflow.report import words


def written(template: str, **context: Any) -> str:
    """The template NAME.j2, in which every name of the context is known. Text is escaped in what becomes HTML."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / "pages"),
        autoescape=template.endswith(".html"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {"typeset": words.typeset, "linked": words.linked}
    return environment.get_template(f"{template}.j2").render(context)
