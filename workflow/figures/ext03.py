"""Ext. 3: sound and heat peaks of rings in equilibrium, against mode coupling without a fitted parameter.

C_g, the covariance of the momenta of two cells, has the sound peaks [mode_coupling.md, eq. M19]; that of E_s - theta E_p, the
energies of scatterer and particles with theta = 1/(2 zeta), has the heat peak [eq. M29].
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.figures.ext13 import chain
from workflow.lib import style
from workflow.lib.caption import listed, number, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import with_error
from workflow.lib.load import Result
from workflow.lib.mode_coupling import Chain, f_kpz, levy

FIRST = 16  # time from which a peak is wider than cells, in λ/√T
HALF_WIDTH = 0.880466  # of f_KPZ
REACH = 3  # of the scaled profiles
HEAT_REACH = 6
BIN = 0.2  # of the scaled distances, over which profiles are averaged


class Record(NamedTuple):
    """Profiles at one time, from the run in which they have the smallest error."""

    result: Result
    position: int  # of the time
    time: float
    gas: Chain  # with infinitely many slow particles
    mobile: Chain  # with those that move within the time

    def value(self, name: str) -> tuple[float, float]:
        quantity = self.result[name]
        return float(quantity.mean[self.position]), float(quantity.error[self.position])

    def profile(self, name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Distances from the centre, in lengths; mean of both sides, and its error."""
        quantity = self.result[name]
        mean, error = quantity.mean[self.position], quantity.error[self.position]
        middle = len(mean) // 2
        sides = 0.5 * (mean[middle:] + mean[middle::-1][: len(mean) - middle])
        return np.arange(len(sides)) * self.gas.cell_length, sides, error[middle:]


def records(results: Sequence[Result]) -> list[Record]:
    """By gas and time."""
    found: dict[tuple[float, float, float], Record] = {}
    for result in results:
        for index, time in enumerate(result["peak"].axes["time"]):
            gas, mobile = chain(result), chain(result, time)
            one = Record(result, index, time, gas, mobile)
            key = (gas.zeta, gas.mass, time)
            error = float(np.mean(result["momentum_correlation"].error[index]))
            if time * np.sqrt(gas.temperature) / gas.cell_length >= FIRST and (
                key not in found or error < np.mean(found[key].profile("momentum_correlation")[2])
            ):
                found[key] = one
    return [found[key] for key in sorted(found)]


def binned(x: np.ndarray, y: np.ndarray, error: np.ndarray) -> pd.DataFrame:
    """Means over the cells of every bin, whose errors are almost independent."""
    cells = pd.DataFrame({"x": x, "y": y, "y_error": error**2}).groupby(np.floor(x / BIN))
    found = cells.mean()
    return found.assign(y_error=np.sqrt(found.y_error / cells.size())).reset_index(drop=True)


def scaled_sound(record: Record) -> pd.DataFrame:
    """Peak of unit area about the distance ct, in units of (λ_s t)^(2/3) [eq. M19]."""
    x, y, error = record.profile("momentum_correlation")
    unit = (record.gas.self_coupling * record.time) ** (2 / 3)
    per_area = unit / (record.gas.peak_area * record.gas.cell_length**2)
    offset = (x - record.gas.sound_speed * record.time) / unit
    near = np.abs(offset) < REACH
    return binned(offset[near], per_area * y[near], per_area * error[near])


def scaled_heat(record: Record) -> pd.DataFrame:
    """Peak of unit area in units of (D_h t)^(3/5), with the logarithm of the mobile particles [eq. M29]."""
    x, y, error = record.profile("heat_correlation")
    unit = (record.mobile.heat_spreading * record.time) ** (3 / 5)
    per_area = unit / (heat_area(record) * record.gas.cell_length)
    near = x < HEAT_REACH * unit
    return binned(x[near] / unit, per_area * y[near], per_area * error[near])


def heat_area(record: Record) -> float:
    """Of the covariances of the cells: T^4/(4 λ χ_q)."""
    return record.gas.temperature**4 / (4 * record.gas.cell_length * record.mobile.heat_susceptibility)


def draw_peaks(
    axes: Axes, shown: Sequence[Record], scaled: Callable[[Record], pd.DataFrame]
) -> list[pd.DataFrame]:
    parts = []
    for record, color, dashes in zip(shown, style.SEQUENCE[1:], style.DASHES[1:], strict=False):
        part = scaled(record)
        axes.plot(part.x, part.y, color=color, linestyle=dashes, label=f"$t = {record.time:g}$")
        style.band(axes, part.x, part.y, part.y_error, color)
        parts.append(part.assign(zeta=record.gas.zeta, mass=record.gas.mass, time=record.time))
    return parts


# Measured over predicted: name of the quantity, prediction, marker, colour, name in the legend.
RATIOS: list[tuple[str, Callable[[Record], float], str, str, str]] = [
    ("peak", lambda one: float(one.gas.sound_peak(one.gas.sound_speed * one.time, one.time)) * one.gas.cell_length**2,
     "o", style.BLUE, "height"),
    ("peak_width", lambda one: 2 * HALF_WIDTH * (one.gas.self_coupling * one.time) ** (2 / 3) / one.gas.cell_length,
     "s", style.VERMILLION, "width"),
    ("peak_area", lambda one: one.gas.peak_area * one.gas.cell_length, "^", style.ORANGE, "area"),
    ("centroid", lambda one: one.mobile.sound_speed_in_cells * one.time, "D", style.GREEN, "speed"),
]  # fmt: skip


def tabulate(found: Sequence[Record]) -> pd.DataFrame:
    """One row per gas and time: measured over predicted."""
    rows = []
    for record in found:
        row = {"zeta": record.gas.zeta, "mass": record.gas.mass, "time": record.time}
        expected = {name: predicted(record) for name, predicted, *_ in RATIOS}
        for name, predicted in (expected | {"heat_area": heat_area(record)}).items():
            value, error = record.value(name)
            row |= {f"{name}_ratio": value / predicted, f"{name}_ratio_error": error / predicted}
        rows.append(row)
    return pd.DataFrame(rows)


def draw_ratios(axes: Axes, table: pd.DataFrame) -> None:
    for k, (_, part) in enumerate(table.groupby(["zeta", "mass"])):
        for name, _, marker, color, label in RATIOS:
            look = style.points(marker, color, "white" if k else None, label=None if k else label)
            shift = 1.06 ** (k - 0.5)
            axes.errorbar(part.time * shift, part[f"{name}_ratio"], part[f"{name}_ratio_error"], **look)
    axes.axhline(1, **style.GUIDE)
    axes.set(xscale="log", xlabel="time $t$", ylabel="measured / predicted", ylim=(0.8, 1.25))
    style.label_within_decades(axes.xaxis)
    axes.legend(loc="upper left", ncols=2, columnspacing=1)


def last(table: pd.DataFrame, name: str, gas: Chain) -> str:
    """Ratio at the last time of a gas."""
    row = table[(table.zeta == gas.zeta) & (table.mass == gas.mass)].iloc[-1]
    return with_error(row[f"{name}_ratio"], row[f"{name}_ratio_error"])


def draw(results: Sequence[Result]) -> Drawn:
    found = records(results)
    table = tabulate(found)
    gas = found[0].gas  # the one whose peak settles first
    of_gas = [one for one in found if (one.gas.zeta, one.gas.mass) == (gas.zeta, gas.mass)]
    shown = of_gas[::-2][:4][::-1]
    figure, (sound, heat, ratios) = plt.subplots(1, 3, figsize=(2.1 * style.COLUMN, style.HEIGHT))
    y = np.linspace(-REACH, REACH, 400)
    sound.plot(y, f_kpz(y), color=style.BLACK, label=r"$f_{\mathrm{KPZ}}$")
    parts = draw_peaks(sound, shown, scaled_sound)
    sound.set(
        xlabel=r"$(r - ct)\,/\,(\lambda_s t)^{2/3}$",
        ylabel=r"$2(\lambda_s t)^{2/3}\,C_g\,/\,\rho T$",
        ylim=(None, 0.72),
    )
    sound.legend(loc="upper left", handlelength=1.8)
    y = np.linspace(0, HEAT_REACH, 400)
    heat.plot(y, levy(y), color=style.BLACK, label="Lévy, 5/3")
    parts += draw_peaks(heat, shown, scaled_heat)
    heat.set(
        xlabel=r"$r\,/\,(D_h t)^{3/5}$", ylabel=r"$C_h\,(D_h t)^{3/5}\,/\,$predicted area", ylim=(None, 0.4)
    )
    heat.legend(loc="upper right", handlelength=1.8)
    draw_ratios(ratios, table)
    style.letter(sound, heat, ratios)
    other = found[-1].gas
    caption = f"""
        Peaks in rings in equilibrium, {parameters(results, "cell-length")},
        T = {listed(sorted({number(one.parameters["temperature"]) for one in results}))}, {replicas(results)}; lines: mode coupling without a
        fitted parameter (docs: mode coupling). (a) Sound: covariance C_g of the momenta of two cells at ζ = {number(gas.zeta)}, M = {number(gas.mass)}.
        (b) Heat: covariance C_h of E_s − E_p/2ζ, energies of scatterer and particles, where particles slower than
        λ/t count as frozen. (c) Height, width at half height, area, and speed (centre of mass over t) of the sound peak over theory; filled
        as in (a), open: ζ = {number(other.zeta)}, M = {number(other.mass)}. At the end: height {last(table, "peak", gas)} and
        {last(table, "peak", other)}, area {last(table, "peak_area", gas)} and {last(table, "peak_area", other)}, heat
        {last(table, "heat_area", gas)} and {last(table, "heat_area", other)} of the area. Errors: standard errors over replicas."""
    return figure, pd.concat([*parts, table]), caption


if __name__ == "__main__":
    ratios = {f"{name}_ratio": "1" for name in (*(one[0] for one in RATIOS), "heat_area")}
    run(draw, "Sound and heat peaks in equilibrium", zeta="1", mass="1", x="1", y="1", **ratios)
