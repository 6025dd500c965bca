"""Writes the report of a selection, figures/QUALITY/report.html with all pictures in it, or the release's page
docs/gallery/README.md with pictures beside it and all numbers in numbers.csv. Equal inputs give equal bytes.
"""

import argparse
import base64
import re
import sys
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import jinja2
import pandas as pd

from workflow.lib.columns import TableError, as_text
from workflow.lib.identity import ROOT, panel_of, sha256
from workflow.lib.load import FormatError, cpu_seconds, load
from workflow.pipeline.configuration import ConfigurationError
from workflow.pipeline.plan import Panel, Plan, runs_of
from workflow.render.files import format_os_error, write_atomically
from workflow.render.record import NUMBERS, identity_line, read_record
from workflow.render.save import commit, reduced, write_product
from workflow.study import typeset
from workflow.study.judge import KINDS, Judgement, changed, judge_all, of_release
from workflow.study.results import Results
from workflow.study.verdict import Outcome

GALLERY = "docs/gallery"
SIGNS = {Outcome.REPRODUCED: "✓", Outcome.CONTRADICTED: "✗", Outcome.UNDECIDED: "?"}
MOST_NUMBERS = 12  # numbers of a claim in the report; of more, only the one that is closest to the band's edge or farthest outside
INCH = 96  # pixels, as in CSS: one scale for all pictures
SINGLE, DOUBLE = 4, 7  # inches: widest picture beside which stands a caption in half a page, or in a page


def rendered(judgements: Sequence[Judgement], plan: Plan, root: Path, *, release: bool) -> bytes:
    """The page. root: folder of the project; release: the gallery's page, with pictures in files beside it.
    Raises OSError."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["typeset"] = typeset.typeset
    selection = plan.selection
    found = {} if release else of_release(selection.name, root)
    rows = [shown(judgement) for judgement in judgements]
    for row in rows:
        row["release"] = found.get((row["numbers"], row["kind"])) if row["outcome"] == "undecided" else None
    page = environment.get_template("page.html.j2").render(
        release=release,
        quality=selection.name,
        effort=selection.arguments,
        kinds=KINDS,
        outcomes=[*Outcome],
        rows=rows,
        figures=by_figure(rows),
        row={f"{row['numbers']} {row['kind']}": row for row in rows},
        panels=[context(panel, root, release=release) for panel in plan],
        with_bands=[(text, changed(judgements, factor)) for text, factor in (("half", 0.5), ("twice", 2))],
    )
    return page.encode()


def context(panel: Panel, root: Path, *, release: bool) -> dict[str, Any]:
    """A panel with its picture, and what it is made from, for the template. Raises OSError."""
    record = read_record(root / panel.record_path)
    content = (root / f"{panel.stem}.svg").read_bytes()
    picture, (width, height) = base64.b64encode(content).decode(), inches(content)
    runs = {} if release else runs_of([panel])
    return record | {
        "name": panel.name,
        "study": panel.study,
        "size": "narrow" if width <= SINGLE else "medium" if width <= DOUBLE else "wide",
        "width": round(width * INCH),
        "height": round(height * INCH),
        "address": f"{panel.name}.png" if release else f"data:image/svg+xml;base64,{picture}",
        "runs": [
            (panel_of(path), f"{run.program} {run.options_text}", cpu_seconds(root / path))
            for path, run in runs.items()
        ],
        "sources": [path for path in record["parents"] if not path.endswith(".h5")],
    }


def inches(picture: bytes) -> tuple[float, float]:
    """Width and height of an SVG, which states them in points."""
    found = re.search(rb'width="([\d.]+)pt" height="([\d.]+)pt"', picture)
    if not found:
        raise FormatError(
            "an SVG of the panels states no size in points: remove the figures and make them again"
        )
    return float(found[1]) / 72, float(found[2]) / 72


def by_figure(rows: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """The answer on every figure of the paper, with the rows that need an account. The outcome of a statement
    is that of its intended meaning, where it has one."""
    figures = defaultdict(list)
    for row in rows:
        if named := re.match(r"fig(\d+)", row["panel"]):
            figures[int(named[1])].append(row)
    answers = []
    for number, own in sorted(figures.items()):
        meant = {row["numbers"]: row for row in own}  # intended meanings come after literal statements
        wrong = [row for row in meant.values() if row["outcome"] == Outcome.CONTRADICTED]
        literal = [row for row in own if row["outcome"] == Outcome.CONTRADICTED and row not in wrong]
        undecided = [row for row in meant.values() if row["outcome"] == Outcome.UNDECIDED]
        if wrong:
            outcome, answer = Outcome.CONTRADICTED, "differs"
        elif not undecided:
            outcome, answer = Outcome.REPRODUCED, "reproduced" + ", but not literally" * bool(literal)
        else:
            outcome = Outcome.UNDECIDED
            answer = "undecided" if len(undecided) == len(meant) else "partly undecided"
        for row in literal:
            row["meant"] = (
                meant[row["numbers"]] if meant[row["numbers"]]["outcome"] == Outcome.REPRODUCED else None
            )
        told = {"rows": wrong + literal, "undecided": undecided}
        answers.append({"number": number, "outcome": outcome, "answer": answer} | told)
    return answers


def shown(judgement: Judgement) -> dict[str, Any]:
    """A row of the table of claims with its verdict, for the template. least, most: its smallest and
    largest number."""
    verdict = judgement.verdict
    numbers = sorted(verdict.numbers, key=lambda number: number.value)
    listed = verdict.numbers if len(numbers) <= MOST_NUMBERS else [verdict.decisive]
    return dict(judgement.row) | {
        "outcome": verdict.outcome,
        "sign": SIGNS[verdict.outcome],
        "band": typeset.acceptance(verdict.band),
        "value": typeset.value(verdict.decisive) if numbers else "not measured",
        "label": verdict.decisive.label if numbers else "",
        "list": [
            (number.label, typeset.value(number), verdict.outcome_of(number).value) for number in listed
        ],
        "omitted": len(numbers) - len(listed),
        "others": len(numbers) - 1,
        "outside": sum(verdict.outcome_of(number) is Outcome.CONTRADICTED for number in numbers),
        "least": typeset.value(numbers[0]) if numbers else "",
        "most": typeset.value(numbers[-1]) if numbers else "",
        "missing": judgement.missing,
        "meant": None,
    }


def numbers_file(judgements: Sequence[Judgement]) -> bytes:
    """CSV with one line per number of every claim. Raises TableError if it would be read as another table."""
    lines = [
        {
            "claim": judgement.row["numbers"],
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


def write(selection: str, root: Path = ROOT, *, gallery: bool = False) -> None:
    """Writes the report, or the gallery. Raises ConfigurationError, FormatError, OSError."""
    plan = Plan(selection)
    results = Results(load(root / path) for path in runs_of(plan))
    judgements = judge_all(results, root)
    if not gallery:
        report, name = plan.report, plan.selection.name
        assert report
        line = f"<!-- {identity_line(report.name, name, report.identity)} -->\n".encode()
        page = rendered(judgements, plan, root, release=False) + line
        record: dict[str, Any] = {"panel": report.name, "quality": name, "identity": report.identity}
        record |= {"commit": commit()}
        record["parents"] = {
            path: sha256((root / path).read_bytes()) for path in report.parents
        } | report.sources
        write_product(root / report.stem, report.identity, {"html": page}, record)
        return
    folder = root / GALLERY
    pictures = {folder / f"{panel.name}.png": reduced(root / f"{panel.stem}.png") for panel in plan}
    page = rendered(judgements, plan, root, release=True)
    write_atomically(pictures | {folder / "README.md": page, root / NUMBERS: numbers_file(judgements)})
    for former in {*folder.glob("*.png")} - pictures.keys():
        former.unlink()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("selection", help="quality, with an effort as standard_seed=7")
    parser.add_argument("--gallery", action="store_true", help="write the gallery instead of the report")
    options = parser.parse_args()
    try:
        write(options.selection, gallery=options.gallery)
    except (ConfigurationError, FormatError, TableError) as error:
        sys.exit(f"make report: {error}")
    except OSError as error:
        sys.exit(f"make report: {format_os_error(error)}")


if __name__ == "__main__":
    main()
