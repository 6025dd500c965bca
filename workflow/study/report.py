"""Writes the report of a quality, figures/QUALITY/report.html with all pictures in it, or the release's page
docs/gallery/README.md with pictures beside it and all numbers in numbers.csv. Equal inputs give equal bytes.
"""

import argparse
import base64
import re
import sys
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import jinja2
import pandas as pd

from workflow.lib.columns import TableError, as_text
from workflow.lib.identity import ROOT
from workflow.lib.load import FormatError, load
from workflow.lib.text import listed
from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.plan import Panel, Plan, runs_of
from workflow.render.files import format_os_error, write_atomically
from workflow.render.record import identity_line, read_record
from workflow.render.save import commit, write_product
from workflow.study import typeset
from workflow.study.judge import KINDS, PRINTED, Judgement, changed, judge_all
from workflow.study.results import Results
from workflow.study.verdict import Outcome

GALLERY = "docs/gallery"
SIGNS = dict(zip(Outcome, "✓≈✗?", strict=True))
MOST_NUMBERS = 12  # of a statement in the report; of more, only the decisive one
INCH = 96  # pixels, as in CSS
NARROW = 4  # inches: width of pictures that share a row


def rendered(judgements: Sequence[Judgement], plan: Plan, root: Path, *, release: bool) -> bytes:
    """The report, or the gallery's page, with pictures in files beside it. root: folder of the project.
    Raises OSError."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {"typeset": typeset.typeset, "markdown": typeset.markdown}
    quality = plan.quality
    rows = [*map(shown, judgements)]
    figures = defaultdict(list)
    for row in rows:
        figures[typeset.figure_of(row["panel"])].append(row)
    page = environment.get_template("gallery.md.j2" if release else "report.html.j2").render(
        quality=quality.name,
        counts=[count(rows, kind) for kind in KINDS],
        rows=rows,
        figures=figures,
        panels=[context(panel, root) for panel in plan.reported],
        with_bands=[(text, changed(judgements, factor)) for text, factor in (("half", 0.5), ("twice", 2))],
    )
    return page.encode()


def count(rows: Sequence[Mapping[str, Any]], kind: str) -> tuple[int, str]:
    """Number of statements of this kind, and by verdict: `20 reproduced (✓) and 3 contradicted (✗)`."""
    own = [row["outcome"] for row in rows if row["kind"] == kind]
    return len(own), listed(f"{own.count(one)} {one.value} ({SIGNS[one]})" for one in Outcome if one in own)


def context(panel: Panel, root: Path) -> dict[str, Any]:
    """A panel with its picture for the template. Raises OSError."""
    record = read_record(root / panel.record_path)
    content = (root / f"{panel.stem}.svg").read_bytes()
    width = inches(content)
    return record | {
        "name": panel.name,
        "study": panel.study,
        "size": "narrow" if width <= NARROW else "wide",
        "width": round(width * INCH),
        "picture": base64.b64encode(content).decode(),
    }


def inches(picture: bytes) -> float:
    """Width of an SVG, which states it in points."""
    found = re.search(rb'width="([\d.]+)pt"', picture)
    if not found:
        raise FormatError(
            "an SVG of the panels states no size in points: remove the figures and make them again"
        )
    return float(found[1]) / 72


def shown(judgement: Judgement) -> dict[str, Any]:
    """A statement with its verdict, for the template."""
    row, verdict = judgement.row, judgement.verdict
    printed = row["kind"] == PRINTED
    name = row["number"] if printed else f"{row['number']} {row['kind']}"
    listed = verdict.numbers if len(verdict.numbers) <= MOST_NUMBERS else [verdict.decisive]
    return dict(row) | {
        "anchor": name.lower().replace(" ", "-"),
        "name": name,
        "outcome": verdict.outcome,
        "style": verdict.outcome.name.lower(),
        "sign": SIGNS[verdict.outcome],
        "band": typeset.acceptance(verdict.band),
        "nearly": typeset.acceptance(verdict.nearly) if verdict.nearly else "",
        "value": typeset.value(verdict.decisive) if verdict.numbers else "not measured",
        "label": verdict.decisive.label if verdict.numbers else "",
        "list": [
            (number.label, typeset.value(number), verdict.outcome_of(number).value) for number in listed
        ],
        "omitted": len(verdict.numbers) - len(listed),
        "outside": sum(verdict.outcome_of(number) is Outcome.CONTRADICTED for number in verdict.numbers),
        "missing": judgement.missing,
    }


def numbers_file(judgements: Sequence[Judgement]) -> bytes:
    """CSV with one line per number of every statement. Raises TableError if it would be read as another
    table."""
    lines = [
        {
            "claim": judgement.row["number"],
            "kind": judgement.row["kind"],
            "claim_verdict": judgement.verdict.outcome.value,
            "quantity": number.label,
            "value": number.value,
            "error": number.error,
            "systematic": number.systematic,
            "number_verdict": judgement.verdict.outcome_of(number).value,
        }
        for judgement in judgements
        for number in judgement.verdict.numbers
    ]
    return as_text(pd.DataFrame(lines), digits=6).encode()


def write(quality: str, root: Path = ROOT, *, gallery: bool = False) -> None:
    """Writes the report, or the gallery. Raises ConfigurationError, FormatError, OSError."""
    plan = Plan(quality)
    results = Results(load(root / path) for path in runs_of(plan.reported))
    judgements = judge_all(results, root)
    if not gallery:
        report, name = plan.report, plan.quality.name
        assert report
        line = f"<!-- {identity_line(report.name, name, report.identity)} -->\n".encode()
        page = rendered(judgements, plan, root, release=False) + line
        record: dict[str, Any] = {"panel": report.name, "quality": name, "identity": report.identity}
        record |= {"commit": commit()}
        record |= {"parents": report.parents, "sources": report.sources}
        write_product(root / report.stem, report.identity, {"html": page}, record)
        return
    folder = root / GALLERY
    pictures = {
        folder / f"{panel.name}.png": (root / f"{panel.stem}.png").read_bytes() for panel in plan.reported
    }
    page = rendered(judgements, plan, root, release=True)
    write_atomically(
        pictures | {folder / "README.md": page, folder / "numbers.csv": numbers_file(judgements)}
    )
    for former in {*folder.glob("*.png")} - pictures.keys():
        former.unlink()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("quality", help="quality, with an effort as standard_seed=7")
    parser.add_argument("--gallery", action="store_true", help="write the gallery instead of the report")
    options = parser.parse_args()
    try:
        write(options.quality, gallery=options.gallery)
    except (ConfigurationError, FormatError, TableError) as error:
        sys.exit(f"make report: {error}")
    except OSError as error:
        sys.exit(f"make report: {format_os_error(error)}")


if __name__ == "__main__":
    main()
