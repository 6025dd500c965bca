"""Parameters that the paper states, by figure and by the names of options."""

from typing import Any, Final

Stated = dict[str, list[Any]]  # numbers as text are rounded to three decimals

AXIS: Final = ["any"]  # in place of values: any, as on an axis of the figure

BATHS = ("nu_left", "nu_right", "temperature_left", "temperature_right")
UNEQUAL: Stated = dict(zip(BATHS, ([220], [180], ["81.818"], ["122.222"]), strict=True))
EQUAL: Stated = {name: [100] for name in BATHS}
START: Stated = {"scatterer_temperature": [0], "zero_total_momentum": [False]}
RING = START | {"cells": [11], "particles_per_cell": [20], "temperature": [500], "gamma": ["N"]}
PULSE = START | {"cells": [101], "particles_per_cell": [50], "sigma": [0.5], "gamma": [1, "N"]}
PULSE |= {"energy": [5000], "pulse_energy": [50000], "pulse_cells": [1]}

# By panel, or by its first five letters, which are those of a figure. The rule of all is elastic.
_STATED: dict[str, Stated] = {
    "fig01": EQUAL
    | {"cells": [201], "sigma": [0.5], "gamma": ["N"], "start": ["empty"]}
    | {"times": ["200,600,1000,1400,1800"]},
    "fig02": UNEQUAL | {"cells": [30], "sigma": [0.5], "gamma": [1, "N"]},
    "fig03": UNEQUAL | {"sigma": [0.5], "gamma": [1]},
    "fig03_inset": UNEQUAL | {"cells": [2, 4, 8, 16], "sigma": [0.5], "gamma": [1]},
    "fig04": UNEQUAL | {"cells": [30], "cell_length": ["1/N"], "sigma": [0.5], "gamma": [1, "N"]},
    "fig05": RING | {"sigma": AXIS},
    "fig06": START | {"sigma": [0, 0.5], "gamma": ["N"]},
    "fig07": RING | {"sigma": [0.5]},  # the text; the caption states 1
    "fig07_inset": RING | {"sigma": AXIS},
    "fig08": UNEQUAL | {"cells": AXIS, "cell_length": ["1/N"], "sigma": [0.5], "gamma": [1, "N"]},
    "fig09": PULSE,
    "fig10": PULSE,
}

PAPER = {figure: stated | {"rule": ["elastic"]} for figure, stated in _STATED.items()}
