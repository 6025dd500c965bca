"""Writes the report from the products of one quality. Equal inputs give equal bytes."""

import argparse
import sys
from pathlib import Path

from workflow.configuration import ConfigurationError
from workflow.files import write_together
from workflow.identity import ROOT
from workflow.report.content import content
from workflow.report.sources import ReportError
from workflow.report.templates import rendered


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--output", type=Path, required=True)
    options = parser.parse_args()
    try:
        page = rendered("report.html", **content(options.quality, ROOT))
        write_together({options.output: page.encode()})
    except (ReportError, ConfigurationError) as error:
        sys.exit(f"make report: {error}")


if __name__ == "__main__":
    main()
