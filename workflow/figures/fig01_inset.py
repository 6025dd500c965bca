"""Fig. 1, inset: number of particles inside against the logarithm of time."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Result


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    figure, columns = plt.subplots(1, len(results), figsize=(3 * style.COLUMN, style.HEIGHT))
    tables = []
    for axes, result in zip(columns, results, strict=True):
        number, plateau = result["total_number"], result["plateau"]
        time, (length, spacing) = number.axes["time"], style.spacing(result)
        axes.errorbar(
            time,
            number.mean,
            number.standard_error,
            marker="o",
            color=style.BLUE,
            **style.POINTS,
            label="$n(t)$",
        )
        late = time >= plateau.axes["time"][0]
        slope = float(plateau.mean[-1])
        expected = number.mean[-1] + slope * np.log(time[late] / time[-1])
        label = rf"slope $|p|\,n_t(p)$ above $p_0$: {style.with_error(plateau, -1)}"
        axes.plot(time[late], expected, color=style.VERMILLION, label=label)
        fitted = f"fitted slope {style.with_error(result['log_slope'])}"
        curvature = f"its change with $\\ln t$: {style.with_error(result['log_curvature'])}"
        axes.legend(
            loc="upper left", title=f"$\\lambda = {spacing}$\n{fitted}\n{curvature}", alignment="left"
        )
        axes.set(
            xscale="log",
            xlabel=f"time $t$ ({style.UNITS})",
            ylabel="particles inside",
            ylim=(0, 1.5 * number.mean[-1]),
        )
        table = pd.DataFrame({"time": time, "number": number.mean, "number_error": number.standard_error})
        table.insert(0, "cell_length", length)
        tables.append(table)
    return figure, pd.concat(tables)


if __name__ == "__main__":
    run(draw, "Number of particles in an open chain", number="1", number_error="1")
