"""Linear response of the currents of energy and particles, and the heat conductivity without a particle current.

J_i = sum_k L_ik X_k / N with X_u = 1/T_R - 1/T_L and X_n = (mu/T)_L - (mu/T)_R, where mu/T = ln(nu/sqrt(T)) + const for
half-Gaussian baths [eq. 56]. Both differences together that make J_n = 0 give κ_0 = -J_u N/(T_N - T_1), with the temperatures of the
end scatterers as everywhere. Over the temperatures of the baths it is (L_uu - L_un L_nu/L_nn)/T^2, smaller by the resistance of the contacts.
Sound leaves the chain after the time t = τN/c, where c is the speed of sound in cells per time. κ_0 is that of a ring of the same gas
up to this time:
κ_0 = (√T/λ) ½ d(<Q²>/N)/dt, <Q²> measured in the units of T and λ [mode_coupling.md, eq. M34].
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pandas as pd

from workflow.lib.fit import mean_of
from workflow.lib.load import Result
from workflow.physics import setting
from workflow.physics.conductivity import gas
from workflow.physics.rings import chain

DENSE = "dense"  # name of the gas at a fixed spacing
DERIVED = (
    "L_uu",
    "L_un",
    "L_nu",
    "L_nn",
    "kappa_0",
    "kappa_0_baths",
    "asymmetry",
)  # numbers calculated from what is measured
STEP = 1e-6  # of numerical derivatives, relative to what is measured


class Mean(NamedTuple):
    value: float
    error: float
    chi_square: float
    freedom: int


@dataclass(frozen=True)
class Response:
    """Currents of a run, its difference of temperature, and the forces that drive them."""

    cells: int
    forces: np.ndarray  # X_u, X_n
    measured: np.ndarray  # J_u, J_n, T_N - T_1
    covariance: np.ndarray  # of the three
    temperature: float  # geometric mean of the temperatures of the baths
    usable: bool

    @classmethod
    def of(cls, result: Result) -> "Response":
        rates, temperatures = (np.array(result.ends(name)) for name in ("nu", "temperature"))
        potentials = np.log(rates / np.sqrt(temperatures))
        names = ("energy_current", "particle_current", "temperature_first", "temperature_last")
        means, errors = (
            np.array([float(getattr(result[name], part)) for name in names]) for part in ("mean", "error")
        )
        of_rise = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 1]])
        covariance = of_rise @ (np.outer(errors, errors) * result["correlation"].mean) @ of_rise.T
        return cls(
            int(result.parameters["cells"]),
            np.array([np.diff(1 / temperatures)[0], -np.diff(potentials)[0]]),
            of_rise @ means,
            covariance,
            float(np.sqrt(np.prod(temperatures))),
            result.usable,
        )


def onsager(temperature: Response, pressure: Response) -> dict[str, float]:
    """Matrix L and conductivities without a particle current from two runs. temperature: run with a temperature difference at equal
    pressure; pressure: run with a pressure difference at equal temperature. Errors are those of linear propagation."""
    runs, cells = (temperature, pressure), temperature.cells
    inverse = np.linalg.inv(np.stack([run.forces for run in runs], axis=1)) * cells
    difference_of_baths = -temperature.forces[0] * temperature.temperature**2

    def derived(measured: np.ndarray) -> np.ndarray:
        matrix = measured[:2] @ inverse
        heat, _, rise = measured @ [1, -measured[1, 0] / measured[1, 1]]  # both runs added such that J_n = 0
        conductivities = [-cells * heat / rise, -cells * heat / difference_of_baths]
        return np.array([*matrix.flat, *conductivities, matrix[0, 1] - matrix[1, 0]])

    measured = np.stack([run.measured for run in runs], axis=1)
    values, variances = derived(measured), np.zeros(len(DERIVED))
    for index, run in enumerate(runs):
        gradient = np.zeros((len(measured), len(DERIVED)))
        for row, step in enumerate(STEP * np.abs(measured).max(axis=1)):
            shift = np.zeros_like(measured)
            shift[row, index] = step
            gradient[row] = (derived(measured + shift) - derived(measured - shift)) / (2 * step)
        variances += np.einsum("iq,ij,jq->q", gradient, run.covariance, gradient)
    table: dict[str, float] = {"usable": all(run.usable for run in runs)}
    for name, value, variance in zip(DERIVED, values, variances, strict=True):
        table |= {name: float(value), f"{name}_error": float(np.sqrt(variance))}
    return table


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per gas and size with both differences."""
    runs: dict[tuple[str, int], dict[bool, Response]] = {}
    for result in results:
        response = Response.of(result)
        runs.setdefault((gas(result), response.cells), {})[bool(response.forces[0])] = response
    rows = [
        {"gas": name, "cells": cells} | onsager(pair[True], pair[False])
        for (name, cells), pair in runs.items()
        if len(pair) == 2
    ]
    return pd.DataFrame(rows).sort_values("cells", ignore_index=True)


@dataclass(frozen=True)
class Ring:
    """½ d(<Q²>/N)/dt of a gas in equilibrium, with T and λ as units, as a power law between the given times."""

    sound_speed: float
    time: np.ndarray
    growth: np.ndarray
    relative_error: np.ndarray

    @classmethod
    def of(cls, results: Sequence[Result]) -> "Ring":
        """Combines rings of one gas. Each time is taken from the ring with the smallest error."""
        rows: list[tuple[float, ...]] = []
        rate = np.sqrt(results[0].parameters["temperature"]) / results[0].parameters["cell-length"]
        unit = results[0].parameters["temperature"] * results[0].parameters["cell-length"]
        for result in results:
            heat, exponent = result["heat_variance"], result["local_exponent"]
            given = (("time", rate * heat.axes["time"]), ("heat", heat.mean / unit**2))
            at = {name: np.log(values) for name, values in given}
            middle = rate * exponent.axes["middle"]
            value = np.exp(np.interp(np.log(middle), at["time"], at["heat"]))
            relative = np.hypot((heat.error / heat.mean)[1:], exponent.error / exponent.mean)
            rows += zip(middle, 0.5 * value * exponent.mean / middle, relative, strict=True)
        columns = ["time", "growth", "relative_error"]
        table = pd.DataFrame(rows, columns=columns).sort_values("relative_error").drop_duplicates("time")
        speed = chain(results[0]).sound_speed_in_cells / rate
        return cls(speed, *table.sort_values("time")[columns].to_numpy().T)

    def conductivity(self, time: float) -> tuple[float, float]:
        """κ_0 λ/√T if sound leaves after this time, and its error."""
        growth, error = (
            np.interp(np.log(time), np.log(self.time), values)
            for values in (np.log(self.growth), self.relative_error)
        )
        return float(np.exp(growth)), float(np.exp(growth) * error)

    def departure(self, conductivity: float, error: float) -> tuple[float, float]:
        """Time after which sound leaves, from κ_0 λ/√T, and its error."""
        increasing = np.maximum.accumulate(np.log(self.growth))
        time = float(np.exp(np.interp(np.log(conductivity), increasing, np.log(self.time))))
        exponent = np.gradient(np.log(self.growth), np.log(self.time)).mean()
        _, own = self.conductivity(time)
        return time, float(time / exponent * np.hypot(error, own) / conductivity)


def rings(results: Sequence[Result]) -> dict[float, Ring]:
    """Rings of one mass, combined by gas, by their ζ."""
    of_zeta: dict[float, list[Result]] = {}
    for result in results:
        of_zeta.setdefault(chain(result).zeta, []).append(result)
    return {zeta: Ring.of(of_gas) for zeta, of_gas in of_zeta.items()}


def fugacity(result: Result) -> float:
    """ζ of the gas that the baths of an open chain would keep in equilibrium, from their flux at p = 0 [eq. 5]."""
    rate, temperature = (float(np.sqrt(np.prod(result.ends(name)))) for name in ("nu", "temperature"))
    return rate * np.sqrt(2 / (np.pi * temperature)) * setting.spacing(result)[0]


def nearest_of(value: float, given: Iterable[float]) -> float:
    """The given value with the smallest relative distance from `value`, as ζ of the rings of `momentum` is rounded to 1.6."""
    return min(given, key=lambda candidate: abs(candidate / value - 1))


def with_theory(
    table: pd.DataFrame, open_chains: Sequence[Result], by_zeta: dict[float, Ring]
) -> tuple[pd.DataFrame, Mean]:
    """Adds to the table τ of every size at the fixed spacing, and κ_0 predicted with the mean of τ. Returns the table and this mean.
    by_zeta: rings by ζ."""
    ring_of, unit = {}, {}
    for result in open_chains:
        key = gas(result), int(result.parameters["cells"])
        ring_of[key] = by_zeta[nearest_of(fugacity(result), by_zeta)]
        unit[key] = np.sqrt(np.sqrt(np.prod(result.ends("temperature")))) / setting.spacing(result)[0]
    keys = [*zip(table.gas, table.cells, strict=True)]
    for k, (name, cells) in enumerate(keys):
        if name != DENSE:
            continue
        ring, scale = ring_of[name, cells], unit[name, cells]
        time = ring.departure(table.kappa_0[k] / scale, table.kappa_0_error[k] / scale)
        table.loc[k, ["tau", "tau_error"]] = np.array(time) * ring.sound_speed / cells
    fixed = table.dropna(subset="tau")
    tau = Mean(*mean_of(fixed.tau, fixed.tau_error), len(fixed) - 1)
    for k, (name, cells) in enumerate(keys):
        ring = ring_of[name, cells]
        value = ring.conductivity(tau.value * cells / ring.sound_speed)
        table.loc[k, ["predicted", "predicted_error"]] = np.array(value) * unit[name, cells]
    return table, tau


def response(open_chains: Sequence[Result], results: Sequence[Result]) -> tuple[pd.DataFrame, Mean]:
    """Table of the open chains with the prediction, and the mean of τ. The prediction uses the rings with the mass of the open chains."""
    mass = open_chains[0].parameters["sigma"]
    closed = [
        result
        for result in results
        if result.provenance["program"] == "heat_current"
        and result.parameters["rule"] == "elastic"
        and result.parameters["sigma"] == mass
    ]
    return with_theory(tabulate(open_chains), open_chains, rings(closed))
