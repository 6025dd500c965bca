"""Writes figures/<quality>/report.html and report.md from the products of one quality.

It names every file that it reads by hash; the CPU seconds of the runs are stated facts. With equal inputs the report has
equal bytes.
"""

import argparse
import sys
from pathlib import Path

from workflow.claims.data import Data
from workflow.lib.citation import citation
from workflow.lib.configuration import ConfigurationError
from workflow.lib.figure_metadata import ROOT
from workflow.lib.files import write_together
from workflow.lib.plan import Quality
from workflow.report import content
from workflow.report.answer import answer
from workflow.report.sources import Products, ReportError, measured_costs, source_hashes
from workflow.report.templates import written

NAMES = ("report.html", "report.md")


def pages(quality: str, root: Path = ROOT) -> dict[str, str]:
    """Text by name of the file. Raises ReportError."""
    data = Data(quality, root)
    products = Products(root, quality)
    judgements = products.judged(data)
    costs = measured_costs(quality, data.plan)
    context = {
        "quality": quality,
        "effort": Quality.of(quality).arguments,
        "answer": answer(judgements, quality),
        "panel_link": "%s.png",
        "claims_page": "",
        "terms": content.terms(),
        "claims": [content.claim(one, costs) for one in judgements],
        "findings": content.findings(judgements),
        "misprints": content.misprints(judgements, data),
        "panels": [content.panel(quality, one, products, costs) for one in data.plan.values()],
        "environment": content.environment(products.records.values()),
        "citation": citation(root),
        "cost": sum(costs.values()),
    }
    for path in data.used:
        products.file(path)
    context["parents"] = {"products": products.used, "sources": source_hashes(root)}
    return {name: written(name, **context) for name in NAMES}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    quality = parser.parse_args().quality
    try:
        folder = ROOT / "figures" / quality
        write_together({folder / name: text.encode() for name, text in pages(quality).items()})
    except (ReportError, ConfigurationError) as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main()
