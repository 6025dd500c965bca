"""Checks every result and figure against the present sources, parameters, build and packages.

A result has to be in the plan, with its options, from the present build, and unmodified. A figure has to match its record, and
rendering it again from its parents has to give equal bytes. Exit status: 0 if all holds, 1 if something is broken, 3 if something
could not be checked, 2 for bad input. Obsolete products are named.
"""

import os
import sys
from concurrent.futures import ThreadPoolExecutor

from workflow.lib.command import command, counted
from workflow.lib.files import in_one_line
from workflow.provenance.checks import Kind, Products
from workflow.provenance.obsolete import faults
from workflow.provenance.redraw import redraw


def main() -> None:
    options, plan, panels = command(__doc__)
    products = Products(options.quality, plan)
    made = [panel for panel in panels if products.is_made(panel.name)]
    shown = [panel for panel in made if panel.name in (options.panel or plan)]
    figures = {panel.name: products.fault_of_figure(panel) for panel in shown}
    runs = [(panel.name, run) for panel in made for run in panel.runs]
    all_faults = [fault for panel, run in runs if (fault := products.fault_of_result(panel, run))]
    all_faults += filter(None, figures.values())
    with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as threads:
        whole = [name for name, fault in figures.items() if not fault]
        all_faults += filter(None, threads.map(lambda name: redraw(products, name), whole))
    all_faults += faults(products, options.panel or [])
    for fault in all_faults:
        print(fault)
    if missing := [panel.name for panel in panels if panel not in made]:
        print(f"Not made at quality {options.quality}: {', '.join(missing)}")
    broken, unchecked, obsolete = (sum(fault.kind is kind for fault in all_faults) for kind in Kind)
    more = f", {obsolete} obsolete" if obsolete else ""
    print(
        f"{counted(len(shown), 'panel')} with results: {broken} broken, {unchecked} not checked{more}, all else holds"
    )
    sys.exit(1 if broken else 3 if unchecked or not shown else 0)


if __name__ == "__main__":
    try:
        main()
    except OSError as error:
        print(f"not checked: {in_one_line(error)}")
        sys.exit(3)
