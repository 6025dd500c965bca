"""Writes docs/gallery, small pictures of all panels and of the verdicts, and the answer at the top of README.md: for those
who look at the project before they run it.

Every panel is taken from the highest quality that is here as its job wrote it. A small picture keeps what the panel says
of itself, so that `make status` knows when it is older than the code.
"""

import argparse
import io
import json
import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from PIL import Image
from PIL.PngImagePlugin import PngInfo

from workflow.claims.data import Data
from workflow.claims.judge import judge_all
from workflow.lib import style
from workflow.lib.parents import caption_of
from workflow.lib.plan import QUALITIES, Panel, drawings_of
from workflow.lib.strict_yaml import ConfigurationError
from workflow.provenance.lock import Lock, LockError
from workflow.provenance.repository import ROOT, write_whole
from workflow.provenance.status import GALLERY
from workflow.report import content, summary
from workflow.report.sources import Products, ReportError, source_hashes

README = "README.md"
BLOCK = re.compile(r"(?<=<!-- answer, by make gallery -->\n).*?(?=<!-- end of the answer -->)", re.DOTALL)
COLUMNS, COLORS = 720, 64  # of a small picture


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


def made(root: Path) -> dict[str, Products]:
    """By quality, the highest first, where there is a lock that can be read."""
    found = {}
    for quality in reversed(QUALITIES):
        with suppress(LockError):
            found[quality] = Products(root, Lock.read(quality))
    return found


def best(panel: Panel, products: Mapping[str, Products]) -> tuple[str, list[Path]] | None:
    """The highest quality at which the panel is here as its job wrote it, with the paths of its drawings."""
    for quality, one in products.items():
        with suppress(ReportError):
            return quality, [one.file(path) for path in drawings_of(quality, panel.name)]
    return None


def picture_of_summary(claims: list[dict[str, Any]], parents: dict[str, Any], place: Path) -> None:
    style.apply()
    described = json.dumps(parents, sort_keys=True)
    summary.draw(claims).savefig(
        place, dpi=130, metadata={"Description": described, "Software": "lorentz-gas"}
    )


def written(answer: list[str]) -> str:
    sentences = "\n".join(f"{number}. {text}" for number, text in enumerate(answer, 1))
    return f"\n{sentences}\n\n"


def gallery(quality: str, root: Path = ROOT) -> Iterator[str]:
    """Writes all of it; yields a line per panel. quality: of the answer and the verdicts. Raises ReportError."""
    data = Data(quality, root)
    judgements = judge_all(data)
    readme = (root / README).read_text()
    if not BLOCK.search(readme):
        raise ReportError(
            f"{README} has no place for the answer: restore its lines '<!-- ... the answer -->'"
        )
    folder = root / GALLERY
    folder.mkdir(parents=True, exist_ok=True)
    lines, products = [], made(root)
    for panel in data.plan.values():
        found = best(panel, products)
        if found is None:
            yield f"{panel.name} has not been made: run make figures"
            continue
        quality_there, (_, png, _, csv) = found
        (folder / f"{panel.name}.png").write_bytes(small(png))
        title = csv.read_text().split("\n", 1)[0].removeprefix("# ")
        lines.append(
            f"## {panel.name}\n\n![{title}]({panel.name}.png)\n\n**{title}** (quality {quality_there}). {caption_of(csv)}\n"
        )
        yield f"{panel.name}: quality {quality_there}"
    claims = [content.claim(one, {}) for one in judgements]
    parents = {"quality": quality, "sources": source_hashes(root)}
    picture_of_summary(claims, parents, folder / "summary.png")
    head = (
        f"# Gallery\n\nMade by `make gallery`.\n\n![Verdicts on the claims, quality {quality}](summary.png)\n"
    )
    write_whole(folder / "README.md", "\n".join([head, *lines]))
    text = written(content.answer(judgements, quality))
    write_whole(root / README, BLOCK.sub(lambda _: text, readme))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True, help="of the verdicts")
    try:
        for line in gallery(parser.parse_args().quality):
            print(line)
    except ConfigurationError as error:
        print(f"make gallery: {error}", file=sys.stderr)
        sys.exit(2)
    except ReportError as error:
        sys.exit(f"make gallery: {error}")


if __name__ == "__main__":
    main()
