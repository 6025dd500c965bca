"""Writes docs/gallery (pictures, tables, verdicts) and the marked parts of README.md and docs/index.md, from the products of one quality."""

import io
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from PIL import Image
from PIL.PngImagePlugin import PngInfo

from workflow.lib.command import product_command
from workflow.lib.configuration import ConfigurationError
from workflow.lib.files import ROOT, write_together
from workflow.lib.record import write_with_record
from workflow.report.content import content
from workflow.report.sources import ReportError
from workflow.report.templates import rendered

README = (
    f"{'README'}.md"  # written, not read for its content: a literal with its path would count as a source
)
GALLERY = "docs/gallery"
INDEX = str(Path(GALLERY).with_name("index.md"))  # front page of the documentation
# Pages with marked parts, each of which has a template: the relative path from page to gallery, and the names of the parts.
FRONT = {
    README: (f"{GALLERY}/", ("answer", "questions", "panels")),
    INDEX: ("gallery/", ("answer", "questions")),
}
WIDTH, COLORS = 1440, 256  # largest width in pixels, number of colours


def small(picture: Path) -> bytes:
    """PNG with few colours, at most WIDTH wide, and the texts of the original."""
    with Image.open(picture, formats=["PNG"]) as original:
        texts = PngInfo()
        for name, text in original.info.items():
            if isinstance(name, str) and isinstance(text, str):
                texts.add_text(name, text)
        width = min(WIDTH, original.width)
        size = (width, round(original.height * width / original.width))
        scaled = original.convert("RGB").resize(size, Image.Resampling.LANCZOS)
        content = io.BytesIO()
        scaled.quantize(COLORS, dither=Image.Dither.NONE).save(content, "PNG", optimize=True, pnginfo=texts)
        return content.getvalue()


def with_parts(name: str, page: str, context: Mapping[str, Any]) -> str:
    """The page with the text between its marks replaced. Raises ReportError if a mark is missing."""
    way, parts = FRONT[name]
    for part in parts:
        first, last = f"<!-- {part}, by make gallery -->\n", f"<!-- end of the {part} -->"
        before, opened, rest = page.partition(first)
        _, closed, after = rest.partition(last)
        if not (opened and closed):
            missing = (last if opened else first).strip()
            raise ReportError(f"{name} has no line '{missing}', which marks the {part}; restore it")
        page = before + first + rendered(f"front_{part}.md", **context, gallery=way) + last + after
    return page


def gallery(quality: str, identity: str, root: Path = ROOT) -> None:
    """Writes the gallery and the marked parts of the front pages. Raises ReportError."""
    context, folder = content(quality, root), root / GALLERY
    front = {root / name: with_parts(name, (root / name).read_text(), context).encode() for name in FRONT}
    files = {folder / README: rendered("gallery.md", **context).encode()}
    for name, panel in context["panels"].items():
        stem = root / "figures" / quality / name
        files[folder / f"{name}.png"] = small(stem.with_suffix(".png"))
        files[folder / f"{name}.csv"] = stem.with_suffix(".csv").read_bytes()
        files[folder / f"{name}.json"] = panel["record"].read_bytes()
    for claim in context["claims"]:
        files[folder / "claims" / f"{claim['id']}.svg"] = rendered("strip.svg", claim=claim).encode()
    write_together(front)
    write_with_record(folder / "gallery", identity, files, {"quality": quality})


def main() -> None:
    options = product_command(__doc__)
    try:
        gallery(options.quality, options.identity)
    except (ConfigurationError, ReportError) as error:
        sys.exit(f"make gallery: {error}")


if __name__ == "__main__":
    main()
