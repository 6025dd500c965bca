"""Rings in equilibrium."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from workflow.lib.load import Result
from workflow.lib.text import format_number
from workflow.physics import run_parameters
from workflow.physics.sound import Chain

STATE = ["sigma", "fugacity", "temperature", "cell_length"]  # parameters of a gas
GAS = ["rule", "epsilon", *STATE]  # columns that identify a gas


def epsilon(result: Result) -> float:
    """Fraction of the collisions that the rule of the result disturbs; 0 of the elastic one."""
    return float(result.parameters.get(f"{result.parameters['rule']}_probability", 0))


def chain(result: Result) -> Chain:
    """The gas of a ring."""
    temperature, length = (result.parameters[name] for name in ("temperature", "cell_length"))
    return Chain(result.parameters["fugacity"] * length, run_parameters.mass(result), temperature, length)


def gas(result: Result) -> tuple[str | float, ...]:
    """Values of the columns GAS, as given: ζ and M would be equal at other temperatures or lengths, and differ by
    rounding."""
    state = (float(result.parameters[name]) for name in STATE)
    return (result.parameters["rule"], epsilon(result), *state)


def texts(zeta: float, mass: float) -> tuple[str, str]:
    """ζ and M as text, without rounding errors: 0.8 and 1/3."""
    zeta_text, mass_text = (format_number(float(f"{value:.13g}")) for value in (zeta, mass))
    return zeta_text, mass_text


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per gas and time. <Q²>, and its exponent over the octave that begins at this time, are each
    taken from the ring in which their error is smallest."""
    rows = []
    for result in results:
        heat, exponent, scaled = result["heat_variance"], result["local_exponent"], chain(result)
        of_gas = dict(zip(GAS, gas(result), strict=True)) | {"zeta": scaled.zeta, "mass": scaled.mass}
        octaves = {
            "middle": exponent.axes["middle"],
            "local_exponent": exponent.mean,
            "local_exponent_error": exponent.error,
        }
        for k, time in enumerate(heat.axes["time"]):
            octave = {name: values[k] if k < len(values) else np.nan for name, values in octaves.items()}
            row = {"cells": result.parameters["cells"], "time": time}
            row |= {"heat_variance": heat.mean[k], "heat_variance_error": heat.error[k]}
            rows.append(of_gas | row | octave)
    table = pd.DataFrame(rows)
    best = _most_precise(table, "heat_variance")
    exponents = _most_precise(table.dropna(subset="middle"), "local_exponent")
    columns = ["middle", "local_exponent", "local_exponent_error"]
    merged = best.drop(columns=columns).merge(exponents[[*GAS, "time", *columns]], "left", [*GAS, "time"])
    return merged.sort_values([*GAS, "time"], ignore_index=True)


def _most_precise(table: pd.DataFrame, name: str) -> pd.DataFrame:
    """The row of every gas and time with the smallest relative error of a quantity."""
    relative = table[f"{name}_error"] / table[name].abs()
    return table.loc[relative.sort_values().index].groupby([*GAS, "time"], sort=False).head(1)
