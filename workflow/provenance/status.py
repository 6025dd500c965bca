"""Prints the state of every panel (fresh, stale with the reason, or missing), its largest error and its CPU seconds."""

import math
import sys

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from workflow.cluster.cost import recorded_seconds
from workflow.lib.command import command
from workflow.lib.figure_metadata import ROOT
from workflow.lib.load import FormatError, load_provenance
from workflow.lib.plan import Panel, data_path
from workflow.provenance.checks import Products

WIDE = 150  # columns if the output is not a terminal


def worst_error(quality: str, panel: Panel) -> str:
    """Largest error of the results of a panel; of those with a target, error and target."""
    errors, aimed = [], []
    for run in panel.runs:
        try:
            provenance = load_provenance(ROOT / data_path(quality, panel.name, run.name))
            achieved, target = (float(provenance[name]) for name in ("achieved_error", "target_error"))
        except (FormatError, OSError, KeyError, TypeError, ValueError):
            continue
        if target > 0:
            aimed.append((achieved / target, f"{achieved:.1e} of {target:.0e}"))
        elif not math.isnan(achieved):
            errors.append((achieved, f"{achieved:.1e}"))
    return "; ".join(max(found)[1] for found in (errors, aimed) if found)


def main() -> None:
    options, plan, panels = command(__doc__)
    products = Products(options.quality, plan)
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
