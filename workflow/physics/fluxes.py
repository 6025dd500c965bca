"""Momentum distributions of open chains against the kinetic equation."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from workflow.lib.load import Quantity, Result
from workflow.physics import run_parameters

SIMULATION, MEAN_FIELD = "simulation", "mean field"
FAINT = 1e-4  # fraction of the largest flux below which momenta are not shown


def reach(flux: Quantity) -> float:
    """Largest |p| in panels of the flux F(p): the end of the bins in which it exceeds FAINT of its maximum."""
    momentum = flux.axes["momentum"]
    bright = np.abs(momentum[(flux.mean > FAINT * flux.mean.max()).any(axis=0)])
    return float(bright.max() + (momentum[1] - momentum[0]) / 2)


def at(quantity: Quantity, x: float) -> np.ndarray:
    """Values of a solution of the kinetic equation at the grid point nearest to x."""
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


def deviations(results: Sequence[Result]) -> pd.DataFrame:
    """One row per kind, N and bin: deviation from the continuum, in units of the largest F."""
    (continuum,) = (result for result in results if result.parameters["cells"] == "continuum")
    flux = continuum["flux"]
    momentum = flux.axes["momentum"]
    exact = outgoing(flux.mean, momentum)
    largest = flux.mean.max()
    tables = []
    for result in results:
        if result is continuum:
            continue
        chain_flux = result["flux"]
        simulated = chain_flux.standard_error is not None
        table = pd.DataFrame({"momentum": momentum})
        table["deviation"] = (outgoing(chain_flux.mean, momentum) - exact) / largest
        table["error"] = outgoing(chain_flux.error, momentum) / largest if simulated else 0.0
        table.insert(0, "kind", SIMULATION if simulated else MEAN_FIELD)
        table.insert(1, "cells", int(result.parameters["cells"]))
        tables.append(table)
    # In the normalisation that the paper prints, F of a chain without correlations integrates to 1.
    table = pd.concat(tables, ignore_index=True)
    return table.assign(absolute_as_printed=table.deviation * largest / run_parameters.both_rates(continuum))
