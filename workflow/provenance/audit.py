"""Checks that every result and figure follows from the present sources, parameters, build and packages.

Each result belongs to the plan, has its options, was written by the present build and has the values that were written. Each
figure is the one that its record names, and gets the same bytes when it is rendered from its parents again. Exit status: 0 if all
holds, 1 if something is broken, 3 if something could not be checked, 2 for bad input.
"""

import argparse
import os
import sys
from concurrent.futures import ThreadPoolExecutor

from workflow.lib.configuration import ConfigurationError
from workflow.lib.plan import panel_named, with_used
from workflow.provenance.checks import Fault, Products
from workflow.provenance.redraw import redraw


def audit(quality: str, panel: str | None) -> tuple[list[Fault], list[str], list[str]]:
    """Faults; the panels that are there and those that are not. Raises ConfigurationError."""
    products = Products(quality)
    if panel:
        chosen = list(
            dict.fromkeys(
                one.name for one in with_used(products.plan, panel_named(products.plan, panel).name)
            )
        )
    else:
        chosen = list(products.plan)
    made = [name for name in chosen if products.is_made(name)]
    faults = [fault for name in made for fault in products.faults(name)]
    drawn = [
        name
        for name in made
        if panel in (None, name) and products.fault_of_figure(products.plan[name]) is None
    ]
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        faults += filter(None, threads.map(lambda name: redraw(products, name), drawn))
    if not panel:
        faults += products.obsolete()
    return faults, made, [name for name in chosen if name not in made]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--panel", help="this panel and the results that it shows")
    options = parser.parse_args()
    try:
        faults, made, missing = audit(options.quality, options.panel)
    except ConfigurationError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    for fault in faults:
        print(fault)
    broken = sum(fault.broken for fault in faults)
    if missing:
        print(f"Not made at quality {options.quality}: {', '.join(missing)}")
    print(
        f"{len(made)} panels with their results: {broken} broken, {len(faults) - broken} not checked, all else holds"
    )
    sys.exit(1 if broken else 3 if faults or not made else 0)


if __name__ == "__main__":
    main()
