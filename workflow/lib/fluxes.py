"""Momentum distributions of open chains against the kinetic equation."""

from collections.abc import Sequence
from itertools import product

import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.load import Quantity, Result

# Bonds behind the first and behind the last scatterer: index, colour, line style and marker.
ENDS = {"x = 1/N": (1, style.BLUE, "solid", "o"), "x = 1": (-1, style.VERMILLION, (0, (4, 1.5)), "s")}
SIMULATION, MEAN_FIELD = "simulation", "mean field"


def measured(results: Sequence[Result]) -> list[Result]:
    """The simulations between baths of different temperatures; others are in equilibrium."""
    simulated = [result for result in results if result.provenance["program"] == "momentum_flux"]
    return [result for result in simulated if len(set(result.ends("temperature"))) > 1]


def uncorrelated(results: Sequence[Result], like: Result) -> Result | None:
    """The solution of the kinetic equation for the chain of `like`; None if there is none."""
    for result in results:
        same = style.gamma(result) == style.gamma(like) and result.ends("nu") == like.ends("nu")
        same &= result.parameters["rule"] == like.parameters["rule"]
        if same and result.provenance["program"] == "boltzmann":
            return result
    return None


def at(quantity: Quantity, x: float) -> np.ndarray:
    """Values of a solution of the kinetic equation at the grid point nearest to x."""
    return quantity.mean[np.abs(quantity.axes["x"] - x).argmin()]


def at_ends(results: Sequence[Result]) -> pd.DataFrame:
    """One row per chain, end and bin."""
    parts = []
    for result, (end, (bond, *_)) in product(measured(results), ENDS.items()):
        flux, jump, expected = result["flux"], result["jump"], uncorrelated(results, result)
        part = pd.DataFrame({"x": end, "momentum": flux.axes["momentum"], "flux": flux.mean[bond]})
        part["flux_error"] = flux.error[bond]
        part["jump"], part["jump_error"] = jump.mean[bond], jump.error[bond]
        if expected:
            where = flux.axes["bond"][bond] / flux.axes["bond"][-1]
            part["kinetic"], part["kinetic_jump"] = at(expected["flux"], where), at(expected["jump"], where)
        part["nu_left"], part["nu_right"] = result.ends("nu")
        part.insert(0, "gamma", style.gamma(result))
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def halves(part: pd.DataFrame) -> list[pd.DataFrame]:
    """The rows with p < 0 and those with p > 0, which are plotted as separate curves as F jumps at p = 0."""
    return [part[part.momentum < 0], part[part.momentum > 0]]


def outgoing(values: np.ndarray, momentum: np.ndarray) -> np.ndarray:
    """Values by momentum for the outgoing particles: from the first position if p < 0, from the last one if p > 0."""
    return np.where(momentum < 0, values[0], values[-1])


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
    return table.assign(absolute_as_printed=table.deviation * largest / style.both_rates(continuum))


def amplitudes(table: pd.DataFrame, kind: str = SIMULATION) -> pd.DataFrame:
    """One row per N: amplitude of the deviation, and its error for independent bins.

    The deviation is projected on its mean-field shape in the shortest chain; the amplitude is the largest value of this part. Unlike the
    largest of noisy bins it has no bias."""
    mean_field = table[table.kind == MEAN_FIELD]
    shape = mean_field[mean_field.cells == mean_field.cells.min()].deviation.to_numpy()
    scale = np.abs(shape).max() / (shape @ shape)
    rows = [
        {
            "cells": cells,
            "amplitude": scale * float(shape @ part.deviation),
            "error": scale * float(np.sqrt(np.sum((shape * part.error) ** 2))),
        }
        for cells, part in table[table.kind == kind].groupby("cells")
    ]
    return pd.DataFrame(rows)
