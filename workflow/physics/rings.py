"""Rings in equilibrium."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from workflow.lib import style
from workflow.lib.load import Result
from workflow.physics import setting
from workflow.physics.mode_coupling import Chain, logarithm_at

GAS = ["rule", "passing", "epsilon", "zeta", "mass"]  # columns that identify a gas

# Marker and colour by ζ and M; the dense one has those of the open chain of the same gas (workflow/physics/conductivity.py).
OF_GAS = {
    (0.2, 0.111): ("v", style.GREEN),
    (0.8, 0.333): ("o", style.VERMILLION),
    (0.8, 3): ("s", style.ORANGE),
    (1.6, 3): ("^", style.BLUE),
}


def look_of(zeta: float, mass: float) -> tuple[str, str]:
    """Marker and colour of a gas, the same in every panel and at every quality."""
    return OF_GAS.get((round(zeta, 3), round(mass, 3)), ("P", style.BLACK))


def chain(result: Result, time: float = np.inf) -> Chain:
    """The gas of a ring, with only those slow particles that move within a time."""
    temperature, length, sigma = (result.parameters[name] for name in ("temperature", "cell-length", "sigma"))
    slow = logarithm_at(time, temperature, length) if np.isfinite(time) else np.inf
    zeta = result.parameters["fugacity"] * length
    return Chain(zeta, (1 + sigma) / (1 - sigma), temperature, length, slow)


def tabulate(results: Sequence[Result]) -> pd.DataFrame:
    """One row per gas and time. <Q²>, and its exponent over the octave that begins at this time, are each taken from the ring
    in which their error is smallest."""
    rows = []
    for result in results:
        heat, exponent, gas = result["heat_variance"], result["local_exponent"], chain(result)
        scattering = (result.parameters["rule"], setting.passing(result), setting.epsilon(result))
        octaves = {
            "middle": exponent.axes["middle"],
            "local_exponent": exponent.mean,
            "local_exponent_error": exponent.error,
        }
        for k, time in enumerate(heat.axes["time"]):
            octave = {name: values[k] if k < len(values) else np.nan for name, values in octaves.items()}
            row = {"cells": result.parameters["cells"], "time": time}
            row |= {"heat_variance": heat.mean[k], "heat_variance_error": heat.error[k]}
            rows.append(dict(zip(GAS, (*scattering, gas.zeta, gas.mass), strict=True)) | row | octave)
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
