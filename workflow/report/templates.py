"""Renders the templates in pages."""

from pathlib import Path
from typing import Any

import jinja2

from workflow.report import words


def rendered(template: str, **context: Any) -> str:
    """`pages/<template>.j2`. An unknown name is an error; text is escaped in HTML and SVG."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / "pages"),
        autoescape=template.endswith((".html", ".svg")),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {"typeset": words.typeset, "cell": words.cell}
    return environment.get_template(f"{template}.j2").render(context)
