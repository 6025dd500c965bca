"""Measures, prints and plots accuracy against time, and rounding: all products of figures/tradeoff.

Measured times differ between executions; `make figures` therefore excludes these products.
"""

import argparse
import subprocess
from pathlib import Path

from workflow.lib import style
from workflow.lib.columns import as_csv
from workflow.tradeoff import accuracy, bias, efficiency, rounding

FOLDER = Path("figures/tradeoff")
SIMULATORS = ("reference_open_chain", "reference_pulse", "reference_drift")
TABLES = {
    "ext06": accuracy.measure,
    "ext06_efficiency": efficiency.measure,
    "ext06_bias": bias.measure,
    "ext06_prediction": accuracy.predictions,
    "ext06_precision": rounding.measure_types,
    "ext08": rounding.measure,
}
FIGURES = {"ext06": accuracy.draw, "ext08": rounding.draw}


def make(name: str, folder: Path = FOLDER) -> None:
    table = TABLES[name]()
    folder.mkdir(parents=True, exist_ok=True)
    units = {column: "second" if column.endswith("seconds") else "1" for column in table} | bias.UNITS
    (folder / f"{name}.csv").write_text(as_csv(table, units))
    print(f"{name}\n{table.to_string(index=False, float_format='{:.3g}'.format, na_rep='-')}\n", flush=True)
    if name in FIGURES:
        style.apply()
        figure = FIGURES[name](table)
        for kind in ("pdf", "png"):
            figure.savefig(folder / f"{name}.{kind}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=TABLES, metavar="NAME", help=f"one of {', '.join(TABLES)}")
    only = parser.parse_args().only
    subprocess.run(["bash", "workflow/environment/build.sh", *SIMULATORS], check=True)
    for name in [only] if only else TABLES:
        make(name)


if __name__ == "__main__":
    main()
