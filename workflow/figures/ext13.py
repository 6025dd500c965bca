"""Ext. 13: growth of the mean square of the heat that passes in equilibrium, against mode coupling, and the control: rings in which a
fraction of the collisions reverses the momentum of the scatterer, and does not conserve momentum.

Q is the integral of J_q = sum v (v²/2 − T) over all particles of a ring of N cells [mode_coupling.md, eqs. M21-M28]. The table also has
rings with random directions, D = <Q²>/2Nt of the control at a common εt, and amplitudes of the correlation of J_q in long rings, over the
predicted one and over that of Gaussian fluctuations with the measured sound peak (ext. 3).
"""

from collections.abc import Sequence
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, format_number
from workflow.lib.figure import Parts, main, plots
from workflow.lib.fit import format_with_error, mean_of
from workflow.lib.load import Result
from workflow.physics.mode_coupling import Chain
from workflow.physics.rings import LOOKS, chain
from workflow.physics.setting import REVERSAL, epsilon

ELASTIC = "elastic"
REACH = 4  # largest distance from the centre of a sound peak that counts, in widths
SETTLED = 64  # first time, in λ/√T, from which on amplitudes are fitted; before, the exponents still fall
GAS = ["rule", "epsilon", "zeta", "mass"]  # columns that identify a gas
COMMON = 5  # εt, in λ/√T, at which D of different ε are compared
GASES = "light light-long light-longest dense dense-long dense-longest dilute dilute-long dilute-longest sparse-longest "
LATE = 8  # first time, in λ/√T, of the exponents that are plotted against εt


def predicted(result: Result, time: float) -> float:
    """<Q²> per cell in theory, without normal diffusion; NaN before the range of the fit and without conserved momentum."""
    if result.parameters["rule"] != ELASTIC or time < result.parameters["fit-from"]:
        return np.nan
    return float(chain(result, time).heat_variance(time) * result.parameters["cell-length"])


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per gas and time. The variance, and the exponent over the octave that begins at this time, are each taken from the ring
    in which their error is smallest."""
    rows = []
    for result in results:
        heat, exponent, gas = result["heat_variance"], result["local_exponent"], chain(result)
        of_gas = (result.parameters["rule"], epsilon(result), gas.zeta, gas.mass)
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
    merged = best.drop(columns=["relative", *columns[len(GAS) + 1 :]]).merge(
        exponents[columns], "left", [*GAS, "time"]
    )
    return merged.sort_values([*GAS, "time"], ignore_index=True)


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


def draw_gases(above: Axes, below: Axes, table: pd.DataFrame) -> None:
    """Plots the mean squares with those in theory, and the exponents, of the gases that conserve momentum."""
    gases = table[table.rule == ELASTIC].groupby(["zeta", "mass"])
    for look, ((zeta, mass), part) in zip(LOOKS, gases, strict=False):
        points = style.points(*look, label=rf"$\zeta = {format_number(zeta)}$, $M = {format_number(mass)}$")
        error = part.heat_variance_error / part.time
        above.errorbar(part.time, part.heat_variance / part.time, error, **points)
        above.plot(part.time, part.predicted / part.time, color=points["color"])
        below.errorbar(part.middle, part.local_exponent, part.local_exponent_error, **points)
    above.set(
        xscale="log", yscale="log", xlabel="time $t$", ylabel=rf"$\langle Q^2 \rangle/Nt$ ({style.UNITS})"
    )
    style.label_within_decades(above.yaxis)


def rate(result: Result) -> float:
    """√T/λ, the inverse of the unit of time."""
    return float(np.sqrt(result.parameters["temperature"]) / result.parameters["cell-length"])


def draw_control(against_time: Axes, scaled: Axes, control: pd.DataFrame, unit: float) -> None:
    """Plots the exponents of one gas for every ε, and those after the first collisions against εt, on which they coincide if the
    crossover is at a fixed εt. unit: √T/λ."""
    by_fraction = control.groupby("epsilon")
    for (fraction, part), color, marker in zip(by_fraction, style.SEQUENCE, "osv^D", strict=False):
        look = style.points(marker, color, label=rf"$\epsilon = {fraction:g}$", linestyle="-", linewidth=0.6)
        against_time.errorbar(part.middle, part.local_exponent, part.local_exponent_error, **look)
        late = part[part.time * unit >= LATE]
        if fraction:
            scaled.errorbar(fraction * late.middle, late.local_exponent, late.local_exponent_error, **look)
    scaled.set_xlabel(r"$\epsilon t$")


def diffusion(control: pd.DataFrame, unit: float) -> pd.DataFrame:
    """D at the common εt, by ε: interpolated on logarithmic axes, with the larger relative error of both neighbours."""
    rows = []
    for fraction, part in control[control.epsilon > 0].groupby("epsilon"):
        scaled = fraction * unit * part.time.to_numpy()
        if scaled[0] < COMMON <= scaled[-1]:
            logarithms = (np.log(values) for values in (scaled, part.heat_variance / (2 * part.time)))
            value = np.exp(np.interp(np.log(COMMON), *logarithms))
            last = int(np.searchsorted(scaled, COMMON))
            relative = (part.heat_variance_error / part.heat_variance).iloc[last - 1 : last + 1].max()
            rows.append({"epsilon": fraction, "diffusion": value, "diffusion_error": value * relative})
    return pd.DataFrame(rows)


def between(exponents: pd.DataFrame) -> str:
    """The smallest and the largest of exponents."""
    ascending = exponents.sort_values("local_exponent")
    return " to ".join(
        format_with_error(row.local_exponent, row.local_exponent_error)
        for _, row in ascending.iloc[[0, -1]].iterrows()
    )


def caption(table: pd.DataFrame, control: pd.DataFrame) -> str:
    last = table[table.rule == ELASTIC].dropna(subset="predicted").groupby(["zeta", "mass"]).tail(1)
    off = 100 * (last.predicted / last.heat_variance - 1).abs().max()
    gas = control.iloc[0]
    known = table.dropna(subset="middle")
    ends, broken = (known[known.rule == rule].groupby(GAS).tail(1) for rule in (ELASTIC, REVERSAL))
    most = broken.loc[broken.local_exponent.idxmax()]
    return f"""
        Heat current of equilibrium rings, summed over cells and integrated over t to Q. (a) Mean square; lines: mode coupling, nothing
        fitted, up to {off:.0f} % off. (b) Exponents over octaves, the last {between(ends)}. (c), (d) ζ = {format_number(gas.zeta)}, M = {format_number(gas.mass)}: reversal of
        scatterers in a fraction ε of collisions, the last at most {format_with_error(most.local_exponent, most.local_exponent_error)}. Table: also random directions. {ERRORS}"""


@plots(GASES + "reversal reversal-rare random heat")
def draw(results: Sequence[Result]) -> Parts:
    heat = [result for result in results if result.provenance["program"] == "heat_current"]
    peaks = [result for result in results if result.provenance["program"] == "correlation"]
    elastic = [result for result in heat if result.parameters["rule"] == ELASTIC]
    settled = [result for result in elastic if result.parameters["fit-from"] * rate(result) >= SETTLED]
    table, unit = tabulate(heat), rate(heat[0])
    broken = table[table.rule == REVERSAL].iloc[0]
    same = (table.zeta == broken.zeta) & (table.mass == broken.mass)
    control = table[same & table.rule.isin([ELASTIC, REVERSAL])]
    figure, panels = plt.subplots(2, 2, figsize=(2 * style.COLUMN, 1.9 * style.HEIGHT))
    (left, right), (below_left, below_right) = panels
    for axes in (right, below_left, below_right):
        axes.set(xscale="log", xlabel="time $t$", ylabel=r"$d\ln\langle Q^2 \rangle/d\ln t$", ylim=(0.9, 1.8))
        style.guide_at(axes, 1, "1")
        style.guide_at(axes, 4 / 3, "4/3")
    draw_gases(left, right, table)
    draw_control(below_left, below_right, control, unit)
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=4)
    below_left.legend(loc="upper right")
    style.letter(*panels.flat)
    whole = pd.concat([table, diffusion(control, unit), amplitudes(longest_rings(settled), peaks)])
    return figure, whole, caption(table, control)


if __name__ == "__main__":
    own = dict.fromkeys(("zeta", "mass", "epsilon", "amplitude_ratio", "gaussian_ratio"), "1")
    own |= dict.fromkeys(("fit_from", "fit_to"), "time")
    main(
        draw,
        "Heat current in equilibrium",
        predicted="energy^2 length^2",
        diffusion="energy^2 length^2/time",
        **own,
    )
