"""Fig. 10: height of the moving peak of an energy pulse against time; a: gamma = N, b: gamma = 1.

Times without a moving peak, whose height is NaN, are left out.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.figure import run
from workflow.lib.load import Result

STARTS = {
    "particles": ("o", style.BLUE, style.BLUE, "Gaussian start"),
    0: ("s", style.VERMILLION, "white", "scatterers from rest"),
}
SLOPES = {"N": (-2 / 3, r"$t^{-2/3}$"), 1: (-1, r"$t^{-1}$")}  # the paper's guides


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame]:
    figure, (above, below) = plt.subplots(
        2, 1, sharex=True, figsize=(style.COLUMN, 1.25 * style.HEIGHT), height_ratios=[2, 1]
    )
    parts = []
    for result in results:
        marker, color, face, name = STARTS[result.parameters["scatterer-temperature"]]
        look = {"marker": marker, "color": color, "markerfacecolor": face, **style.POINTS}
        peak, exponent = result["peak"], result["damping_exponent_from"]
        time = peak.axes["time"]
        label = rf"{name}: $t^{{-{style.with_error(result['damping_exponent'])}}}$"
        above.errorbar(time, peak.mean / 1e3, peak.standard_error / 1e3, label=label, **look)
        late = exponent.standard_error < 0.1
        below.errorbar(
            exponent.axes["from"][late], exponent.mean[late], exponent.standard_error[late], **look
        )
        part = pd.DataFrame({"time": time, "peak": peak.mean, "peak_error": peak.standard_error})
        part["peak_raw"], part["peak_position"] = result["peak_raw"].mean, result["peak_position"].mean
        part["peak_position_error"] = result["peak_position"].standard_error
        for column, name in {
            "exponent_from_here": "damping_exponent_from",
            "exponent_to_next": "local_damping_exponent",
            "speed_to_next": "peak_speed",
        }.items():  # all but the last time have them
            part[column] = pd.Series(result[name].mean)
            part[f"{column}_error"] = pd.Series(result[name].standard_error)
        part.insert(0, "scatterer_temperature", str(result.parameters["scatterer-temperature"]))
        parts.append(part)
    slope, guide = SLOPES[results[0].parameters["gamma"]]
    peak = results[0]["peak"]
    time, known = peak.axes["time"], np.isfinite(peak.mean)
    if known.any():
        first = np.argmax(known)
        law = 1.3 * peak.mean[first] / 1e3 * (time / time[first]) ** slope
        above.plot(time[known], law[known], **style.GUIDE, label=guide)
    below.axhline(-slope, **style.GUIDE)
    above.set(xscale="log", yscale="log", ylabel=rf"peak of $\Delta E\,/\,10^3$ ({style.UNITS})")
    below.set(xlabel="time $t$", ylabel="exponent fitted\nfrom $t$ on")
    for axis in (above.yaxis, below.xaxis):
        style.label_within_decades(axis)
    above.legend(loc="lower left")
    figure.align_ylabels()
    return figure, pd.concat(parts)


if __name__ == "__main__":
    units = {"exponent_from_here": "1", "exponent_to_next": "1", "speed_to_next": "1/time"}
    errors = {f"{column}_error": unit for column, unit in units.items()}
    run(draw, "Damping of the moving peak of an energy pulse", **units, **errors)
