"""Parameters of the figures by the names of options, with all values: those that the paper states, and those
that this project chooses where the paper states none, or for series that it adds."""

from typing import Any, Final

Stated = dict[str, list[Any]]  # numbers as text are rounded to three decimals

AXIS: Final = ["any"]  # in place of values: any, as on an axis of the figure

BATHS = ("nu_left", "nu_right", "temperature_left", "temperature_right")
UNEQUAL: Stated = dict(zip(BATHS, ([220], [180], ["81.818"], ["122.222"]), strict=True))
EQUAL: Stated = {name: [100] for name in BATHS}
RING: Stated = {"cells": [11], "particles_per_cell": [20], "temperature": [500], "gamma": ["N"]}
PULSE: Stated = {"cells": [101], "particles_per_cell": [50], "sigma": [0.5], "gamma": [1, "N"]}
PULSE |= {"energy": [5000], "pulse_energy": [50000]}

# By panel, or by its first five letters, which are those of a figure. The rule of all is elastic.
_STATED: dict[str, Stated] = {
    "fig01": EQUAL | {"cells": [201], "sigma": [0.5], "gamma": ["N"], "times": ["200,600,1000,1400,1800"]},
    "fig02": UNEQUAL | {"cells": [30], "sigma": [0.5], "gamma": [1, "N"]},
    "fig03": UNEQUAL | {"sigma": [0.5], "gamma": [1]},
    "fig03_inset": UNEQUAL | {"cells": [2, 4, 8, 16], "sigma": [0.5], "gamma": [1]},
    "fig04": UNEQUAL | {"cells": [30], "cell_length": ["1/N"], "sigma": [0.5], "gamma": [1, "N"]},
    "fig05": RING,
    "fig06": {"sigma": [0, 0.5], "gamma": ["N"]},
    "fig07": RING | {"sigma": [0.5]},  # the text; the caption states 1
    "fig07_inset": RING,
    "fig08": UNEQUAL | {"cell_length": ["1/N"], "sigma": [0.5], "gamma": [1, "N"]},
    "fig09": PULSE,
    "fig10": PULSE,
}

PAPER = {figure: stated | {"rule": ["elastic"]} for figure, stated in _STATED.items()}

ALL = ""  # in place of a series
ROW: Stated = {"cell_length": ["1/N"]}
UNIT: Stated = {"cell_length": [1], "relaxation_time": [100]}
NO_MOMENTUM: Stated = {"zero_total_momentum": [True]}
RATES: Stated = {"nu_left": [200], "nu_right": [200]}
TEMPERATURES: Stated = {"temperature_left": [100], "temperature_right": [100]}
LONG: Stated = {"scatterer_temperature": ["particles"], "relaxation_time": [0]}
FROM_REST: Stated = {"scatterer_temperature": [0], "relaxation_time": [1, 100]}
START: Stated = {"cell_length": [1], "pulse_cells": [1]}
HEATED: Stated = {"temperature_left": [50], "temperature_right": [200], "gamma": ["N"]}
DRIVEN = HEATED | {"nu_left": ["282.843"], "nu_right": ["141.421"], "cells": [32], "cell_length": [0.1]}
DRIVEN |= {"sigma": [0.5]}
LIMIT = HEATED | {"nu_left": ["28.284"], "nu_right": ["14.142"], "cells": [4], "cell_length": [1]}
LIMIT |= {"sigma": [0]}
RING_GAS: Stated = {"cells": AXIS, "fugacity": AXIS, "cell_length": [1], "temperature": [1]}
RING_GAS |= {"sigma": [-0.8, -0.5, 0.5]}
RINGS = [f"gas-{2**k}" for k in range(4, 12)] + ["thin-long"]
RINGS += [f"{gas}{size}" for gas in ("light", "dense", "sparse", "thin") for size in ("", "-longest")]
NOISY = [f"{gas}-{rule}" for gas in ("light", "thin") for rule in ("rotation", "reversal")]
SPARSE: Stated = {"nu_left": AXIS, "nu_right": AXIS}

# Choices of this project by panel or figure, then by series.
CHOICES: dict[str, dict[str, Stated]] = {
    "fig01": {ALL: {"cell_length": ["1/N", 1], "start": ["empty"]}},
    "fig02": {ALL: ROW},
    "fig03": {"equal": TEMPERATURES},
    "fig03_inset": {ALL: ROW, "continuum": {"cells": ["continuum"]}},
    "fig04": {
        "kinetic": {"cells": ["continuum"]},
        "equal": RATES,
        "mean-field-equal": RATES,
        "equilibrium-flux": RATES | TEMPERATURES,
        "equilibrium-profile": RATES | TEMPERATURES,
    },
    "fig05": {
        ALL: UNIT | {"sigma": AXIS},
        "zero-momentum": NO_MOMENTUM,
        "dense": {"particles_per_cell": [320], "relaxation_time": [20]},
    },
    "fig06": {
        ALL: UNIT | {"cells": [11], "particles_per_cell": [20], "temperature": [500]},
        "young": {"relaxation_time": [10]},
    },
    "fig07": {ALL: UNIT, "zero-momentum": NO_MOMENTUM, "large": {"cells": [101]}},
    "fig07_inset": {
        ALL: UNIT | {"sigma": AXIS},
        "zero-momentum": NO_MOMENTUM,
        "aged": {"relaxation_time": [10, 1000]},
        "random": {"rule": ["random-direction"], "relaxation_time": [1000]},
    },
    "fig08": {ALL: {"cells": AXIS}},
    "fig09": {ALL: START, "rest": FROM_REST, "gaussian": LONG},
    "fig10": {ALL: START, "long": LONG | {"cells": [301, 1001]}},
    "momentum": dict.fromkeys(RINGS, RING_GAS) | dict.fromkeys(NOISY, RING_GAS | {"rule": AXIS}),
    "accuracy": dict.fromkeys(("reference", "cold", "warm"), DRIVEN)
    | {"kinetic": UNEQUAL | {"sigma": [0.5], "gamma": [1, 50]}},
    "stability": {
        "rounding": RING
        | UNIT
        | {
            "relaxation_time": [0],
            "scatterer_temperature": [500],
            "sigma": [0.3],
            "rule": ["elastic", "printed"],
        },
        "passing": LIMIT | {"gamma": AXIS, "sigma": [0.5]},
        "light": LIMIT | {"sigma": AXIS},
        "heavy": LIMIT | {"sigma": AXIS, "gamma": [2]},
        "hot": LIMIT | {"temperature_right": AXIS},
        "seldom": LIMIT | SPARSE,
        "narrow": LIMIT | SPARSE | {"cell_length": AXIS},
        "wide": LIMIT | SPARSE | {"cell_length": AXIS},
    },
}
