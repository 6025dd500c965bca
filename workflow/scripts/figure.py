"""The frame of every figure script: reads the runs, draws, saves.

A script defines draw(results) and ends with `run(draw, title)`.
"""

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from workflow.scripts import style
from workflow.scripts.load import Result, load
from workflow.scripts.save import Parents, file_hash, save

Draw = Callable[[Sequence[Result]], tuple[Figure, pd.DataFrame]]


def run(draw: Draw, title: str) -> None:
    """draw gets the panel's results and returns the figure and the table of what it shows."""
    parser = argparse.ArgumentParser(description=title)
    parser.add_argument("--data", type=Path, nargs="+", required=True, help="result files of the panel")
    parser.add_argument(
        "--sources", type=Path, nargs="+", required=True, help="this script and what it imports"
    )
    parser.add_argument("--lock", type=Path, required=True, help="locked Python packages")
    parser.add_argument("--configuration", required=True, help="hash of the panel's configuration")
    parser.add_argument("--output", type=Path, required=True, help="path of the panel without suffix")
    options = parser.parse_args()

    results = [load(path) for path in options.data]
    style.apply()
    figure, table = draw(results)
    parents = Parents(
        data={str(path): file_hash(path) for path in options.data},
        sources={str(path): file_hash(path) for path in options.sources},
        lock=file_hash(options.lock),
        configuration=options.configuration,
        build_ids=tuple(sorted({result.provenance["build_id"] for result in results})),
    )
    save(figure, table, options.output, title, parents)
