"""Momentum distributions of open chains against the Boltzmann equation."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from workflow.lib.load import FormatError, Quantity, Result
from workflow.physics import run_parameters

SIMULATION, MEAN_FIELD = "simulation", "mean field"
FAINT = 1e-4  # fraction of the largest flux below which momenta are not shown


def reach(flux: Quantity) -> float:
    """Largest |p| in panels of the flux F(p): the end of the bins with more than FAINT of its maximum."""
    momentum = flux.axes["momentum"]
    bright = np.abs(momentum[(flux.mean > FAINT * flux.mean.max()).any(axis=0)])
    return float(bright.max() + (momentum[1] - momentum[0]) / 2)


def at(quantity: Quantity, x: float) -> np.ndarray:
    """Values of a solution of the Boltzmann equation at the grid point nearest to x."""
    return quantity.mean[np.abs(quantity.axes["x"] - x).argmin()]


def outgoing(values: np.ndarray, momentum: np.ndarray) -> np.ndarray:
    """Values by momentum for the outgoing particles: from the first position if p < 0, from the last one
    if p > 0."""
    return np.where(momentum < 0, values[0], values[-1])


def at_zero(inner: ArrayLike) -> float:
    """Value at p = 0 of the line through two bins of one half, the inner one first, as `momentum_flux`
    extrapolates its jump."""
    near, far = np.asarray(inner, dtype=float)
    return float(1.5 * near - 0.5 * far)


def in_bins(values: np.ndarray, count: int) -> np.ndarray:
    """Means over neighbouring bins, which leave `count` of them. Raises FormatError if these do not have a
    whole number of bins each."""
    if len(values) % count:
        raise FormatError(
            f"{len(values)} bins of the Boltzmann equation are no multiple of the {count} of a chain"
        )
    return values.reshape(count, -1).mean(axis=1)


def deviations(results: Sequence[Result]) -> pd.DataFrame:
    """One row per kind, N and bin: deviation from the continuum, normalised as in the paper, where F of a
    chain without correlations integrates to 1. The mean field has the bins of the continuum, which may be
    narrower than those of the simulations."""
    (continuum,) = (result for result in results if result.parameters["cells"] == "continuum")
    flux = continuum["flux"]
    exact = outgoing(flux.mean, flux.axes["momentum"])
    rates = run_parameters.both_rates(continuum)
    tables = []
    for result in results:
        if result is continuum:
            continue
        chain_flux = result["flux"]
        momentum = chain_flux.axes["momentum"]
        simulated = chain_flux.standard_error is not None
        table = pd.DataFrame({"momentum": momentum})
        excess = outgoing(chain_flux.mean, momentum) - in_bins(exact, len(momentum))
        table["deviation"] = excess / rates
        table["error"] = outgoing(chain_flux.error, momentum) / rates if simulated else 0.0
        table.insert(0, "kind", SIMULATION if simulated else MEAN_FIELD)
        table.insert(1, "cells", int(result.parameters["cells"]))
        tables.append(table)
    return pd.concat(tables, ignore_index=True)


def amplitudes(table: pd.DataFrame) -> pd.DataFrame:
    """One row per N: largest deviation, which is that as p -> 0, and its error for independent bins.

    The deviation is projected on its mean-field shape in the shortest chain; the amplitude is the largest
    value of this part. Unlike the largest of noisy bins it has no bias, also from the width of the bins."""
    shortest = table[table.kind == MEAN_FIELD].cells.min()
    fine = table[(table.kind == MEAN_FIELD) & (table.cells == shortest)].deviation.to_numpy()
    largest = at_centre(table)[shortest]
    rows = []
    for cells, part in table[table.kind == SIMULATION].groupby("cells"):
        shape = in_bins(fine, len(part))
        scale = largest / (shape @ shape)
        error = scale * float(np.sqrt(np.sum((shape * part.error) ** 2)))
        rows.append({"cells": cells, "amplitude": scale * float(shape @ part.deviation), "error": error})
    return pd.DataFrame(rows)


def at_centre(table: pd.DataFrame) -> pd.Series:
    """Largest mean-field deviation by N: that as p -> 0, the larger one of both halves, each extrapolated by
    a line through its two innermost bins."""
    centres = {}
    for cells, part in table[table.kind == MEAN_FIELD].groupby("cells"):
        inner = [part[np.sign(part.momentum) == side].sort_values("momentum", key=abs) for side in (-1, 1)]
        centres[cells] = max(abs(at_zero(half.deviation.iloc[:2])) for half in inner)
    return pd.Series(centres, name="centre").rename_axis("cells")
