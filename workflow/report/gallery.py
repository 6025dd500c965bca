"""Writes docs/gallery, small pictures and the tables of all panels and the verdicts, and the answer at the top of README.md: for
those who look at the project before they run it.

Every panel is taken from the highest quality that is here as it was written.
"""

import argparse
import io
import json
import sys
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from PIL import Image
from PIL.PngImagePlugin import PngInfo

from workflow.claims.data import Data
from workflow.lib import style
from workflow.lib.caption import listed
from workflow.lib.configuration import ConfigurationError
from workflow.lib.figure_metadata import ROOT
from workflow.lib.files import write_together
from workflow.lib.plan import QUALITIES, Panel
from workflow.report import content, summary
from workflow.report.answer import answer
from workflow.report.sources import Products, ReportError, source_hashes
from workflow.report.templates import written

README = "README.md"
GALLERY = "docs/gallery"
BLOCKS = ("answer", "panels")  # of README.md, each by a template of its own
COLUMNS, COLORS = 720, 256  # of a small picture


def small(picture: Path) -> bytes:
    """PNG with few columns and colours, and the texts of the original."""
    with Image.open(picture, formats=["PNG"]) as original:
        texts = PngInfo()
        for name, text in original.info.items():
            if isinstance(name, str) and isinstance(text, str):
                texts.add_text(name, text)
        rows = round(original.height * COLUMNS / original.width)
        scaled = original.convert("RGB").resize((COLUMNS, rows), Image.Resampling.LANCZOS)
        content = io.BytesIO()
        scaled.quantize(COLORS, dither=Image.Dither.NONE).save(content, "PNG", optimize=True, pnginfo=texts)
        return content.getvalue()


def best(panel: Panel, root: Path) -> Products | None:
    """Of the highest quality at which the panel is here as it was written."""
    for quality in reversed(QUALITIES):
        products = Products(root, quality)
        with suppress(ReportError):
            for name in products.record(panel.name)["files"]:
                products.file(f"figures/{quality}/{name}")
            return products
    return None


def picture_of_summary(claims: list[dict[str, Any]], parents: dict[str, Any]) -> bytes:
    """parents: what is stated in the file; its quality is in the picture too."""
    style.apply()
    described, picture = json.dumps(parents, sort_keys=True), io.BytesIO()
    metadata = {"Description": described, "Software": "lorentz-gas"}
    summary.draw(claims, parents["quality"]).savefig(picture, format="png", dpi=130, metadata=metadata)
    return picture.getvalue()


def with_blocks(readme: str, context: Mapping[str, Any]) -> str:
    """README.md with what stands between its marks written anew. Raises ReportError if one is missing."""
    page = f"{GALLERY}/{README}"
    links = {"panel_link": f"{page}#%s", "claims_page": page}
    for name in BLOCKS:
        first, last = f"<!-- {name}, by make gallery -->\n", f"<!-- end of the {name} -->"
        before, opened, rest = readme.partition(first)
        _, closed, after = rest.partition(last)
        if not (opened and closed):
            raise ReportError(
                f"{README} has no place for the {name}: restore the line '{(last if opened else first).strip()}'"
            )
        readme = before + first + written(f"readme_{name}.md", **{**context, **links}) + last + after
    return readme


def gallery(quality: str, root: Path = ROOT) -> list[str]:
    """Writes all of it, or nothing; a line per panel. quality: of the answer and the verdicts. Raises ReportError."""
    data, here, folder = Data(quality, root), Products(root, quality), root / GALLERY
    pictures = {name: found for name, panel in data.plan.items() if (found := best(panel, root))}
    if missing := [name for name in data.plan if name not in pictures]:
        raise ReportError(
            f"{listed(missing)}: not made, or not as it was written; run make figures QUALITY={quality}"
        )
    judgements = here.judged(data)
    panels, files = [], {}
    for name, products in pictures.items():
        stem, record = root / "figures" / products.quality / name, products.record(name)
        files[folder / f"{name}.png"] = small(stem.with_suffix(".png"))
        for kind in (".csv", ".json"):
            files[folder / f"{name}{kind}"] = stem.with_suffix(kind).read_bytes()
        panels.append(
            {key: record[key] for key in ("title", "caption")} | {"name": name, "quality": products.quality}
        )
    claims = [content.claim(one, {}) for one in judgements]
    parents = {"quality": quality, "sources": source_hashes(root)}
    files[folder / "summary.png"] = picture_of_summary(claims, parents)
    context = {
        "quality": quality,
        "answer": answer(judgements, quality),
        "place_of_panels": f"{GALLERY}/",
        "panel_link": "#%s",
        "findings": content.findings(judgements),
        "misprints": content.misprints(judgements, data),
        "terms": content.terms(),
        "claims": claims,
        "panels": panels,
    }
    files[folder / README] = written("gallery.md", **context).encode()
    files[root / README] = with_blocks((root / README).read_text(), context).encode()
    folder.mkdir(parents=True, exist_ok=True)
    write_together(files)
    return [f"{panel['name']}: quality {panel['quality']}" for panel in panels]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True, help="of the verdicts")
    try:
        print(*gallery(parser.parse_args().quality), sep="\n")
    except ConfigurationError as error:
        print(f"make gallery: {error}", file=sys.stderr)
        sys.exit(2)
    except ReportError as error:
        sys.exit(f"make gallery: {error}")


if __name__ == "__main__":
    main()
