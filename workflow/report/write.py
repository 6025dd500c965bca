"""Writes `figures/<quality>/report.html` from the products of one quality. Equal inputs give equal bytes."""

import sys

from workflow.lib.command import product_command
from workflow.lib.configuration import ConfigurationError
from workflow.lib.files import ROOT
from workflow.lib.record import write_with_record
from workflow.report.content import content
from workflow.report.sources import ReportError
from workflow.report.templates import rendered


def main() -> None:
    options = product_command(__doc__)
    stem = ROOT / "figures" / options.quality / "report"
    try:
        page = rendered("report.html", **content(options.quality, ROOT))
        write_with_record(stem, options.identity, {stem.with_suffix(".html"): page.encode()}, {})
    except (ReportError, ConfigurationError) as error:
        sys.exit(f"make report: {error}")


if __name__ == "__main__":
    main()
