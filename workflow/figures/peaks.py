"""Sound and heat peaks of rings in equilibrium, against mode coupling without a fitted parameter, and the growth of the heat that passes.

C_g, the covariance of the momenta of two cells, has the sound peaks [mode_coupling.md, eq. M19]; that of E_s - theta E_p, the
energies of scatterer and particles with theta = 1/(2 zeta), has the heat peak [eq. M29]. A stable law is fitted to it
(workflow/physics/peaks.py). Q is the heat current, summed over the cells of a ring and integrated over t [eqs. M21 and M28].
"""

from collections.abc import Callable, Sequence

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style
from workflow.lib.caption import ERRORS, format_number
from workflow.lib.figure import Parts, main, plots
from workflow.lib.fit import format_with_error
from workflow.lib.load import Result
from workflow.physics.mode_coupling import f_kpz, levy
from workflow.physics.peaks import (
    CENTRE,
    GAUSSIAN,
    HEAT_ORDER,
    Record,
    determined,
    heat_area,
    heat_width,
    jackknife_error,
    stable_law,
    stable_laws,
)
from workflow.physics.rings import chain, look_of
from workflow.physics.rings import tabulate as tabulate_heat

FIRST = 16  # first time that is used, in λ/√T: earlier peaks are as narrow as a cell
HALF_WIDTH = 0.880466  # of f_KPZ at half of its maximum
UNSURE = 0.1  # error of the height of a sound peak, over the theory, and of an exponent, from which on it is not shown
SETTLED = 64  # first time, in λ/√T, of the heights that the caption compares with the theory
REACH = 3  # largest scaled distance that is plotted, of sound peaks
HEAT_REACH = 4  # largest scaled distance that is plotted, of heat peaks
FITTED = ("stable_width_ratio", "stable_area_ratio", "stable_order", "order_off_centre")  # columns
WIDE = 3  # cells; narrower heat peaks are not fitted
BESIDE = 1.06  # ratio of the times of the symbols of both fits, so that they do not overlap
HEAT_MARKERS = "os^"  # by time
BIN = 0.2  # width in scaled distance of the bins over which profiles are averaged


def records(results: Sequence[Result]) -> list[Record]:
    """One record per gas and time, from the rings in which the momentum profile has the smallest error."""
    rings: dict[tuple[float, float, int], list[Result]] = {}
    for result in results:
        gas = chain(result)
        rings.setdefault((gas.zeta, gas.mass, int(result.parameters["cells"])), []).append(result)
    best: dict[tuple[float, float, float], Record] = {}
    for (zeta, mass, _), runs in rings.items():
        for index, time in enumerate(runs[0]["peak"].axes["time"]):
            record = Record(runs, index, float(time), chain(runs[0]), chain(runs[0], time))
            if time * np.sqrt(record.gas.temperature) / record.gas.cell_length < FIRST:
                continue
            key = (zeta, mass, float(time))
            best[key] = min(best.get(key, record), record, key=lambda record: record.mean_error)
    return [best[key] for key in sorted(best)]


def binned(x: np.ndarray, y: np.ndarray, error: np.ndarray) -> pd.DataFrame:
    """Means over the cells of every bin. The errors of the cells are almost independent and are combined as such."""
    cells = pd.DataFrame({"x": x, "y": y, "y_error": error**2}).groupby(np.floor(x / BIN))
    means = cells.mean()
    return means.assign(y_error=np.sqrt(means.y_error / cells.size())).reset_index(drop=True)


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
    unit = heat_width(record)
    per_area = unit / (heat_area(record) * record.gas.cell_length)
    near = x < HEAT_REACH * unit
    return binned(x[near] / unit, per_area * y[near], per_area * error[near])


def diffusive(record: Record, y: np.ndarray) -> np.ndarray:
    """Gaussian of free width and area that fits the heat peak best, at scaled distances y."""
    profile = record.profiles("heat_correlation").mean(axis=0)
    width, area, order = stable_law(record, profile, order=GAUSSIAN)
    return area / width * levy(y / width, order)


def fitted(record: Record) -> dict[str, float]:
    """Columns of the stable law with its errors, and of its order without the central cells; NaN for one run, which has no jackknife
    error, where the peak is too narrow, and where the profiles determine no order."""
    undetermined = dict.fromkeys((f"{name}{suffix}" for name in FITTED for suffix in ("", "_error")), np.nan)
    if len(record.results) < 2 or heat_width(record) < WIDE * record.gas.cell_length:
        return undetermined
    whole, off_centre = stable_laws(record), stable_laws(record, CENTRE)
    if not (determined(*whole) and determined(*off_centre)):
        return undetermined
    values = [*whole[0], off_centre[0][-1]]
    errors = [*jackknife_error(whole[1]), jackknife_error(off_centre[1])[-1]]
    return {
        key: float(f"{value:.4g}")  # further digits depend on the rounding of the profile
        for name, *pair in zip(FITTED, values, errors, strict=True)
        for key, value in zip((name, f"{name}_error"), pair, strict=True)
    }


def draw_sound(axes: Axes, shown: Sequence[Record]) -> list[pd.DataFrame]:
    y = np.linspace(-REACH, REACH, 400)
    axes.plot(y, f_kpz(y), color=style.BLACK, label=r"$f_{\mathrm{KPZ}}$")
    parts = []
    for record, dashes in zip(shown, style.DASHES[1:], strict=False):
        _, color = look_of(record.gas.zeta, record.gas.mass)
        part = scaled_sound(record)
        axes.plot(part.x, part.y, color=color, linestyle=dashes, label=f"$t = {record.time:g}$")
        style.band(axes, part.x, part.y, part.y_error, color)
        parts.append(labelled(part, record))
    axes.set(
        xlabel=r"$(r - ct)\,/\,(\lambda_s t)^{2/3}$",
        ylabel=r"$2(\lambda_s t)^{2/3}\,C_g\,/\,\rho T$",
        ylim=(None, 0.72),
    )
    axes.legend(loc="upper left", handlelength=1.8)
    return parts


def draw_heat(axes: Axes, shown: Sequence[Record]) -> list[pd.DataFrame]:
    """Plots the heat peaks on a logarithmic axis, which shows the tails, in which laws of different order differ."""
    y = np.linspace(0, HEAT_REACH, 400)
    axes.plot(y, levy(y), color=style.BLACK, label="order 5/3, theory")
    axes.plot(y, diffusive(shown[-1], y), color="0.4", linestyle=style.DASHES[3], label="order 2, fitted")
    parts = []
    for record, marker in zip(shown, HEAT_MARKERS, strict=False):
        _, color = look_of(record.gas.zeta, record.gas.mass)
        part = scaled_heat(record)
        axes.errorbar(
            part.x, part.y, part.y_error, **style.points(marker, color), label=f"$t = {record.time:g}$"
        )
        parts.append(labelled(part, record))
    axes.set(
        xlabel=r"$r\,/\,(D_h t)^{3/5}$",
        ylabel=r"$C_h\,(D_h t)^{3/5}\,/\,$predicted area",
        yscale="log",
        ylim=(2e-3, 1),
    )
    axes.legend(loc="lower left", handlelength=1.8)
    return parts


def labelled(part: pd.DataFrame, record: Record) -> pd.DataFrame:
    return part.assign(zeta=record.gas.zeta, mass=record.gas.mass, time=record.time)


# Quantities of the sound peak that are compared with the theory: name and prediction.
RATIOS: list[tuple[str, Callable[[Record], float]]] = [
    ("peak", lambda record: float(record.gas.sound_peak(record.gas.sound_speed * record.time, record.time)) * record.gas.cell_length**2),
    ("peak_width", lambda record: 2 * HALF_WIDTH * (record.gas.self_coupling * record.time) ** (2 / 3) / record.gas.cell_length),
    ("peak_area", lambda record: record.gas.peak_area * record.gas.cell_length),
    ("centroid", lambda record: record.mobile.sound_speed_in_cells * record.time),
]  # fmt: skip


def tabulate(all_records: Sequence[Record]) -> pd.DataFrame:
    """One row per gas and time: ratios of measured to predicted values."""
    rows = []
    for record in all_records:
        row = {"zeta": record.gas.zeta, "mass": record.gas.mass, "time": record.time}
        expected = {name: predicted(record) for name, predicted in RATIOS}
        for name, predicted in (expected | {"heat_area": heat_area(record)}).items():
            value, error = record.value(name)
            row |= {f"{name}_ratio": value / predicted, f"{name}_ratio_error": error / predicted}
        rows.append(row | fitted(record))
    return pd.DataFrame(rows)


def label_of(zeta: float, mass: float) -> str:
    return rf"$\zeta = {format_number(zeta)}$, $M = {format_number(mass)}$"


def draw_heights(axes: Axes, sure: pd.DataFrame) -> None:
    """Plots the heights of the sound peaks of all gases over the theory."""
    for gas, part in sure.groupby(["zeta", "mass"]):
        look = style.points(*look_of(*gas), label=label_of(*gas))
        axes.errorbar(part.time, part.peak_ratio, part.peak_ratio_error, **look)
    axes.axhline(1, **style.GUIDE)
    axes.set(xscale="log", xlabel="time $t$", ylabel="height of the sound peak / theory", ylim=(0.8, 1.1))
    style.label_within_decades(axes.xaxis)


def draw_octaves(axes: Axes, table: pd.DataFrame) -> None:
    for gas, part in table.groupby(["zeta", "mass"]):
        look = style.points(*look_of(*gas), label=label_of(*gas))
        axes.errorbar(part.middle, part.local_exponent, part.local_exponent_error, **look)
    for value, text in ((1, "1"), (4 / 3, "4/3")):
        style.guide_at(axes, value, text)
    axes.set(xscale="log", xlabel="time $t$", ylabel=r"$d\ln\langle Q^2 \rangle/d\ln t$", ylim=(0.9, 1.8))


def draw_orders(axes: Axes, law: pd.DataFrame, color: str) -> None:
    """Plots the order of the stable law fitted to the heat peak, with and without the central cells."""
    looks = {
        "stable_order": style.points("o", color, label="whole peak"),
        "order_off_centre": style.points("s", color, "white", label="without its centre"),
    }
    for shift, (name, look) in zip((1, BESIDE), looks.items(), strict=True):
        axes.errorbar(shift * law.time, law[name], law[f"{name}_error"], **look)
    for value, text in ((GAUSSIAN, "2"), (HEAT_ORDER, "5/3")):
        style.guide_at(axes, value, text)
    axes.set(xscale="log", xlabel="time $t$", ylabel="order of the heat peak", ylim=(1.35, 2.35))
    style.label_within_decades(axes.xaxis)
    axes.legend(loc="upper right")


def off(ratios: pd.Series) -> str:
    """The smallest and the largest deviation from 1, in percent, with its sign in words."""
    percent = 100 * (ratios - 1).abs()
    return f"{percent.min():.0f} to {percent.max():.0f} % {'below' if (ratios < 1).all() else 'off'}"


def extremes(exponents: pd.DataFrame) -> str:
    """The smallest and the largest of exponents."""
    ascending = exponents.sort_values("local_exponent").iloc[[0, -1]]
    pairs = zip(ascending.local_exponent, ascending.local_exponent_error, strict=True)
    return " and ".join(format_with_error(*pair) for pair in pairs)


def caption(sure: pd.DataFrame, law: pd.DataFrame, growth: pd.DataFrame, sound: Record) -> str:
    pairs = zip(law.stable_order, law.stable_order_error, strict=True)
    orders = [format_with_error(*pair) for pair in pairs]
    ends = f"{orders[0]}, finally {orders[-1]}" if orders else "unknown"
    return f"""
        Equilibrium rings are compared with mode coupling (black), without fitted parameters. (a) Sound peaks have ζ = {format_number(sound.gas.zeta)}, M =
        {format_number(sound.gas.mass)}. (b) From t = {SETTLED} on, their heights are {off(sure[sure.time >= SETTLED].peak_ratio)} theory. (c), (d) Heat peaks are fitted
        by stable laws of order {ends}. (e) The heat Q that passes has exponents of ⟨Q²⟩ that end between {extremes(growth.groupby(["zeta", "mass"]).tail(1))}. {ERRORS}"""


SERIES = "light light-long dense dense-long heat "  # of this panel, and of the elastic rings of `momentum`
HEATS = "light-longest dense-longest dilute dilute-long dilute-longest sparse-longest"


@plots(SERIES + HEATS)
def draw(results: Sequence[Result]) -> Parts:
    peaks = [result for result in results if result.provenance["program"] == "correlation"]
    all_records = records(peaks)
    table = tabulate(all_records)
    sure = table[table.peak_ratio_error < UNSURE]
    first = chain(peaks[0])
    sound = [
        record for record in all_records if (record.gas.zeta, record.gas.mass) == (first.zeta, first.mass)
    ]
    repeated = [record for record in all_records if len(record.results) > 1]
    law = table.dropna(subset="stable_order")
    heat = [record for record in repeated if record.time in [*law.time]][-3:] or repeated[-3:]
    growth = tabulate_heat([result for result in results if result.provenance["program"] == "heat_current"])
    columns = ["zeta", "mass", "middle", "local_exponent", "local_exponent_error"]
    growth = growth.loc[growth.middle.notna() & ~(growth.local_exponent_error > UNSURE), columns]
    figure, panels = plt.subplot_mosaic(
        [["sound", "heat", "octaves"], ["heights", "orders", "octaves"]],
        figsize=(2.5 * style.COLUMN, 1.7 * style.HEIGHT),
    )
    parts = draw_sound(panels["sound"], sound[::-2][:4][::-1]) + draw_heat(panels["heat"], heat)
    draw_heights(panels["heights"], sure)
    _, color = look_of(heat[-1].gas.zeta, heat[-1].gas.mass)
    draw_orders(panels["orders"], law, color)
    draw_octaves(panels["octaves"], growth)
    gases = dict(
        pair
        for name in ("octaves", "heights")
        for pair in zip(*panels[name].get_legend_handles_labels()[::-1], strict=True)
    )
    figure.legend(gases.values(), gases.keys(), loc="outside upper center", ncols=len(gases))
    style.letter(*(panels[name] for name in ("sound", "heights", "heat", "orders", "octaves")))
    return figure, pd.concat([*parts, table, growth]), caption(sure, law, growth, sound[-1])


if __name__ == "__main__":
    names = (*(name for name, _ in RATIOS), "heat_area", "stable_width", "stable_area")
    ratios = {f"{name}_ratio": "1" for name in names} | {"stable_order": "1", "order_off_centre": "1"}
    main(draw, "Sound and heat peaks in equilibrium", zeta="1", mass="1", x="1", y="1", **ratios)
