"""Ext. 14: the energy pulse of figs. 9 and 10 with a tenth of its energy (γ = N), and in a ring ten times as long (γ = 1)."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, number, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import mean_of
from workflow.lib.load import Result

SOUND = 2 / 3

# By γ: plotted quantity, power of time by which it is divided, and label of the axis.
PLOTTED = {
    "N": ("peak", -SOUND, r"peak $\times\, t^{2/3}$ over its mean"),
    1: ("peak_position", 1, r"$x_p/t$ over that in free flight"),
}
LOOKS = [style.points("o", style.VERMILLION, "white"), style.points("s", style.BLUE)]


def free_flight(result: Result) -> float:
    """x_p/t in cells without scattering: v² exp(-v²/4ε̃), the energy at x = vt, is largest at v² = 4ε̃."""
    pulse, length = (float(result.parameters[name]) for name in ("pulse-energy", "cell-length"))
    return 2 * np.sqrt(pulse) / length


def scaled(result: Result) -> pd.DataFrame:
    """One row per time with a moving peak: height of the peak times t^(2/3) relative to its weighted mean (γ = N), or position of the peak
    relative to that in free flight (γ = 1)."""
    name, power, _ = PLOTTED[result.parameters["gamma"]]
    quantity = result[name]
    resolved = np.isfinite(quantity.mean)
    time = quantity.axes["time"][resolved]
    value, error = (array[resolved] / time**power for array in (quantity.mean, quantity.error))
    scale = mean_of(value, error)[0] if name == "peak" else free_flight(result)
    columns = {"time": time, "relative": value / scale, "relative_error": error / scale}
    return pd.DataFrame(columns).assign(
        gamma=str(result.parameters["gamma"]), cells=int(result.parameters["cells"]),
        pulse_energy=float(result.parameters["pulse-energy"]), quantity=name,
    )  # fmt: skip


def label(result: Result) -> str:
    if result.parameters["gamma"] == "N":
        return rf"$\tilde\varepsilon = {number(result.parameters['pulse-energy'])}$"
    return f"$N = {result.parameters['cells']}$"


def plot(axes: Axes, results: Sequence[Result]) -> pd.DataFrame:
    tables = []
    for result, look in zip(results, LOOKS, strict=True):
        table = scaled(result)
        axes.errorbar(table.time, table.relative, table.relative_error, label=label(result), **look)
        tables.append(table)
    gamma = results[0].parameters["gamma"]
    axes.axhline(1, **style.GUIDE)
    axes.set(xscale="log", xlabel="time $t$", ylabel=PLOTTED[gamma][2])
    axes.legend(loc="lower left", title=rf"$\gamma = {style.gamma(results[0])}$")
    style.label_within_decades(axes.xaxis)
    return pd.concat(tables)


def draw(results: Sequence[Result]) -> Drawn:
    all_options = [result.parameters for result in results]
    starts = [(options["gamma"], options["scatterer-temperature"]) for options in all_options]
    heights, positions = (
        [result for result, key in zip(results, starts, strict=True) if key == start]
        for start in (("N", 0), (1, "particles"))
    )
    heights.sort(key=lambda result: -result.parameters["pulse-energy"])
    positions.sort(key=lambda result: result.parameters["cells"])
    figure, (left, right) = plt.subplots(1, 2, figsize=(2 * style.COLUMN, style.HEIGHT))
    table = pd.concat([plot(left, heights), plot(right, positions)])
    style.letter(left, right)
    strong, weak = (style.with_error(result["damping_exponent"]) for result in heights)
    caption = f"""
        Moving peak of the energy difference after a pulse; {parameters(heights, "particles-per-cell", "sigma", "energy")} per degree of
        freedom, in the cell of the pulse ε̃, {replicas(heights + positions)}. (a) Height times t^(2/3) over its mean, from scatterers at rest that have
        relaxed: the paper's pulse, a shock with the mean damping exponent {strong}, and one with a tenth of its excess energy, {weak}.
        (b) Position over time, over that of particles that never scatter, from Gaussian momenta; dashed: ballistic. A fraction of 1/N of
        the arrivals scatters, so that the peak falls behind, less in the long ring. {ERRORS}"""
    return figure, table, caption


if __name__ == "__main__":
    run(draw, "Energy pulse with a tenth of the energy, and in a long ring", relative="1")
