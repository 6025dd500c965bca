"""Fig. 8: heat conductivity against the number of cells.

Beside it kappa over the power of N that the paper states, and local exponents d ln kappa / d ln N between neighbouring sizes,
which are constant where a power law holds. The mean field is the kinetic equation of N scatterers.
Points whose window is not stationary, or whose run stopped before its target, are crossed out and not used.
"""

from collections.abc import Sequence

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib import style
from workflow.lib.caption import BATHS, ERRORS, goodness, listed, number, parameters, replicas
from workflow.lib.figure import run
from workflow.lib.fit import PowerLaw, fit_power, with_error
from workflow.lib.growth import local_exponents
from workflow.lib.load import Result

# The paper's exponents by gamma, as powers of N and as numbers.
GUIDES = {"N": (1 / 3, r"$N^{1/3}$", "1/3"), 1: (1, "$N$", "1")}
BELOW = 0.7  # factor by which these lie below the lowest point
LOOKS = {
    "kappa": (None, "$T$ of scatterers"),
    "kappa_particle": ("white", "$T$ of particles"),
}  # faces and names


def measured(results: Sequence[Result]) -> list[Result]:
    return [result for result in results if result.provenance["program"] == "conductivity"]


def mean_field(results: Sequence[Result]) -> pd.DataFrame:
    """kappa in mean field, sorted by N."""
    rows = []
    for result in results:
        if result.provenance["program"] == "boltzmann":
            cells, temperature = int(result.parameters["cells"]), result["temperature_scatterer"].mean
            kappa = -float(result["energy_current"].mean) * cells / (temperature[-1] - temperature[0])
            rows.append({"gamma": "N", "cells": cells, "mean_field_kappa": kappa})
    return pd.DataFrame(rows).sort_values("cells")


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per run, sorted by gamma and N."""
    rows = []
    for result in measured(results):
        row = {"gamma": result.parameters["gamma"], "cells": result.parameters["cells"]}
        for name in ("kappa", "kappa_particle", "kappa_plain", "kappa_printed", "energy_current"):
            row[name], row[f"{name}_error"] = (
                float(value) for value in (result[name].mean, result[name].error)
            )
        row["usable"] = result.sound
        rows.append(row)
    return pd.DataFrame(rows).sort_values("cells")


def exponent(table: pd.DataFrame) -> PowerLaw:
    """Over the sound points of one gamma."""
    sound = table[table.usable]
    return fit_power(sound.cells, sound.kappa, sound.kappa_error)


def exponents(table: pd.DataFrame) -> pd.DataFrame:
    """From every sound size of one gamma to the next. Neighbours share a point."""
    sound = table[table.usable]
    middle, slope, error = local_exponents(sound.cells, sound.kappa, sound.kappa_error)
    local = sound[["gamma", "cells"]].iloc[:-1]
    return local.assign(between=middle, exponent_to_next=slope, exponent_to_next_error=error)


def draw_sizes(axes: Axes, table: pd.DataFrame, theory: pd.DataFrame) -> None:
    """kappa against N, with the paper's power laws below."""
    for gamma, (marker, color) in style.BY_GAMMA.items():
        part = table[table.gamma == gamma]
        look = {"marker": marker, "color": color, **style.POINTS}
        axes.errorbar(part.cells, part.kappa, part.kappa_error, label=rf"$\gamma = {gamma}$", **look)
        slope, name, _ = GUIDES[gamma]
        power = part.cells**slope
        guide = BELOW * (part.kappa / power).min() * power
        axes.plot(part.cells, guide, **style.GUIDE)
        end = (part.cells.iloc[-1], guide.iloc[-1])
        axes.annotate(name, end, (-4, -6), textcoords="offset points", size=8, ha="right", va="top")
        style.cross_out(axes, part.cells.to_numpy(), part.kappa.to_numpy(), ~part.usable.to_numpy())
    color = style.BY_GAMMA["N"][1]
    (line,) = axes.plot(theory.cells, theory.mean_field_kappa, color=color, linestyle="dashed")
    axes.set(xscale="log", yscale="log")
    axes.set_ylabel(rf"$\kappa = -J_U N/(T_N - T_1)$  ({style.UNITS})")
    points, names = axes.get_legend_handles_labels()
    axes.legend([*points, line], [*names, r"$\gamma = N$, mean field"], loc="upper left")


def draw_compensated(axes: Axes, table: pd.DataFrame, theory: pd.DataFrame, gamma: str | int) -> None:
    """kappa over the paper's power of N, by the temperatures of scatterers (full) and of particles (open)."""
    marker, color = style.BY_GAMMA[gamma]
    slope, guide, _ = GUIDES[gamma]
    part = table[table.gamma == gamma]
    power = part.cells**slope
    for column, (face, name) in LOOKS.items():
        look = {"marker": marker, "color": color, "markerfacecolor": face or color, **style.POINTS}
        axes.errorbar(part.cells, part[column] / power, part[f"{column}_error"] / power, label=name, **look)
    if gamma == "N":
        expected = theory.mean_field_kappa / theory.cells**slope
        axes.plot(theory.cells, expected, color=color, linestyle="dashed")
    axes.set(xscale="log", ylabel=rf"$\kappa\,/$ {guide}")
    axes.legend(loc="upper right" if gamma == 1 else "upper left", handletextpad=0.2)


def draw_local(axes: Axes, table: pd.DataFrame) -> None:
    for gamma, (marker, color) in style.BY_GAMMA.items():
        local = exponents(table[table.gamma == gamma])
        look = {"marker": marker, "color": color, **style.POINTS}
        axes.errorbar(local.between, local.exponent_to_next, local.exponent_to_next_error, **look)
        slope, _, name = GUIDES[gamma]
        style.guide_at(axes, slope, name)
    axes.set(ylabel=r"$d\ln\kappa/d\ln N$")


def windows(runs: Sequence[Result], option: str) -> list[str]:
    """t = 0.05N at gamma = N, for every gamma, or for all together."""
    by_gamma: dict[str, dict[str, None]] = {}
    for one in runs:
        time = one.parameters[option]
        by_gamma.setdefault(style.gamma(one), {})[time if isinstance(time, str) else number(time)] = None
    told = {gamma: f"t = {listed(times)}" for gamma, times in by_gamma.items()}
    return (
        [*told.values()][:1]
        if len({*told.values()}) == 1
        else [f"{time} at γ = {gamma}" for gamma, time in told.items()]
    )


def found(table: pd.DataFrame, gamma: str | int) -> str:
    """What the points of one gamma say of a power law."""
    part = table[table.gamma == gamma]
    law, local = exponent(part), exponents(part)
    first, most, last = (
        with_error(*local[["exponent_to_next", "exponent_to_next_error"]].iloc[k])
        for k in (0, int(local.exponent_to_next.argmax()), -1)
    )
    said = f"exponent {law.text}" if not law.rejected else "no single power of N"
    return f"γ = {gamma}: {said} ({goodness(law.chi_square, law.freedom)}); the local exponent is {first} at the smallest sizes, at most {most}, and {last} at the largest"


def caption(table: pd.DataFrame, theory: pd.DataFrame, results: Sequence[Result]) -> str:
    runs = measured(results)
    crossed = int((~table.usable).sum())
    return f"""
        Heat conductivity κ = −J_U N/(T_N − T_1) of an open chain against its number of cells N, for γ = N (circles) and
        γ = 1 (squares); {parameters(runs, "sigma", *BATHS)}, λ = {runs[0].parameters["cell-length"]}, relaxed for {listed(windows(runs, "relaxation-time"))} and observed for
        {listed(windows(runs, "observation-time"))}, {replicas(runs)} per point. (a) κ, dashed grey the paper's powers of N, drawn below, dashed blue the mean field, the kinetic equation of
        N scatterers, solved up to N = {theory.cells.max()}. (b), (c) κ over these powers, with the temperatures of the scatterers (full) and of the arriving particles
        (open). (d) Local exponents between neighbouring sizes, which share a point; dashed the paper's. {ERRORS}; crosses,
        {crossed or "none"} here, mark points that are not stationary. {found(table, 1)}. {found(table, "N")}. The paper reads
        N and the cube root of N from its points. A window is called stationary where no drift is seen, which noise can hide: at the largest
        sizes errors are up to {100 * (table.kappa_error / table.kappa).max():.0f} %, and ext. 9, at a stronger drive, is more precise. In mean field there is no growth at γ = N."""


def draw(results: Sequence[Result]) -> tuple[Figure, pd.DataFrame, str]:
    table, theory = tabulate(results), mean_field(results)
    figure, panels = plt.subplot_mosaic(
        [["main", "rare"], ["main", "deterministic"], ["main", "local"]],
        figsize=(2 * style.COLUMN, 1.3 * style.HEIGHT),
        width_ratios=[1.15, 1],
        sharex=True,
    )
    draw_sizes(panels["main"], table, theory)
    draw_compensated(panels["rare"], table, theory, 1)
    draw_compensated(panels["deterministic"], table, theory, "N")
    draw_local(panels["local"], table)
    for name in ("main", "local"):
        panels[name].set_xlabel("number of cells $N$")
    style.letter(*panels.values())
    figure.align_ylabels([panels[name] for name in ("rare", "deterministic", "local")])
    local = pd.concat([exponents(table[table.gamma == gamma]) for gamma in style.BY_GAMMA])
    for added in (theory, local.drop(columns="between")):
        table = table.merge(added, how="left", on=["gamma", "cells"])
    return figure, table, caption(table, theory, results)


if __name__ == "__main__":
    kappa = "energy/(time temperature)"
    local = {"exponent_to_next": "1", "exponent_to_next_error": "1"}
    run(draw, "Heat conductivity against the size of the chain", mean_field_kappa=kappa, **local)
