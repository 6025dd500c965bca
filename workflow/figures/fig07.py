"""Fig. 7: spreading of a tagged particle at sigma = 1/2, and the part that is the drift of all particles."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Result


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    (result,) = results
    variance, drift = result["variance"], result["centre_of_mass"]
    time = variance.axes["time"]
    figure, axes = plt.subplots(figsize=(style.COLUMN, style.HEIGHT))
    total = {"marker": "o", "color": style.BLUE, "label": r"$\langle x^2\rangle$"}
    part = {"marker": "s", "color": style.VERMILLION, "markerfacecolor": "white", "label": "centre of mass"}
    axes.errorbar(time, variance.mean, variance.standard_error, **total, **style.POINTS)
    axes.errorbar(time, drift.mean, drift.standard_error, **part, **style.POINTS)
    late = time > time[-1] / 100
    axes.plot(time[late], 2 * variance.mean[-1] * (time[late] / time[-1]) ** 2, **style.GUIDE, label=r"$t^2$")
    axes.set(
        xscale="log", yscale="log", xlabel=f"time $t$ ({style.UNITS})", ylabel=r"mean square displacement"
    )
    alpha = rf"$\alpha = {style.with_error(result['alpha'])}$"
    axes.legend(loc="upper left", title=rf"$\sigma = {result.parameters['sigma']:g}$, {alpha}")
    table = pd.DataFrame({"time": time, "variance": variance.mean, "variance_error": variance.standard_error})
    table["centre_of_mass"], table["centre_of_mass_error"] = drift.mean, drift.standard_error
    return figure, table


if __name__ == "__main__":
    run(draw, "Mean square displacement of a tagged particle")
