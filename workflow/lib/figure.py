"""The frame of every figure script: reads the runs, draws, saves.

A script defines draw(results) and ends with `run(draw, title)`, where a title that differs between its panels is a function of
the results too; it adds the units of the columns that are named neither after a quantity nor after an axis or an option.
"""

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.columns import as_csv, inherited
from workflow.lib.load import Result, load
from workflow.lib.parents import Parents, file_hash
from workflow.lib.save import Text, save

Draw = Callable[[Sequence[Result]], tuple[Figure, pd.DataFrame, str]]


def described(result: Result) -> dict[str, Any]:
    return {
        "sha256": file_hash(result.path),
        "build_id": result.provenance["build_id"],
        "seed": int(result.provenance["seed"]),
    }


def build(result: Result) -> dict[str, str]:
    names = ("program", "source_hash", "compiler", "flags", "libraries")
    return {name: result.provenance[name] for name in names}


def run(draw: Draw, title: str | Callable[[Sequence[Result]], str], **units: str) -> None:
    """draw gets the panel's results and returns the figure, the table of what it shows, and its caption: a paragraph of
    plain text that says what is shown and what is to be seen, with numbers from the data."""
    parser = argparse.ArgumentParser(description="Draws a panel from its results.")
    parser.add_argument("--data", type=Path, nargs="+", required=True, help="result files of the panel")
    parser.add_argument(
        "--sources", type=Path, nargs="+", required=True, help="this script and what it imports"
    )
    parser.add_argument("--lock", type=Path, required=True, help="locked Python packages")
    parser.add_argument("--configuration", required=True, help="hash of the panel's configuration")
    parser.add_argument("--output", type=Path, required=True, help="figures/QUALITY/PANEL, without suffix")
    options = parser.parse_args()

    results = [load(path) for path in options.data]
    style.apply()
    figure, table, caption = draw(results)
    parents = Parents(
        panel=options.output.name,
        quality=options.output.parent.name,
        data={str(result.path): described(result) for result in results},
        builds={result.provenance["build_id"]: build(result) for result in results},
        sources={str(path): file_hash(path) for path in options.sources},
        packages=file_hash(options.lock),
        python=f"{sys.version_info.major}.{sys.version_info.minor}",
        configuration=options.configuration,
    )
    saved = as_csv(table, inherited(results) | units)
    name = title if isinstance(title, str) else title(results)
    save(figure, saved, options.output, Text(name, " ".join(caption.split())), parents)
