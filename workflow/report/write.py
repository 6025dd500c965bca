"""Writes figures/<quality>/report.html from the products of one quality. Equal inputs give equal bytes."""

import argparse
import sys

from workflow.lib.configuration import ConfigurationError
from workflow.lib.figure_metadata import ROOT
from workflow.lib.files import write_together
from workflow.report.content import content
from workflow.report.sources import ReportError
from workflow.report.templates import rendered


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    quality = parser.parse_args().quality
    try:
        page = rendered("report.html", **content(quality, ROOT))
        write_together({ROOT / "figures" / quality / "report.html": page.encode()})
    except (ReportError, ConfigurationError) as error:
        sys.exit(f"make report: {error}")


if __name__ == "__main__":
    main()
