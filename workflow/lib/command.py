"""Command line of the tools that inspect the products of a quality."""

import argparse
import sys
from typing import Any

from workflow.lib.configuration import ConfigurationError
from workflow.lib.plan import Panel, load_plan, panel_named, with_used


def command(
    description: str | None, **more: dict[str, Any]
) -> tuple[argparse.Namespace, dict[str, Panel], list[Panel]]:
    """Parses a command line with --quality, --panel, which may be repeated, and more options. Returns it with the plan and the panels:
    all, or those requested after those whose results they plot. Exits with 2 for bad input."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--panel", action="append", help="only this panel and the results that it plots")
    for name, settings in more.items():
        parser.add_argument(f"--{name}", **settings)
    options = parser.parse_args()
    try:
        plan = load_plan(options.quality)
        names = [panel_named(plan, name).name for name in options.panel or plan]
    except ConfigurationError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
    return options, plan, [*{panel.name: panel for name in names for panel in with_used(plan, name)}.values()]


def product_command(description: str | None) -> argparse.Namespace:
    """Parses the command line of a script that writes a product of a whole quality."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--quality", required=True)
    parser.add_argument("--identity", required=True, help="identity in the name of the record")
    return parser.parse_args()


def counted(number: int, noun: str) -> str:
    """The number with its noun in singular or plural: 1 panel, 2 panels."""
    return f"{number} {noun}{'s' * (number != 1)}"
