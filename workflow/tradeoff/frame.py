"""The frame of every measurement: measures, writes the table, draws it and prints it.

A module defines measure(programs), draw(table) if there is a figure, UNITS of the columns that hold numbers, and ends
with `run(measure, __doc__, UNITS, draw)`.
"""

import argparse
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.columns import as_csv

Measure = Callable[..., pd.DataFrame]  # of the folder of the executables, and further options by name
Draw = Callable[[pd.DataFrame], Figure]


def whole(table: pd.DataFrame) -> str:
    return str(table.to_string(index=False))


def run(
    measure: Measure,
    description: str,
    units: Mapping[str, str],
    draw: Draw | None = None,
    show: Callable[[pd.DataFrame], str] = whole,
    **further: dict[str, Any],
) -> None:
    """Further options are given by name, as argparse takes them; measure gets their values. What show makes of
    the table is printed."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--programs", type=Path, required=True, help="folder of the executables")
    for name, properties in further.items():
        parser.add_argument(f"--{name}", required=True, **properties)
    parser.add_argument("--output", type=Path, required=True, help="path of the products without suffix")
    options = vars(parser.parse_args())
    output = options.pop("output")

    table = measure(**options)
    output.parent.mkdir(parents=True, exist_ok=True)
    output.with_suffix(".csv").write_text(as_csv(table, units))
    if draw:
        style.apply()
        figure = draw(table)
        for kind in ("pdf", "png"):
            figure.savefig(output.with_suffix(f".{kind}"))
    print(show(table))
