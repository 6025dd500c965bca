"""Ext. 13: growth of the mean square of the heat that passes in equilibrium, against mode coupling, and without conserved momentum.

Q is the integral of J_q = sum v (v²/2 − T) over all particles of a ring of N cells [mode_coupling.md, eqs. M21-M28]. The fitted
amplitude of its correlation is compared with that which the measured sound peaks (ext. 3) would have if they were Gaussian.
"""

from collections.abc import Sequence
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.caption import RULES, number, parameters, replicas, rule
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import mean_of, with_error
from workflow.lib.load import Result
from workflow.lib.mode_coupling import Chain
from workflow.lib.rings import LOOKS, chain

RANDOM = RULES["random-direction"], style.points("D", style.GREEN, "white")
REACH = 4  # largest distance from the centre of a sound peak that counts, in widths
GAS = ["rule", "zeta", "mass"]  # columns that identify a gas


def predicted(result: Result, time: float) -> float:
    """<Q²> per cell in theory, without normal diffusion; NaN before the range of the fit and without conserved momentum."""
    if result.parameters["rule"] != "elastic" or time < result.parameters["fit-from"]:
        return np.nan
    return float(chain(result, time).heat_variance(time) * result.parameters["cell-length"])


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per gas and time. The variance, and the exponent over the octave that begins at this time, are each taken from the ring
    in which their error is smallest."""
    rows = []
    for result in results:
        heat, exponent, gas = result["heat_variance"], result["local_exponent"], chain(result)
        of_gas = (rule(result), gas.zeta, gas.mass)
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
    another = "" if gas.rule == "elastic" else f", {gas.rule}"
    return f"ζ = {number(gas.zeta)}, M = {number(gas.mass)}{another}"


def last_octave(part: pd.DataFrame) -> str:
    """Exponent of a gas over the last octave."""
    last = part.dropna(subset="middle").iloc[-1]
    gas = f"{number(last.zeta)}; {number(last.mass)}" if last.rule == "elastic" else last.rule
    return f"{with_error(last.local_exponent, last.local_exponent_error)} ({gas})"


def longest_rings(results: Sequence[Result]) -> list[Result]:
    """The run over the longest time of every gas, sorted by ζ and mass."""
    longest: dict[tuple[float, float], Result] = {}
    for result in results:
        gas = chain(result)
        longest[gas.zeta, gas.mass] = max(longest.get((gas.zeta, gas.mass), result), result, key=last_time)
    return [longest[gas] for gas in sorted(longest)]


def last_time(result: Result) -> float:
    return float(result["heat_variance"].axes["time"][-1])


def amplitudes(rings: Sequence[Result], peaks: Sequence[Result]) -> pd.DataFrame:
    """One row per gas: the fitted amplitude of <J_q(t) J_q(0)> over the predicted one [eqs. M25 and M22], and over that of Gaussian
    fluctuations with the measured sound peak, averaged over the times in the range of the fit at which the peak was measured."""
    rows = []
    for ring in rings:
        first, last = ring.parameters["fit-from"], last_time(ring)
        gas = replace(chain(ring, np.sqrt(first * last)), temperature=1.0, cell_length=1.0)  # as the fit
        fitted = np.array([float(ring["amplitude"].mean), float(ring["amplitude"].error)])
        row = {"zeta": gas.zeta, "mass": gas.mass, "fit_from": first, "fit_to": last}
        row |= dict(
            zip(("amplitude_ratio", "amplitude_ratio_error"), fitted / gas.heat_amplitude, strict=True)
        )
        squares = [
            square_of_peak(peak, index, gas)
            for peak in peaks
            if (chain(peak).zeta, chain(peak).mass) == (gas.zeta, gas.mass)
            for index, time in enumerate(peak["peak"].axes["time"])
            if first <= time <= last
        ]
        if squares:
            square, error, _ = mean_of(*np.transpose(squares))
            ratio = fitted[0] / float(gas.gaussian_heat_correlation(square))
            row["gaussian_ratio"] = ratio
            row["gaussian_ratio_error"] = ratio * np.hypot(fitted[1] / fitted[0], error / square)
        rows.append(row)
    return pd.DataFrame(rows)


def square_of_peak(result: Result, index: int, gas: Chain) -> tuple[float, float]:
    """t^(2/3) times the integral of the square of the sound peak of unit area, and its error, in the units of T and λ. Errors of
    neighbouring cells are correlated, so the relative error of the peak's height is used."""
    temperature, length = result.parameters["temperature"], result.parameters["cell-length"]
    time = float(result["peak"].axes["time"][index]) * np.sqrt(temperature) / length
    correlation, peak = result["momentum_correlation"], result["peak"]
    middle = correlation.mean.shape[1] // 2
    offset = (np.arange(middle) - gas.sound_speed * time) / (gas.self_coupling * time) ** (2 / 3)
    near = (offset > -REACH) & (offset < REACH)
    right, left = correlation.mean[index, middle : 2 * middle], correlation.mean[index, middle:0:-1]
    noise = correlation.error[index, middle : 2 * middle] ** 2
    # The mean of a square exceeds the square of the mean by the variance. Averaging both sides does not reduce it: they are equal, as they
    # come from the same pairs of cells.
    squares = ((0.5 * (right + left)) ** 2 - noise) / (temperature * gas.peak_area) ** 2
    square = time ** (2 / 3) * float(np.sum(squares[near]))
    return square, abs(square) * float(peak.error[index] / peak.mean[index])


def draw(results: Sequence[Result]) -> Drawn:
    heat = [result for result in results if result.provenance["program"] == "heat_current"]
    table = tabulate(heat)
    rings = longest_rings([result for result in heat if result.parameters["rule"] == "elastic"])
    compared = amplitudes(
        rings, [result for result in results if result.provenance["program"] == "correlation"]
    )
    figure, (left, right) = plt.subplots(1, 2, figsize=(2 * style.COLUMN, style.HEIGHT))
    looks, exponents = iter(LOOKS), []
    for _, part in table.groupby(GAS, sort=False):
        gas = part.iloc[0]
        look = RANDOM[1] if gas.rule == RANDOM[0] else style.points(*next(looks))
        error = part.heat_variance_error / part.time
        left.errorbar(part.time, part.heat_variance / part.time, error, label=label(gas), **look)
        left.plot(part.time, part.predicted / part.time, color=look["color"])
        right.errorbar(part.middle, part.local_exponent, part.local_exponent_error, **look)
        exponents.append(last_octave(part))
    left.set(
        xscale="log", yscale="log", xlabel="time $t$", ylabel=rf"$\langle Q^2 \rangle/Nt$ ({style.UNITS})"
    )
    style.label_within_decades(left.yaxis)
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    right.set(xscale="log", xlabel="time $t$", ylabel=r"$d\ln\langle Q^2 \rangle/d\ln t$")
    style.guide_at(right, 4 / 3, "4/3")
    style.guide_at(right, 1, "1")
    style.letter(left, right)
    best = compared.sort_values("amplitude_ratio_error").iloc[0]
    gaussian = compared.dropna(subset="gaussian_ratio") if "gaussian_ratio" in compared else compared[:0]
    fluctuations = (
        f" Over that of Gaussian sound: {ratios(gaussian, 'gaussian_ratio')}." if len(gaussian) else ""
    )
    caption = f"""
        Heat Q that passes in a time t in rings in equilibrium, {parameters(heat, "cell-length", "temperature")}, {replicas(heat)}; ζ: flux of
        slow particles. (a) Mean square per cell and time. Lines: fluctuating hydrodynamics, nothing fitted, without normal
        diffusion. (b) Exponents over octaves; dashed: theory, diffusion. Last octaves (ζ; M): {", ".join(exponents)}. Amplitudes fitted with a normal part, from t =
        {number(best.fit_from)} on, over the predicted: {ratios(compared, "amplitude_ratio")}.{fluctuations}"""
    return figure, pd.concat([table, compared]), caption


def ratios(table: pd.DataFrame, name: str) -> str:
    values = map(with_error, table[name], table[f"{name}_error"])
    return ", ".join(
        f"{value} ({number(zeta)}; {number(mass)})"
        for value, zeta, mass in zip(values, table.zeta, table.mass, strict=True)
    )


if __name__ == "__main__":
    own = {
        "zeta": "1",
        "mass": "1",
        "amplitude_ratio": "1",
        "gaussian_ratio": "1",
        "fit_from": "time",
        "fit_to": "time",
    }
    run(draw, "Heat current in equilibrium", predicted="energy^2 length^2", **own)
