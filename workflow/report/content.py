"""The content of the report, from verdicts and products; its looks are up to the templates."""

import base64
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from workflow.claims.data import Data, MissingError
from workflow.claims.judge import Judgement
from workflow.lib import style
from workflow.lib.configuration import read
from workflow.lib.plan import Panel
from workflow.provenance.checks import worst_error
from workflow.report import words
from workflow.report.misprints import NUMBERS
from workflow.report.sources import Costs, Products, total
from workflow.report.strip import strip_of

HERE = Path(__file__).parent
WIDE = 1.3  # columns of a journal beyond which a panel has a line of the page for itself
READINGS = ("literal", "intended", "alternative")


def claim(judgement: Judgement, costs: Costs) -> dict[str, Any]:
    readings = {name: getattr(judgement, name) for name in READINGS if getattr(judgement, name)}
    deciding, shown = judgement.deciding, judgement.shown
    runs = [path.removesuffix(".h5").split("/", 2)[2] for path in judgement.data]
    return dict(judgement.claim) | {
        "outcome": judgement.outcome.value,
        "sign": words.SIGNS[judgement.outcome],
        "ours": words.result(deciding) if deciding else "no data",
        "short": words.value(shown.worst) if shown else "no data",
        "label": shown.worst.label if shown else "",
        "acceptance_band": next(
            (judgement.claim[name] for name, one in readings.items() if one is shown), ""
        ),
        "readings": [
            {
                "name": words.READINGS[name],
                "band": judgement.claim[name],
                "outcome": reading.outcome.value,
                "result": words.result(reading),
                "p": words.p_value(reading.p_value),
            }
            for name, reading in readings.items()
        ],
        "p": words.p_value(deciding.p_value) if deciding else "",
        "caveat": judgement.caveat,
        "consequence": words.consequence(judgement),
        "strip": strip_of(shown) if shown else None,
        "cost": total(costs, runs) if runs else None,
    }


def panel(quality: str, panel: Panel, products: Products, costs: Costs) -> dict[str, Any]:
    """A panel as it was drawn. Raises ReportError."""
    record = products.record(panel.name)
    svg = next(
        products.file(f"figures/{quality}/{name}") for name in record["files"] if name.endswith(".svg")
    )
    for name in record["files"]:
        products.file(f"figures/{quality}/{name}")
    return {
        "name": panel.name,
        "title": record["title"],
        "caption": record["caption"],
        "wide": _width(svg) > WIDE * style.COLUMN,
        "picture": base64.b64encode(svg.read_bytes()).decode(),
        "uses": panel.uses,
        "runs": len(panel.runs),
        "cost": total(costs, [f"{panel.name}/{run.name}" for run in panel.runs]) if panel.runs else None,
        "error": worst_error(quality, panel),
        "parents": record["parents"].inputs(),
        "outputs": record["files"],
    }


def _width(svg: Path) -> float:
    """Of a drawing, in inches."""
    found = re.search(r'<svg [^>]*width="([0-9.]+)pt"', svg.read_text())
    return float(found[1]) / 72 if found else 0.0


def terms() -> list[tuple[str, str]]:
    """Symbols and words with what they mean, in the order in which a reader meets them."""
    return [(term, meaning) for term, meaning in read(HERE, "terms.yaml").content]


def findings(judgements: Sequence[Judgement]) -> list[dict[str, Any]]:
    """Those of findings.yaml that the data bear out."""
    by_id = {one.claim["id"]: one for one in judgements}
    held = []
    for finding in read(HERE, "findings.yaml").content:
        judgement = by_id[finding["claim"]]
        reading = getattr(judgement, finding["reading"])
        if reading and reading.outcome.value == finding["outcome"]:
            text = finding["text"].format(
                number=words.told(reading.worst), numbers=words.told_all(reading), caveat=judgement.caveat
            )
            held.append(
                finding
                | {"text": text, "p": words.p_value(reading.p_value), "panel": judgement.claim["panel"]}
            )
    return held


def misprints(judgements: Sequence[Judgement], data: Data) -> list[dict[str, Any]]:
    by_id = {one.claim["id"]: one for one in judgements}
    rows = read(HERE, "misprints.yaml").content
    return [row | {"shown": _shown(row, by_id, data)} for row in rows]


def _shown(row: Mapping[str, str], by_id: Mapping[str, Judgement], data: Data) -> str:
    if "claim" in row:
        reading = by_id[row["claim"]].literal
        return words.told(reading.worst) if reading else "no data"
    try:
        return words.told(NUMBERS[row["number"]](data)) if "number" in row else ""
    except MissingError as error:
        return str(error)


def environment(records: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """Versions that made the products."""
    parents = [record["parents"] for record in records]
    builds = [build for one in parents for build in one.builds.values()]
    names = ("compiler", "flags", "libraries")
    return {name: sorted({build[name] for build in builds}) for name in names} | {
        "Python": sorted({one.python for one in parents})
    }
