"""Errors of the kinetic solver: what its figures, against points and against time, share."""

import pandas as pd
from matplotlib.axes import Axes

from workflow.lib import style

CURRENTS = ("particle_current", "energy_current", "momentum_flux")


def distance_from_finest(table: pd.DataFrame) -> pd.Series:
    """Largest relative difference of the three currents from those of the last row of the same gamma."""
    finest = table.groupby("gamma")[list(CURRENTS)].transform("last")
    return (table[list(CURRENTS)] / finest - 1).abs().max(axis=1)


def draw_errors(axes: Axes, table: pd.DataFrame, abscissa: str) -> None:
    """The program's own estimate as lines, the distance from the finest as points."""
    looks = [("o", style.BLUE, "solid"), ("s", style.VERMILLION, "dashed")]
    for (gamma, part), (marker, color, dashes) in zip(table.groupby("gamma"), looks, strict=True):
        label = rf"$\gamma = {gamma:g}$"
        axes.plot(part[abscissa], part.estimate, color=color, linestyle=dashes, label=f"{label}, estimate")
        seen = part[part.distance > 0]
        axes.plot(
            seen[abscissa], seen.distance, marker, color=color, label=f"{label}, distance from the finest"
        )
    axes.set(xscale="log", yscale="log", ylabel="relative error of the currents")
