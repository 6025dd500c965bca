"""Prints for every panel whether it is fresh, stale (why) or missing, its largest error, and the CPU seconds of its runs."""

import argparse
import sys

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from workflow.cluster.cost import recorded_seconds
from workflow.lib.configuration import ConfigurationError
from workflow.provenance.checks import Products, worst_error

WIDE = 150  # columns, where the output is no terminal


def table(quality: str) -> Table:
    """Raises ConfigurationError."""
    products = Products(quality)
    result = Table("panel", "state", "largest error", "CPU s", title=f"Quality {quality}")
    for name, panel in products.plan.items():
        if products.is_made(name):
            faults = [*products.faults(name)]
            state = f"{faults[0].path.rpartition('/')[2]}: {faults[0].reason}" if faults else "fresh"
        else:
            state = "missing"
        seconds = [recorded_seconds(quality, name, run.name) for run in panel.runs]
        cost = f"{sum(filter(None, seconds)):.1f}" if any(seconds) else ""
        result.add_row(name, escape(state), worst_error(quality, panel), cost)
    return result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    try:
        Console(width=None if sys.stdout.isatty() else WIDE).print(table(parser.parse_args().quality))
    except ConfigurationError as error:
        print(error, file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
