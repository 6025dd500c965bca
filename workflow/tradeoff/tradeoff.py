"""Measures, prints and plots accuracy against time, and rounding: all products of figures/tradeoff.

Measured times differ between executions; `make figures` therefore excludes these products.
"""

import argparse
import io
import subprocess
from pathlib import Path

from workflow.files import write_together
from workflow.identity import ROOT
from workflow.lib import style
from workflow.lib.columns import as_csv
from workflow.tradeoff import accuracy, bias, efficiency, rounding

FOLDER = ROOT / "figures/tradeoff"
TABLES = {
    "ext06": accuracy.measure,
    "ext06_efficiency": efficiency.measure,
    "ext06_bias": bias.measure,
    "ext06_precision": rounding.measure_types,
    "ext08": rounding.measure,
}
FIGURES = {"ext06": accuracy.draw, "ext08": rounding.draw}


def make(name: str) -> dict[Path, bytes]:
    """Measures a table, prints it, and returns it and its figure by path."""
    table = TABLES[name]()
    units = {column: "second" if column.endswith("seconds") else "1" for column in table} | bias.UNITS
    files = {FOLDER / f"{name}.csv": as_csv(table, units).encode()}
    print(f"{name}\n{table.to_string(index=False, float_format='{:.3g}'.format, na_rep='-')}\n", flush=True)
    if name in FIGURES:
        style.apply()
        figure = FIGURES[name](table)
        for kind in ("pdf", "png"):
            picture = io.BytesIO()
            figure.savefig(picture, format=kind)
            files[FOLDER / f"{name}.{kind}"] = picture.getvalue()
    return files


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=TABLES, metavar="NAME", help=f"one of {', '.join(TABLES)}")
    options = parser.parse_args()
    subprocess.run(["bash", "workflow/environment/build.sh", "reference_simulator"], check=True)
    if options.only:
        make(options.only)
    else:
        write_together({path: content for name in TABLES for path, content in make(name).items()})


if __name__ == "__main__":
    main()
