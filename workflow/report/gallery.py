"""Writes docs/gallery (pictures, tables, verdicts) and the marked parts of README.md and docs/index.md, from the products of one quality."""

import argparse
import io
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from PIL import Image
from PIL.PngImagePlugin import PngInfo

from workflow.configuration import ConfigurationError
from workflow.files import write_together
from workflow.identity import ROOT, sha256
from workflow.lib.save import as_text
from workflow.publish import read_record
from workflow.report.content import content
from workflow.report.sources import ReportError
from workflow.report.templates import rendered

README, INDEX, GALLERY = "README.md", "docs/index.md", "docs/gallery"
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


def gallery(quality: str, root: Path = ROOT) -> None:
    """Writes the gallery and the marked parts of the front pages. Raises ReportError."""
    context, folder = content(quality, root), root / GALLERY
    front = {root / name: with_parts(name, (root / name).read_text(), context).encode() for name in FRONT}
    files = {folder / README: rendered("gallery.md", **context).encode()}
    for name, panel in context["panels"].items():
        picture = files[folder / f"{name}.png"] = small(Path(f"{panel['stem']}.png"))
        files[folder / f"{name}.csv"] = Path(f"{panel['stem']}.csv").read_bytes()
        record = read_record(f"{panel['stem']}.json")
        record["files"]["gallery"] = sha256(picture)
        files[folder / f"{name}.json"] = as_text(record).encode()
    for claim in context["claims"]:
        files[folder / "claims" / f"{claim['id']}.svg"] = rendered("strip.svg", claim=claim).encode()
    write_together(files | front)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    try:
        gallery(parser.parse_args().quality)
    except (ConfigurationError, ReportError) as error:
        sys.exit(f"make gallery: {error}")


if __name__ == "__main__":
    main()
