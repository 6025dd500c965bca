"""Ext. 13: growth of the mean square of the heat that passes in equilibrium, against mode coupling, and without momentum.

Q is the integral of J_q = sum v (v²/2 − T) over all particles of a ring of N cells [mode_coupling.md, eqs. M21-M28].
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import listed, number, replicas
from workflow.lib.figure import run
from workflow.lib.fit import with_error
from workflow.lib.load import Result
from workflow.lib.mode_coupling import Chain, logarithm_at

LOOKS: list[style.Look] = [
    {"marker": "o", "color": style.BLUE},
    {"marker": "s", "color": style.VERMILLION},
    {"marker": "^", "color": style.ORANGE},
]
RANDOM: style.Look = {"marker": "D", "color": style.GREEN, "markerfacecolor": "white"}
GAS = ["random_direction", "zeta", "mass"]  # columns that tell gases apart


def chain(result: Result, time: float = np.inf) -> Chain:
    """With the slow particles that move within a time."""
    temperature, length, sigma = (result.parameters[name] for name in ("temperature", "cell-length", "sigma"))
    slow = logarithm_at(time, temperature, length) if np.isfinite(time) else np.inf
    zeta = result.parameters["fugacity"] * length
    return Chain(zeta, (1 + sigma) / (1 - sigma), temperature, length, slow)


def predicted(result: Result, time: float) -> float:
    """<Q²> per cell without a normal part."""
    if result.parameters["random-direction"] or time < result.parameters["fit-from"]:
        return np.nan
    return float(chain(result, time).heat_variance(time)) * result.parameters["cell-length"]


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per gas and time, from the ring whose exponent over the octave from there on, or whose variance, has the
    smallest error."""
    rows = []
    for result in results:
        heat, exponent, gas = result["heat_variance"], result["local_exponent"], chain(result)
        of_gas = (result.parameters["random-direction"], round(gas.zeta, 6), round(gas.mass, 6))
        octaves = {
            "middle": exponent.axes["middle"],
            "local_exponent": exponent.mean,
            "local_exponent_error": exponent.error,
        }
        for k, time in enumerate(heat.axes["time"]):
            octave = {name: values[k] if k < len(values) else np.nan for name, values in octaves.items()}
            row = {"time": time, "heat_variance": heat.mean[k], "heat_variance_error": heat.error[k]}
            rows.append(dict(zip(GAS, of_gas, strict=True)) | {"cells": result.parameters["cells"]} | row | octave
                        | {"predicted": predicted(result, time)})  # fmt: skip
    table = pd.DataFrame(rows)
    table["relative"] = table.heat_variance_error / table.heat_variance
    best = table.sort_values("relative").groupby([*GAS, "time"], sort=False).head(1)
    exponents = (
        table.dropna(subset="middle")
        .sort_values("local_exponent_error")
        .groupby([*GAS, "time"], sort=False)
        .head(1)
    )
    columns = [*GAS, "time", "middle", "local_exponent", "local_exponent_error"]
    merged = best.drop(columns=["relative", *columns[4:]]).merge(exponents[columns], "left", [*GAS, "time"])
    return merged.sort_values([*GAS, "time"], ignore_index=True)


def longest(results: Sequence[Result], gas: pd.Series) -> Result:
    """The run of a gas that covers the longest time; of several the longest ring."""
    same = [one for one in results if tuple(gas[GAS]) == tuple(tabulate([one]).loc[0, GAS])]
    return max(same, key=lambda one: (one["heat_variance"].axes["time"][-1], one.parameters["cells"]))


def sentence(results: Sequence[Result], part: pd.DataFrame) -> str:
    """Exponent at the end, and the amplitude relative to the prediction."""
    last = part.dropna(subset="middle").iloc[-1]
    span = f"{number(last.time)} to {number(part.time[part.time > last.time].min())}"
    exponent = f"{with_error(last.local_exponent, last.local_exponent_error)} from t = {span}"
    if last.random_direction:
        return f"with random directions {exponent}"
    run = longest(results, part.iloc[0])
    first, final = run.parameters["fit-from"], run["heat_variance"].axes["time"][-1]
    theory = chain(run, np.sqrt(first * final)).heat_amplitude
    ratio = with_error(float(run["amplitude"].mean) / theory, float(run["amplitude"].error) / theory)
    return f"{exponent}, fitted amplitude {ratio} of the predicted one, at ζ = {number(last.zeta)}, M = {number(last.mass)}"


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table = tabulate(results)
    figure, (left, right) = plt.subplots(1, 2, figsize=(2 * style.COLUMN, style.HEIGHT))
    looks, said = iter(LOOKS), []
    for (random, zeta, mass), part in table.groupby(GAS, sort=False):
        look = {**style.POINTS, **(RANDOM if random else next(looks))}
        label = rf"$\zeta = {number(zeta)}$, $M = {number(mass)}$"
        value, error = part.heat_variance / part.time, part.heat_variance_error / part.time
        left.errorbar(part.time, value, error, label=f"{label}, random" if random else label, **look)
        left.plot(part.time, part.predicted / part.time, color=look["color"])
        right.errorbar(part.middle, part.local_exponent, part.local_exponent_error, **look)
        said.append(sentence(results, part))
    left.set(
        xscale="log", yscale="log", xlabel="time $t$", ylabel=rf"$\langle Q^2 \rangle/Nt$ ({style.UNITS})"
    )
    style.label_within_decades(left.yaxis)
    left.legend(loc="upper left")
    right.set(xscale="log", xlabel="time $t$", ylabel=r"$d\ln\langle Q^2 \rangle/d\ln t$")
    style.guide_at(right, 4 / 3, "4/3")
    style.guide_at(right, 1, "1")
    style.letter(left, right)
    caption = f"""
        Mean square of the heat Q that passes in a time t in rings of N cells in equilibrium (γ = N, T = λ = 1,
        ζ the flux of particles at p → 0, {replicas(results)}). (a) ⟨Q²⟩/Nt; lines: mode coupling without free
        parameter and without a normal part, ∝ t^(1/3). (b) Local exponents over octaves; diffusion has 1, mode
        coupling 4/3. Last exponents: {listed(said)}. The prediction holds up to corrections of
        some ten percent at these times. Heat spreads superdiffusively if momentum is conserved. Error bars: standard
        errors over replicas."""
    return figure, table, caption


if __name__ == "__main__":
    run(draw, "Heat current in equilibrium", zeta="1", mass="1", predicted="energy^2 length^2")
