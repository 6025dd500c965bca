"""Ext. 3: sound and heat peaks of rings in equilibrium, against mode coupling without a fitted parameter.

C_g, the covariance of the momenta of two cells, has the sound peaks [mode_coupling.md, eq. M19]; that of E_s - theta E_p, the
energies of scatterer and particles with theta = 1/(2 zeta), has the heat peak [eq. M29]. A stable law of free order, width and
area is fitted to the heat peak inside the sound peaks. Values of neighbouring cells are correlated, so its errors follow from
the spread over runs that differ only in their seed.
"""

from collections.abc import Callable, Sequence
from functools import cache
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from scipy.interpolate import RectBivariateSpline
from scipy.optimize import least_squares

from workflow.figures.ext13 import LOOKS, chain
from workflow.lib import style
from workflow.lib.caption import ERRORS, listed, number, parameters, replicas
from workflow.lib.figure import Drawn, run
from workflow.lib.fit import with_error
from workflow.lib.load import Result
from workflow.lib.mode_coupling import Chain, f_kpz, levy

FIRST = 16  # first time that is used, in λ/√T: earlier peaks are as narrow as a cell
HALF_WIDTH = 0.880466  # of f_KPZ at half of its maximum
REACH = 3  # largest scaled distance that is plotted, of sound peaks
HEAT_REACH = 4  # largest scaled distance that is plotted, of heat peaks
FITTED = 8  # largest distance in the fit of a heat peak, in predicted widths
HEAT_ORDER, GAUSSIAN = 5 / 3, 2  # orders of the stable law in theory [eq. M29] and of diffusion
RATIOS_ALLOWED = (0.1, 10)  # bounds of width and area in the fit, over the predicted ones
ORDERS = (1, 3)  # bounds of the order in the fit
BIN = 0.2  # width in scaled distance of the bins over which profiles are averaged


class Record(NamedTuple):
    """Correlation profiles at one time, from runs that differ only in their seed."""

    results: Sequence[Result]
    position: int  # index of the time
    time: float
    gas: Chain  # with infinitely many slow particles
    mobile: Chain  # with the slow particles that move within the time

    def value(self, name: str) -> tuple[float, float]:
        """Mean of a quantity over the runs, and its error."""
        quantities = [result[name] for result in self.results]
        mean, error = mean_over_runs(
            np.array([quantity.mean[self.position] for quantity in quantities]),
            np.array([quantity.error[self.position] for quantity in quantities]),
        )
        return float(mean), float(error)

    def profile(self, name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Distances from the centre as lengths; mean of both sides over the runs; its error."""
        profiles = self.profiles(name)
        errors = np.stack([result[name].error[self.position] for result in self.results])
        mean, error = mean_over_runs(profiles, errors[:, errors.shape[1] // 2 :])
        return np.arange(len(mean)) * self.gas.cell_length, mean, error

    def profiles(self, name: str) -> np.ndarray:
        """Mean of both sides [run, distance in cells]."""
        means = np.stack([result[name].mean[self.position] for result in self.results])
        middle = means.shape[1] // 2
        return 0.5 * (means[:, middle:] + means[:, middle::-1][:, : means.shape[1] - middle])

    @property
    def mean_error(self) -> float:
        return float(np.mean(self.profile("momentum_correlation")[2]))


def mean_over_runs(values: np.ndarray, errors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean over the first dimension, and its error. All runs have equal numbers of replicas."""
    return values.mean(axis=0), np.sqrt(np.sum(errors**2, axis=0)) / len(values)


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


def heat_width(record: Record) -> float:
    """Predicted width of the heat peak, (D_h t)^(3/5) [eq. M29]."""
    return float((record.mobile.heat_spreading * record.time) ** (3 / 5))


def heat_area(record: Record) -> float:
    """Predicted sum of the heat covariance over all cells: T^4/(4 λ χ_q)."""
    return record.gas.temperature**4 / (4 * record.gas.cell_length * record.mobile.heat_susceptibility)


@cache
def stable_densities() -> RectBivariateSpline:
    """Interpolates levy(x, order), which fits need thousands of times."""
    x, order = np.arange(0, 40, 0.1), np.arange(0.9, 3.15, 0.1)
    return RectBivariateSpline(x, order, np.stack([levy(x, exponent) for exponent in order], axis=1))


def stable_law(record: Record, profile: np.ndarray, order: float | None = None) -> np.ndarray:
    """Width and area, over the predicted ones, and order of the stable law that best fits a heat peak inside the sound peaks. order:
    fixed order; free if None."""
    within = min(0.5 * record.gas.sound_speed * record.time, FITTED * heat_width(record))
    inside = profile[: int(within / record.gas.cell_length)]
    x = np.arange(len(inside)) * record.gas.cell_length / heat_width(record)
    y = inside * heat_width(record) / (heat_area(record) * record.gas.cell_length)
    weight = np.where(x == 0, np.sqrt(0.5), 1)  # other values are means of two sides

    def residuals(law: np.ndarray) -> np.ndarray:
        width, area, exponent = law
        return weight * (area / width * stable_densities().ev(x / width, exponent) - y)

    exact = {"ftol": 1e-12, "xtol": 1e-12, "gtol": 1e-12}
    if order is not None:
        fit = least_squares(
            lambda law: residuals(np.append(law, order)), [1, 1], bounds=RATIOS_ALLOWED, **exact
        )
        return np.append(fit.x, order)
    bounds = [*zip(RATIOS_ALLOWED, RATIOS_ALLOWED, ORDERS, strict=True)]
    return least_squares(residuals, [1, 1, HEAT_ORDER], bounds=bounds, **exact).x


def diffusive(record: Record, y: np.ndarray) -> np.ndarray:
    """Gaussian of free width and area that fits the heat peak best, at scaled distances y."""
    profile = record.profiles("heat_correlation").mean(axis=0)
    width, area, order = stable_law(record, profile, order=GAUSSIAN)
    return area / width * levy(y / width, order)


def stable_laws(record: Record) -> tuple[np.ndarray, np.ndarray]:
    """Stable laws (width, area, order) of the mean over all runs, and of the means that leave out one run [run, parameter]."""
    profiles = record.profiles("heat_correlation")
    without_one = [
        stable_law(record, np.delete(profiles, k, axis=0).mean(axis=0)) for k in range(len(profiles))
    ]
    return stable_law(record, profiles.mean(axis=0)), np.array(without_one)


def jackknife_error(without_one: np.ndarray) -> np.ndarray:
    """Jackknife error from the values without one run each. It includes the correlation of neighbouring cells."""
    return np.sqrt(len(without_one) - 1) * np.std(without_one, axis=0)


def fitted(record: Record) -> dict[str, float]:
    """Columns of the stable law with its errors; empty for one run, which has no jackknife error."""
    if len(record.results) < 2:
        return {}
    law, without_one = stable_laws(record)
    errors = jackknife_error(without_one)
    names = ("stable_width_ratio", "stable_area_ratio", "stable_order")
    return {
        key: float(f"{value:.4g}")  # further digits depend on the rounding of the profile
        for name, *pair in zip(names, law, errors, strict=True)
        for key, value in zip((name, f"{name}_error"), pair, strict=True)
    }


def draw_sound(axes: Axes, shown: Sequence[Record]) -> list[pd.DataFrame]:
    y = np.linspace(-REACH, REACH, 400)
    axes.plot(y, f_kpz(y), color=style.BLACK, label=r"$f_{\mathrm{KPZ}}$")
    parts = []
    for record, color, dashes in zip(shown, style.SEQUENCE[1:], style.DASHES[1:], strict=False):
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
    for record, (marker, color) in zip(shown, LOOKS, strict=False):
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
    axes.legend(loc="upper right", handlelength=1.8)
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


def draw_heights(axes: Axes, table: pd.DataFrame) -> None:
    """Plots the heights of the sound peaks of all gases over the theory."""
    for (marker, color), ((zeta, mass), part) in zip(LOOKS, table.groupby(["zeta", "mass"]), strict=False):
        look = style.points(marker, color, label=f"$\\zeta = {zeta:g}$, $M = {number(mass)}$")
        axes.errorbar(part.time, part.peak_ratio, part.peak_ratio_error, **look)
    axes.axhline(1, **style.GUIDE)
    axes.set(xscale="log", xlabel="time $t$", ylabel="height of the sound peak / theory", ylim=(0.8, 1.1))
    axes.legend(loc="upper left")


def of(table: pd.DataFrame, gas: Chain) -> pd.DataFrame:
    """The rows of a gas."""
    return table[(table.zeta == gas.zeta) & (table.mass == gas.mass)]


def at_end(table: pd.DataFrame, name: str) -> str:
    """Ratio at the last time of every gas, in the order of zeta."""
    last = table.groupby(["zeta", "mass"]).tail(1)
    return listed(map(with_error, last[f"{name}_ratio"], last[f"{name}_ratio_error"]))


def draw(results: Sequence[Result]) -> Drawn:
    all_records = records(results)
    table = tabulate(all_records)
    first = chain(results[0])
    sound = [
        record for record in all_records if (record.gas.zeta, record.gas.mass) == (first.zeta, first.mass)
    ]
    heat = [record for record in all_records if len(record.results) > 1][-3:]
    figure, panels = plt.subplots(1, 3, figsize=(2.1 * style.COLUMN, style.HEIGHT))
    parts = draw_sound(panels[0], sound[::-2][:4][::-1]) + draw_heat(panels[1], heat)
    draw_heights(panels[2], table)
    style.letter(*panels)
    law = of(table, heat[-1].gas).dropna(subset="stable_order").iloc[-3:]
    orders, widths, areas = (
        listed(map(with_error, law[name], law[f"{name}_error"]))
        for name in ("stable_order", "stable_width_ratio", "stable_area_ratio")
    )
    caption = f"""
        Peaks in rings in equilibrium, {parameters(results, "cell-length")}, T = {number(first.temperature)}, {replicas(results)}; black: mode coupling, nothing
        fitted. (a) Covariance C_g of the momenta of two cells, ζ = {number(first.zeta)}, M = {number(first.mass)}. (b) Covariance C_h of
        E_s − E_p/2ζ, energies of scatterer and particles, ζ = {number(heat[-1].gas.zeta)}, M = {number(heat[-1].gas.mass)}. Stable laws fitted inside the
        sound peaks have the order {orders} (theory {number(HEAT_ORDER)}, diffusion {number(GAUSSIAN)}), {widths} of the width and {areas} of the area predicted; errors from
        {len(heat[-1].results)} runs. (c) Height of the sound peaks; at the last times their areas are {at_end(table, "peak_area")} of the theory. {ERRORS}"""
    return figure, pd.concat([*parts, table]), caption


if __name__ == "__main__":
    names = (*(name for name, _ in RATIOS), "heat_area", "stable_width", "stable_area")
    ratios = {f"{name}_ratio": "1" for name in names} | {"stable_order": "1"}
    run(draw, "Sound and heat peaks in equilibrium", zeta="1", mass="1", x="1", y="1", **ratios)
