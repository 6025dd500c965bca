"""Ext. 7: ageing. Energies against the logarithm of time; what moves with the relaxation time."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.scripts import style
from workflow.scripts.figure import run
from workflow.scripts.load import Result

AGED = [
    ("persistence", "mu", r"persistence $\mu$", lambda sigma: np.arccos(sigma) / np.pi),
    ("waiting_time", "exponent", r"exponent of $\Psi$", lambda _: -2),
    ("displacement", "alpha", r"exponent $\alpha$, zero momentum", lambda _: 1),
]


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    figure, rows = plt.subplots(2, 2, figsize=(1.9 * style.COLUMN, 1.7 * style.HEIGHT))
    tables = []
    (ageing,) = (result for result in results if result.provenance["program"] == "ageing")
    looks = {"scatterer": ("o", style.BLUE), "particle": ("s", style.VERMILLION)}
    for name, (marker, color) in looks.items():
        energy = ageing[f"{name}_energy"]
        time = energy.axes["time"]
        look = {"marker": marker, "color": color, "label": name, **style.POINTS}
        rows[0, 0].errorbar(time, energy.mean, energy.standard_error, **look)
        columns = {"quantity": f"{name}_energy", "time": time, "value": energy.mean}
        tables.append(pd.DataFrame({**columns, "error": energy.standard_error, "units": energy.units}))
    rows[0, 0].set(xscale="log", xlabel="time from the start", ylabel=f"mean energy ({style.UNITS})")
    rows[0, 0].legend(loc="upper left")
    for axes, (program, name, label, expected) in zip(rows.flat[1:], AGED, strict=True):
        runs = [result for result in results if result.provenance["program"] == program]
        runs.sort(key=lambda result: result.parameters["relaxation-time"])
        time = [result.parameters["relaxation-time"] for result in runs]
        value = [float(result[name].mean) for result in runs]
        error = [float(result[name].standard_error) for result in runs]
        axes.errorbar(time, value, error, marker="o", color=style.BLUE, **style.POINTS)
        axes.axhline(expected(runs[0].parameters["sigma"]), **style.GUIDE)
        axes.set(xscale="log", xlabel="relaxation time", ylabel=label)
        columns = {"quantity": name, "time": time, "value": value, "error": error}
        tables.append(pd.DataFrame({**columns, "units": runs[0][name].units}))
    return figure, pd.concat(tables)


if __name__ == "__main__":
    run(draw, "Ageing of the closed chain", value="column units", error="column units")
