"""Fig. 3: momentum distribution of the particles at both ends, by the kinetic equation."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Result

ENDS = [(0, "x = 0", style.BLUE, "solid"), (-1, "x = 1", style.VERMILLION, (0, (4, 1.5)))]


PAPER = "as in the paper"  # the case that is drawn; the table has all


def case(result: Result) -> str:
    if result.parameters["sigma"] == 0:
        return "sigma = 0"
    equal = result.parameters["temperature-left"] == result.parameters["temperature-right"]
    return "equal temperatures" if equal else PAPER


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    tables = []
    for result in results:
        density, kurtosis, jump = result["flux_density"], result["kurtosis"], result["jump"]
        momentum = density.axes["momentum"]
        for index, place, color, dashes in ENDS:
            table = pd.DataFrame({"x": place, "momentum": momentum, "flux": density.mean[index]})
            table["kurtosis"] = [kurtosis.mean[index][int(p > 0)] for p in momentum]
            table["jump"] = jump.mean[index]
            table.insert(0, "case", case(result))
            tables.append(table)
            if case(result) != PAPER:
                continue
            label = rf"${place}$: jump {jump.mean[index]:.4f}"
            for half in (momentum < 0, momentum > 0):  # not joined across the jump
                axes.plot(
                    momentum[half], density.mean[index][half], color=color, linestyle=dashes, label=label
                )
                label = None
    axes.axvline(0, **style.GUIDE)
    axes.set(xlabel=f"momentum $p$ ({style.UNITS})", ylabel="$F(p, x)$", xlim=(-45, 45))
    axes.set_ylim(0, 1.45 * axes.get_ylim()[1])
    axes.legend(loc="upper right")
    return figure, pd.concat(tables)


if __name__ == "__main__":
    run(draw, "Momentum distribution of the particles at both ends, by the kinetic equation")
