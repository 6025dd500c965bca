"""Fig. 7: spreading of a tagged particle at sigma = 1/2, and the part that is the drift of all particles."""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import CHAIN, ERRORS, GAS, number, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import with_error
from workflow.lib.load import Result

ROUNDING = 1e-9  # relative, of times on a logarithmic grid
GUIDED = 100  # the guide spans so much of the times
ABOVE = 4  # factor by which the guide lies above the last point


def tabulate(result: Result) -> pd.DataFrame:
    """One row per time. The error of the share neglects that both parts vary together: it is an upper bound."""
    variance, drift, slope = result["variance"], result["centre_of_mass"], result["local_slope"]
    table = pd.DataFrame({"time": variance.axes["time"]})
    table["variance"], table["variance_error"] = variance.mean, variance.error
    table["centre_of_mass"], table["centre_of_mass_error"] = drift.mean, drift.error
    table["share"] = drift.mean / variance.mean
    relative = np.hypot(drift.error / drift.mean, variance.error / variance.mean)
    table["share_error"] = table["share"] * relative
    table["slope_to_next"], table["slope_to_next_error"] = (
        np.append(values, np.nan) for values in (slope.mean, slope.error)
    )
    return table


def caption(table: pd.DataFrame, result: Result, window: tuple[float, float]) -> str:
    last = table.iloc[-1]
    fitted = table[(table.time > window[0] * (1 - ROUNDING)) & table.slope_to_next.notna()].iloc[[0, -1]]
    slopes = [with_error(one.slope_to_next, one.slope_to_next_error) for one in fitted.itertuples()]
    return f"""
        Mean square displacement of a tagged particle (circles) and of the centre of mass of all particles (squares) in a closed chain,
        {parameters([result], *CHAIN, *GAS, "relaxation-time")}, {replicas([result])}. (a) Both, with the paper's square of t above them; (b) the share of the centre of mass; its error is an upper bound, as both vary together; (c) local slope between neighbouring
        times, with guides for ballistic and diffusive spreading. {ERRORS}. Fitted in the shaded window from t = {number(window[0])} to
        {number(window[1])}: α = {style.with_error(result["alpha"])}, slightly below the square as in the paper, but no property of the gas: the
        local slope goes from {slopes[0]} to {slopes[1]} in the window, as diffusion gives way to a drift. At the last
        time {with_error(100 * last.share, 100 * last.share_error)} % of it is the drift of all particles together, which the
        conserved total momentum keeps going."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    (result,) = results
    table = tabulate(result)
    time = table.time
    last = float(time.iloc[-1])
    window = (last / 10 ** result.parameters["fit-decades"], last)
    figure, (above, middle, below) = plt.subplots(
        3, 1, sharex=True, figsize=(style.COLUMN, 1.8 * style.HEIGHT), height_ratios=[2.4, 1, 1]
    )
    tagged = {"marker": "o", "color": style.BLUE, **style.POINTS}
    drift = {"marker": "s", "color": style.VERMILLION, "markerfacecolor": "white", **style.POINTS}
    above.errorbar(time, table.variance, table.variance_error, label=r"$\langle x^2\rangle$", **tagged)
    above.errorbar(time, table.centre_of_mass, table.centre_of_mass_error, label="centre of mass", **drift)
    late = time > last / GUIDED
    guide = ABOVE * table.variance.iloc[-1] * (time[late] / last) ** 2
    above.plot(time[late], guide, **style.GUIDE)
    above.annotate(
        "$t^2$", (time.iloc[-1], guide.iloc[-1]), (-12, -7), textcoords="offset points", size=8, ha="right"
    )
    middle.errorbar(time, table["share"], table.share_error, **drift)
    below.errorbar(np.sqrt(time * time.shift(-1)), table.slope_to_next, table.slope_to_next_error, **tagged)
    for value in (1, 2):
        below.axhline(value, **style.GUIDE)
    for axes in (above, below):
        axes.axvspan(*window, **style.WINDOW)
    above.set(xscale="log", yscale="log", ylabel="mean square displacement")
    middle.set(ylabel="share of the\ncentre of mass", ylim=(0, 1.05))
    below.set(xlabel=f"time $t$ ({style.UNITS})", ylabel=r"$d\ln\langle x^2\rangle/d\ln t$", ylim=(0.5, 2.2))
    above.legend(loc="upper left", title=rf"$\sigma = {result.parameters['sigma']:g}$")
    style.letter(above, middle, below)
    figure.align_ylabels()
    return figure, table, caption(table, result, window)


if __name__ == "__main__":
    names = ("share", "share_error", "slope_to_next", "slope_to_next_error")
    run(draw, "Mean square displacement of a tagged particle", **dict.fromkeys(names, "1"))
