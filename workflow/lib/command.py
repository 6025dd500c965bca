"""Command line of the tools that inspect the products of a quality."""

import argparse
import sys
from typing import Any

from workflow.lib.configuration import ConfigurationError
from workflow.lib.plan import Panel, load_plan, panel_named, with_used


def command(
    description: str | None, **more: dict[str, Any]
) -> tuple[argparse.Namespace, dict[str, Panel], list[Panel]]:
    """Parses a command line with --quality, --panel and more options. Returns it with the plan and the panels: all, or the one
    requested after those whose results it plots. Exits with 2 for bad input."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--panel", help="only this panel and the results that it plots")
    for name, settings in more.items():
        parser.add_argument(f"--{name}", **settings)
    options = parser.parse_args()
    try:
        plan = load_plan(options.quality)
        name = options.panel and panel_named(plan, options.panel).name
    except ConfigurationError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    return options, plan, with_used(plan, name) if name else [*plan.values()]


def product_command(description: str | None) -> argparse.Namespace:
    """Parses the command line of a script that writes a product of a whole quality."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--identity", required=True, help="identity in the name of the record")
    return parser.parse_args()
