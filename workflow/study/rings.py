"""Rings in equilibrium."""

from collections.abc import Sequence
from math import ceil
from typing import Any

import pandas as pd

from workflow.lib.load import Result
from workflow.lib.text import format_number
from workflow.physics import run_parameters
from workflow.physics.sound import Chain

STATE = ["sigma", "fugacity", "temperature", "cell_length"]  # parameters of a gas
SIZES = (16, 32, 64, 128, 256, 512, 1024, 2048)  # N of the chains of fig. 8 whose gas is observed
SLOW_FLUX = 16  # z in the middle of fig. 8's chain: between 19.4 and 13.0, those of its baths
SECOND_MOMENT = 0.510523  # of f_KPZ, the shape of a peak of sound
GAS = ["rule", "epsilon", *STATE]  # columns that identify a gas


def epsilon(result: Result) -> float:
    """Fraction of the collisions that the rule of the result disturbs; 0 of the elastic one."""
    return float(result.parameters.get(f"{result.parameters['rule']}_probability", 0))


def chain(result: Result) -> Chain:
    """The gas of a ring. Raises ValueError if sound travels around the ring within its last time: two peaks
    meet after half of it, as wide as their root mean square [eq. 53]."""
    temperature, length = (result.parameters[name] for name in ("temperature", "cell_length"))
    gas = Chain(result.parameters["fugacity"] * length, run_parameters.mass(result), temperature, length)
    time = result["mean_square_heat"].axes["time"][-1]
    reach = gas.sound_speed * time + SECOND_MOMENT**0.5 * (gas.self_coupling * time) ** (2 / 3)
    least = 2 * reach / length
    if result.parameters["cells"] < least:
        raise ValueError(
            f"{result.series}: sound travels around the ring until t = {time:g}; choose at least "
            f"{ceil(least)} cells, or earlier times"
        )
    return gas


def gas(result: Result) -> tuple[str | float, ...]:
    """Values of the columns GAS, as given: ζ and M would be equal at other temperatures or lengths, and
    differ by rounding."""
    state = (float(result.parameters[name]) for name in STATE)
    return (result.parameters["rule"], epsilon(result), *state)


def green_kubo(result: Result, temperature: float, length: float) -> tuple[int, float, float]:
    """N of the chain of fig. 8 that holds this gas, and its conductivity of heat per cell by Green and Kubo
    at the last time of the ring [eq. 56], with its error. temperature, length: of the chain."""
    heat, own = result["mean_square_heat"], chain(result)
    cells = round(SLOW_FLUX / own.zeta)
    speed = cells * temperature**0.5 / length  # √T̄/λ of the chain
    unit = 2 * heat.axes["time"][-1] * own.cell_length * own.temperature**2.5 / speed
    return cells, float(heat.mean[-1] / unit), float(heat.error[-1] / unit)


def last_exponent(result: Result) -> tuple[float, float, float]:
    """β over the last octave of time, after the geometric middle of the octave, and before its error."""
    exponent = result["local_exponent"]
    return float(exponent.axes["middle"][-1]), float(exponent.mean[-1]), float(exponent.error[-1])


def texts(zeta: float, mass: float) -> tuple[str, str]:
    """ζ and M as text, without rounding errors: 0.8 and 1/3."""
    zeta_text, mass_text = (format_number(float(f"{value:.13g}")) for value in (zeta, mass))
    return zeta_text, mass_text


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per gas and time, with the exponent of <Q²> over the octave that begins at this time; NaN for
    the last one of a ring."""
    tables = []
    for result in results:
        heat, exponent, scaled = result["mean_square_heat"], result["local_exponent"], chain(result)
        own: dict[str, Any] = dict(zip(GAS, gas(result), strict=True)) | {
            "zeta": scaled.zeta,
            "mass": scaled.mass,
        }
        own |= {"cells": result.parameters["cells"], "time": heat.axes["time"]}
        table = pd.DataFrame(own | {"mean_square_heat": heat.mean, "mean_square_heat_error": heat.error})
        octaves = {"middle": exponent.axes["middle"], "local_exponent": exponent.mean}
        tables.append(table.join(pd.DataFrame(octaves | {"local_exponent_error": exponent.error})))
    return pd.concat(tables).sort_values([*GAS, "time"], ignore_index=True)
