"""Fig. 7: spreading of a tagged particle at sigma = 1/2, with the paper's random total momentum and with none, and the part
that is the drift of all particles."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.caption import CHAIN, ERRORS, GAS, number, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import with_error
from workflow.lib.load import Result

ROUNDING = 1e-9  # relative, of times on a logarithmic grid
GUIDED = 100  # the guides span so much of the times
APART = 3  # factor between a guide and the last point

# By whether the total momentum is zero.
LOOKS = {
    False: style.points("o", style.BLUE, label="random total momentum"),
    True: style.points("s", style.VERMILLION, "white", label="zero total momentum"),
}


def zero(result: Result) -> bool:
    return bool(result.parameters["zero-total-momentum"])


def tabulate(result: Result) -> pd.DataFrame:
    """One row per time. The error of the fraction neglects that both parts vary together: it is an upper bound."""
    variance, drift, slope = result["variance"], result["centre_of_mass"], result["local_slope"]
    columns = result.columns("variance", "centre_of_mass")
    table = pd.DataFrame({"time": variance.axes["time"], "zero_total_momentum": zero(result), **columns})
    table["fraction"] = drift.mean / variance.mean
    relative = np.hypot(drift.error / drift.mean, variance.error / variance.mean)
    table["fraction_error"] = table["fraction"] * relative
    table["slope_to_next"], table["slope_to_next_error"] = (
        np.append(values, np.nan) for values in (slope.mean, slope.error)
    )
    return table


def caption(random: pd.DataFrame, results: Sequence[Result], window: tuple[float, float]) -> str:
    last = random.iloc[-1]
    alpha = {zero(result): style.with_error(result["alpha"]) for result in results}
    without = f"With zero total momentum α is {alpha[True]}." if True in alpha else ""
    return f"""
        Spreading of a tagged particle in a closed chain, {parameters(results, *CHAIN, *GAS, "relaxation-time")}, {replicas(results)}.
        (a) Mean square displacement with random total momentum, as in the paper, and with zero total momentum; line: centre of
        mass of the former; dashed: t and t². (b) Local exponents. In the shaded window, t = {number(window[0])} to {number(window[1])}, the former has α =
        {alpha[False]}, slightly below two as in the paper. It is drift of the centre of mass, not superdiffusion:
        {with_error(100 * last.fraction, 100 * last.fraction_error)} % at the end. {without} {ERRORS}"""


def draw(results: Sequence[Result]) -> Drawn:
    results = sorted(results, key=zero)
    tables = [tabulate(result) for result in results]
    random = tables[0]
    time = random.time
    last = float(time.iloc[-1])
    window = (last / 10 ** results[0].parameters["fit-decades"], last)
    figure, (above, below) = style.stacked(2, 1, height=1.6)
    for result, table in zip(results, tables, strict=True):
        look = LOOKS[zero(result)]
        above.errorbar(time, table.variance, table.variance_error, **look)
        middle = np.sqrt(time * time.shift(-1))
        below.errorbar(middle, table.slope_to_next, table.slope_to_next_error, **look)
    above.plot(time, random.centre_of_mass, color=style.BLACK, label="centre of mass")
    late = time[time > last / GUIDED]
    for table, power, factor in ((random, 2, APART), (tables[-1], 1, 1 / APART)):
        guide = factor * table.variance.iloc[-1] * (late / last) ** power
        above.plot(late, guide, **style.GUIDE)
        name, lift = ("$t^2$", (-18, -2)) if power == 2 else ("$t$", (-8, -14))
        above.annotate(name, (last, guide.iloc[-1]), lift, textcoords="offset points", size=8, ha="right")
    for value in (1, 2):
        below.axhline(value, **style.GUIDE)
    for axes in (above, below):
        axes.axvspan(*window, **style.WINDOW)
    above.set(xscale="log", yscale="log", ylabel=r"$\langle x^2\rangle$")
    below.set(xlabel=f"time $t$ ({style.UNITS})", ylabel=r"$d\ln\langle x^2\rangle/d\ln t$", ylim=(0.5, 2.2))
    above.legend(loc="upper left", title=rf"$\sigma = {results[0].parameters['sigma']:g}$", alignment="left")
    return figure, pd.concat(tables), caption(random, results, window)


if __name__ == "__main__":
    run(draw, "Mean square displacement of a tagged particle", fraction="1", slope_to_next="1")
