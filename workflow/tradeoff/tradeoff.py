"""Accuracy against time, and rounding: measures, plots and prints every product of figures/tradeoff.

Most products hold measured times, which differ from run to run; so `make figures` does not make them.
"""

import argparse
import subprocess
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import NamedTuple

import pandas as pd
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.columns import as_csv
from workflow.tradeoff import accuracy, bias, efficiency, extremes, kinetic

FOLDER = Path("figures/tradeoff")
SIMULATORS = ("reference_open_chain", "reference_pulse", "reference_drift")


class Product(NamedTuple):
    measure: Callable[[], pd.DataFrame]
    units: Mapping[str, str]  # of the columns with numbers; those not named have no dimension
    draw: Callable[[pd.DataFrame], Figure] | None = None


def products(longest: float = 8) -> dict[str, Product]:
    return {
        "ext06": Product(accuracy.measure, accuracy.UNITS, accuracy.draw),
        "ext06_kinetic": Product(kinetic.measure, kinetic.UNITS, kinetic.draw),
        "ext06_efficiency": Product(efficiency.measure, {}),
        "ext06_bias": Product(bias.measure, bias.UNITS),
        "ext06_precision": Product(extremes.types, {}),
        "ext06_prediction": Product(accuracy.predictions, accuracy.PREDICTION_UNITS),
        "ext08": Product(partial(extremes.measure, longest), {}, extremes.draw),
    }


def make(name: str, product: Product, folder: Path = FOLDER) -> None:
    table = product.measure()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.csv").write_text(as_csv(table, dict.fromkeys(table, "1") | product.units))
    if product.draw:
        style.apply()
        figure = product.draw(table)
        for kind in ("pdf", "png"):
            figure.savefig(folder / f"{name}.{kind}")
        plt.close(figure)
    print(f"{name}\n{table.to_string(index=False, float_format='%.3g', na_rep='-')}\n", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=products(), help="make one product")
    parser.add_argument(
        "--longest", type=float, default=8, help="log10 of the events of the longest run of ext08"
    )
    options = parser.parse_args()
    subprocess.run(["bash", "workflow/environment/build.sh", *SIMULATORS], check=True)
    for name, product in products(options.longest).items():
        if options.only in (None, name):
            make(name, product)


if __name__ == "__main__":
    main()
