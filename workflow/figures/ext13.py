"""Ext. 13: growth of the mean square of the heat that passes in equilibrium, against mode coupling, and without momentum.

Q is the integral of J_q = sum v (v²/2 − T) over all particles of a ring of N cells [mode_coupling.md, eqs. M21-M28].
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.caption import listed, number, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import with_error
from workflow.lib.load import Result
from workflow.lib.mode_coupling import Chain, logarithm_at

LOOKS = [("o", style.BLUE), ("s", style.VERMILLION), ("^", style.ORANGE)]
RANDOM = style.points("D", style.GREEN, "white")
GAS = ["rule", "zeta", "mass"]  # columns that tell gases apart


def chain(result: Result, time: float = np.inf) -> Chain:
    """With the slow particles that move within a time."""
    temperature, length, sigma = (result.parameters[name] for name in ("temperature", "cell-length", "sigma"))
    slow = logarithm_at(time, temperature, length) if np.isfinite(time) else np.inf
    zeta = result.parameters["fugacity"] * length
    return Chain(zeta, (1 + sigma) / (1 - sigma), temperature, length, slow)


def predicted(result: Result, time: float) -> float:
    """<Q²> per cell without a normal part."""
    if result.parameters["rule"] != "elastic" or time < result.parameters["fit-from"]:
        return np.nan
    return float(chain(result, time).heat_variance(time) * result.parameters["cell-length"])


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per gas and time, from the ring whose exponent over the octave from there on, or whose variance, has the
    smallest error."""
    rows = []
    for result in results:
        heat, exponent, gas = result["heat_variance"], result["local_exponent"], chain(result)
        of_gas = (result.parameters["rule"], gas.zeta, gas.mass)
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


def label(gas: pd.Series) -> str:
    random = ", random directions" if gas.rule == "random-direction" else ""
    return f"ζ = {number(gas.zeta)}, M = {number(gas.mass)}{random}"


def last_octave(part: pd.DataFrame) -> str:
    """Exponent of a gas over the last octave."""
    last = part.dropna(subset="middle").iloc[-1]
    return f"{with_error(last.local_exponent, last.local_exponent_error)} ({label(last)})"


def amplitude(results: Sequence[Result]) -> str:
    """Fitted amplitude of the run over the longest time, relative to the predicted one in the middle of the fit."""
    sound = [one for one in results if one.parameters["rule"] == "elastic"]
    longest = max(sound, key=lambda one: one["heat_variance"].axes["time"][-1])
    first, last = longest.parameters["fit-from"], longest["heat_variance"].axes["time"][-1]
    gas = chain(longest, np.sqrt(first * last))
    fitted = longest["amplitude"]
    ratio = with_error(float(fitted.mean) / gas.heat_amplitude, float(fitted.error) / gas.heat_amplitude)
    return f"A fit with a normal part over t = {number(first)} to {number(last)} gives {ratio} of the predicted amplitude."


def draw(results: Sequence[Result]) -> Drawn:
    table = tabulate(results)
    figure, (left, right) = plt.subplots(1, 2, figsize=(2 * style.COLUMN, style.HEIGHT))
    looks, said, reached = iter(LOOKS), [], []
    for _, part in table.groupby(GAS, sort=False):
        gas = part.iloc[0]
        look = RANDOM if gas.rule == "random-direction" else style.points(*next(looks))
        error = part.heat_variance_error / part.time
        left.errorbar(part.time, part.heat_variance / part.time, error, label=label(gas), **look)
        left.plot(part.time, part.predicted / part.time, color=look["color"])
        right.errorbar(part.middle, part.local_exponent, part.local_exponent_error, **look)
        said.append(last_octave(part))
        last = part.iloc[-1]
        if np.isfinite(last.predicted):
            reached.append(
                with_error(last.heat_variance / last.predicted, last.heat_variance_error / last.predicted)
            )
    left.set(
        xscale="log", yscale="log", xlabel="time $t$", ylabel=rf"$\langle Q^2 \rangle/Nt$ ({style.UNITS})"
    )
    style.label_within_decades(left.yaxis)
    left.legend(loc="lower right")
    right.set(xscale="log", xlabel="time $t$", ylabel=r"$d\ln\langle Q^2 \rangle/d\ln t$")
    style.guide_at(right, 4 / 3, "4/3")
    style.guide_at(right, 1, "1")
    style.letter(left, right)
    caption = f"""
        Heat Q that passes in a time t in rings in equilibrium, {parameters(results, "cell-length")},
        T = {listed(sorted({number(one.parameters["temperature"]) for one in results}))}, {replicas(results)}; ζ: flux of slow particles.
        (a) Mean square per cell and time. Lines: fluctuating hydrodynamics, nothing fitted, without normal diffusion; the
        last points are {", ".join(reached)} of them. Random directions do not conserve momentum. (b) Exponents over octaves;
        dashed: 4/3 of the theory, and diffusion. In the last octave: {", ".join(said)}. {amplitude(results)}"""
    return figure, table, caption


if __name__ == "__main__":
    run(draw, "Heat current in equilibrium", zeta="1", mass="1", predicted="energy^2 length^2")
