"""Prints the state of every panel (fresh, stale with the reason, or missing), its largest error and its CPU seconds."""

import math
import shlex
import sys

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from workflow.cluster.cost import recorded_seconds
from workflow.lib.command import command
from workflow.lib.files import ROOT
from workflow.lib.load import FormatError, load_provenance
from workflow.lib.plan import Panel, Quality
from workflow.provenance.checks import Products
from workflow.provenance.obsolete import faults

WIDE = 150  # columns if the output is not a terminal
LEGEND = """Largest error: standard error of the target quantity, relative to it, or absolute where that can be 0; of runs with a target, error
of target. It is that of the run farthest from its target. CPU time: simulations."""


def worst_error(products: Products, panel: Panel) -> str:
    """Largest error of the results of a panel; of those with a target, error and target."""
    errors, aimed = [], []
    for run in panel.runs:
        try:
            provenance = load_provenance(ROOT / products.result(panel.name, run))
            achieved, target = (float(provenance[name]) for name in ("achieved_error", "target_error"))
        except (FormatError, OSError, KeyError, TypeError, ValueError):
            continue
        if target > 0:
            aimed.append((achieved / target, f"{achieved:.1e} of {target:.0e}"))
        elif not math.isnan(achieved):
            errors.append((achieved, f"{achieved:.1e}"))
    return "; ".join(max(group)[1] for group in (errors, aimed) if group)


def main() -> None:
    options, plan, panels = command(__doc__)
    products = Products(options.quality, plan)
    table = Table("panel", "state", "largest error", "CPU time, s", title=f"Quality {options.quality}")
    for panel in panels:
        state = "fresh" if products.is_made(panel.name) else "missing"
        if state == "fresh" and (fault := next(products.faults(panel.name), None)):
            state = f"{fault.path.rpartition('/')[2]}: {fault.reason}"
        paths = [products.result(panel.name, run) for run in panel.runs]
        seconds = [recorded_seconds(path) or 0.0 for path in paths]
        cost = f"{sum(seconds):.1f}" if any(seconds) else ""
        table.add_row(panel.name, escape(state), worst_error(products, panel), cost)
    Console(width=None if sys.stdout.isatty() else WIDE).print(table)
    print(LEGEND)
    if obsolete := faults(products, options.panel or []):
        only = shlex.quote("PANEL=" + " ".join(options.panel)) + " " if options.panel else ""
        print(
            f"Obsolete: {len(obsolete)} results or figures of other options, builds or sources, to which going back costs no "
            f"simulation; make prune {only}{Quality.of(options.quality).arguments} removes them"
        )


if __name__ == "__main__":
    main()
