"""Ext. 14: the energy pulse of figs. 9 and 10 with a tenth of its energy (γ = N), and in a ring ten times as long (γ = 1)."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, number, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.load import Result

SOUND = 2 / 3

# By γ: quantity, its power of time that is divided out, and label of the axis.
PLOTTED = {
    "N": ("peak", -SOUND, r"peak $\times\, t^{2/3}$, relative"),
    1: ("peak_position", 1, r"position $x_p/t$, relative"),
}
LOOKS = [style.points("o", style.VERMILLION, "white"), style.points("s", style.BLUE)]


def scaled(result: Result) -> pd.DataFrame:
    """The height or the position of the peak over its law, relative to the first time that has a peak."""
    name, power, _ = PLOTTED[result.parameters["gamma"]]
    found = result[name]
    known = np.isfinite(found.mean)
    time = found.axes["time"][known]
    value, error = (array[known] / time**power for array in (found.mean, found.error))
    columns = {"time": time, "relative": value / value[:1], "relative_error": error / value[:1]}
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
    given = [one.parameters for one in results]
    starts = [(each["gamma"], each["scatterer-temperature"]) for each in given]
    heights, positions = (
        [one for one, of_it in zip(results, starts, strict=True) if of_it == start]
        for start in (("N", 0), (1, "particles"))
    )
    heights.sort(key=lambda one: -one.parameters["pulse-energy"])
    positions.sort(key=lambda one: one.parameters["cells"])
    figure, (left, right) = plt.subplots(1, 2, figsize=(2 * style.COLUMN, style.HEIGHT))
    table = pd.concat([plot(left, heights), plot(right, positions)])
    style.letter(left, right)
    strong, weak = (style.with_error(one["damping_exponent"]) for one in heights)
    caption = f"""
        Moving peak of the energy difference after a pulse; {parameters(heights, "particles-per-cell", "sigma", "energy")} per degree of
        freedom, in the cell of the pulse ε̃, {replicas(heights + positions)}. (a) Height times t^(2/3) over its first value, from scatterers at rest that have
        relaxed: the paper's pulse, a shock with the mean damping exponent {strong}, and one with a tenth of its excess energy, {weak}.
        (b) Position over time, over its first value, from Gaussian momenta; ballistic: horizontal. In the short ring the cell of the
        pulse is wide beside the distance, and particles scatter on the way. {ERRORS}"""
    return figure, table, caption


if __name__ == "__main__":
    run(draw, "Energy pulse with a tenth of the energy, and in a long ring", relative="1")
