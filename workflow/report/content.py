"""The content of report and gallery, from verdicts and products. Templates define the layout."""

import base64
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from workflow.claims.data import Data
from workflow.claims.judge import READINGS, Judgement
from workflow.claims.verdict import Outcome
from workflow.configuration import read
from workflow.identity import content_hash
from workflow.lib import style
from workflow.plan import REPORT_SOURCES, Panel, Quality
from workflow.report import numbers, words
from workflow.report.citation import citation
from workflow.report.questions import answers
from workflow.report.sources import Products
from workflow.report.strip import strip_of

HERE = Path(__file__).parent
WIDE = 1.3  # columns of a journal; a wider panel takes the full width of the page


def content(quality: str, root: Path) -> dict[str, Any]:
    """Variables of the templates. Raises ReportError."""
    data = Data(quality, root)
    products = Products(root, quality, data.plan)
    judgements = products.judged(data)
    counts = Counter(judgement.outcome for judgement in judgements)
    context = {
        "quality": quality,
        "effort": Quality.of(quality).arguments,
        "answers": answers(judgements, data),
        "counts": [
            (words.SIGNS[outcome], counts[outcome], outcome.value) for outcome in Outcome if counts[outcome]
        ],
        "claims": [claim(judgement) for judgement in judgements],
        "misprints": misprints(judgements, data),
        "terms": read(HERE, "terms.yaml").content,
        "panels": {name: panel(planned, products) for name, planned in data.plan.items()},
        "citation": citation(root),
    }
    for path in data.used:
        products.read(path)
    sources = {path: content_hash(path) for path in REPORT_SOURCES}
    return context | {"parents": {"products": products.used, "sources": sources}}


def claim(judgement: Judgement) -> dict[str, Any]:
    shown = judgement.deciding
    readings = {name: getattr(judgement, name) for name in READINGS if getattr(judgement, name)}
    return dict(judgement.claim) | {
        "outcome": judgement.outcome.value,
        "kind": judgement.outcome.name.lower(),
        "sign": words.SIGNS[judgement.outcome],
        "value": words.value(shown.worst) if shown else "no data",
        "label": shown.worst.label if shown else "",
        "band": words.acceptance(shown.band) if shown else "",
        "readings": [
            {
                "name": words.READINGS[name],
                "band": words.acceptance(reading.band),
                "outcome": reading.outcome.value,
                "value": words.value(reading.worst),
                "which": words.which(reading),
                "p": words.p_value(reading.p_value),
            }
            for name, reading in readings.items()
        ],
        "consequence": words.consequence(judgement),
        "caveat": judgement.caveat,
        "strip": strip_of(shown) if shown else None,
    }


def panel(panel: Panel, products: Products) -> dict[str, Any]:
    """Title, caption, picture and parents of a panel for the templates. Raises ReportError."""
    record = products.record(panel.name)
    stem = products.stem(panel.name)
    svg = products.read(f"{stem}.svg").decode()
    width = re.search(r'<svg [^>]*width="([0-9.]+)pt"', svg)
    return {
        "name": panel.name,
        "title": record["title"],
        "caption": record["caption"],
        "wide": bool(width and float(width[1]) / 72 > WIDE * style.COLUMN),
        "picture": base64.b64encode(svg.encode()).decode(),
        "parents": record["parents"],
        "stem": products.root / stem,
    }


def misprints(judgements: Sequence[Judgement], data: Data) -> list[dict[str, Any]]:
    by_id = {judgement.claim["id"]: judgement for judgement in judgements}
    return [row | {"shown": _shown(row, by_id, data)} for row in read(HERE, "misprints.yaml").content]


def _shown(row: Mapping[str, str], by_id: Mapping[str, Judgement], data: Data) -> str:
    if "claim" in row:
        reading = by_id[row["claim"]].literal
        return words.named(reading.worst) if reading else "no data"
    return words.or_reason(words.named, getattr(numbers, row["number"]), data) if "number" in row else ""
