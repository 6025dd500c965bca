"""Prints the state of every panel (fresh, stale with the reason, or missing), its largest error and its CPU seconds."""

import sys

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from workflow.cluster.cost import recorded_seconds
from workflow.provenance.checks import command, worst_error

WIDE = 150  # columns if the output is not a terminal


def main() -> None:
    options, products, panels = command(__doc__)
    table = Table("panel", "state", "largest error", "CPU s", title=f"Quality {options.quality}")
    for panel in panels:
        state = "fresh" if products.is_made(panel.name) else "missing"
        if state == "fresh" and (fault := next(products.faults(panel.name), None)):
            state = f"{fault.path.rpartition('/')[2]}: {fault.reason}"
        seconds = [recorded_seconds(options.quality, panel.name, run.name) or 0.0 for run in panel.runs]
        cost = f"{sum(seconds):.1f}" if any(seconds) else ""
        table.add_row(panel.name, escape(state), worst_error(options.quality, panel), cost)
    Console(width=None if sys.stdout.isatty() else WIDE).print(table)


if __name__ == "__main__":
    main()
