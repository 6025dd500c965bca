"""Checks every result and figure against the present sources, parameters, build and packages.

A result has to be in the plan, with its options, from the present build, and unmodified. A figure has to match its record, and
rendering it again from its parents has to give equal bytes. Exit status: 0 if all holds, 1 if something is broken, 3 if something
could not be checked, 2 for bad input.
"""

import os
import sys
from concurrent.futures import ThreadPoolExecutor

from workflow.lib.command import command
from workflow.provenance.checks import Products
from workflow.provenance.redraw import redraw


def main() -> None:
    options, plan, panels = command(__doc__)
    products = Products(options.quality, plan)
    made = [panel for panel in panels if products.is_made(panel.name)]
    figures = {panel.name: products.fault_of_figure(panel) for panel in made}
    runs = [(panel.name, run) for panel in made for run in panel.runs]
    faults = [fault for panel, run in runs if (fault := products.fault_of_result(panel, run))]
    faults += filter(None, figures.values())
    whole = [name for name, fault in figures.items() if not fault and options.panel in (None, name)]
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        faults += filter(None, threads.map(lambda name: redraw(products, name), whole))
    if not options.panel:
        faults += products.obsolete()
    for fault in faults:
        print(fault)
    if missing := [panel.name for panel in panels if panel not in made]:
        print(f"Not made at quality {options.quality}: {', '.join(missing)}")
    broken = sum(fault.broken for fault in faults)
    unchecked = len(faults) - broken
    print(f"{len(made)} panels with their results: {broken} broken, {unchecked} not checked, all else holds")
    sys.exit(1 if broken else 3 if faults or not made else 0)


if __name__ == "__main__":
    main()
