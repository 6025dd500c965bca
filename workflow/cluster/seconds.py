"""Writes workflow/config/seconds.csv from the results of the given qualities: cost and error of every series and size.

If several qualities have a series and size, the one with the most replicas is used. If several runs have one size, as for a list of
sigma, the largest cost and error are used. Rows of other series and sizes are kept.
"""

import argparse
import csv
import io
import math

from workflow.cluster.cost import TABLE, cells, effort, recorded_seconds
from workflow.lib.files import ROOT, write_together
from workflow.lib.load import FormatError, load
from workflow.lib.plan import QUALITIES, Run, data_path, load_plan

COLUMNS = ("panel", "series", "cells", "effort", "cpu_seconds", "error")
Row = dict[str, object]
Key = tuple[object, ...]


def row(quality: str, panel: str, run: Run) -> Row | None:
    """Row of a run; None without a recorded execution. The error of a series with a target-scale is relative to this scale."""
    path = data_path(quality, panel, run)
    seconds = recorded_seconds(path)
    if seconds is None:
        return None
    result = load(ROOT / path)
    error = float(result.provenance["achieved_error"]) if run.replicated else math.nan
    if run.scale is not None:
        error = float(result[result.provenance["target_quantity"]].error) / run.scale
    total = float(run.options.get("replicas", 1)) * effort(run.options)
    texts = {
        "effort": f"{total:.6g}",
        "cpu_seconds": f"{seconds:.4g}",
        "error": f"{error:.3g}" if error > 0 else "",
    }
    return {"panel": panel, "series": run.series, "cells": f"{cells(run.options):g}", **texts}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("qualities", nargs="+", choices=QUALITIES)
    with TABLE.open(newline="") as file:
        rows: dict[Key, Row] = {
            tuple(line[name] for name in COLUMNS[:3]): line for line in csv.DictReader(file)
        }
    replicas: dict[Key, int] = {}
    for quality in parser.parse_args().qualities:
        for name, panel in load_plan(quality).items():
            for run in panel.runs:
                try:
                    entry = row(quality, name, run)
                except FormatError:
                    continue
                if entry is None:
                    continue
                key, count = (
                    tuple(entry[column] for column in COLUMNS[:3]),
                    int(run.options.get("replicas", 1)),
                )
                if count > replicas.get(key, 0):
                    rows[key], replicas[key] = entry, count
                elif count == replicas[key]:
                    for column in COLUMNS[4:]:
                        rows[key][column] = max(
                            rows[key][column], entry[column], key=lambda text: float(str(text) or 0)
                        )
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows.values())
    write_together({TABLE: text.getvalue().encode()})


if __name__ == "__main__":
    main()
