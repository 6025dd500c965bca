"""Parameters that the paper states for its figures, by the names of options: one value, or a list. Numbers as
text are rounded. What is missing here, as the spacing in fig. 1, the paper does not state."""

from typing import Any

BATHS = {"nu_left": 220, "nu_right": 180, "temperature_left": "81.818", "temperature_right": "122.222"}
EQUAL = {"nu_left": 100, "nu_right": 100, "temperature_left": 100, "temperature_right": 100}
RING = {"cells": 11, "particles_per_cell": 20, "temperature": 500, "gamma": "N"}
PULSE = {"cells": 101, "particles_per_cell": 50, "sigma": 0.5, "gamma": [1, "N"], "energy": 5000}

PAPER: dict[str, dict[str, Any]] = {
    "fig01": {"cells": 201, "sigma": 0.5, "gamma": "N", "times": "200,600,1000,1400,1800"} | EQUAL,
    "fig02": {"cells": 30, "sigma": 0.5, "gamma": [1, "N"]} | BATHS,
    "fig03": {"sigma": 0.5, "gamma": 1} | BATHS,
    "fig03_inset": {"cells": [2, 4, 8, 16], "sigma": 0.5, "gamma": 1} | BATHS,
    "fig04": {"cells": 30, "cell_length": "1/N", "sigma": 0.5, "gamma": [1, "N"]} | BATHS,
    "fig05": RING,
    "fig06": {"sigma": [0, 0.5], "gamma": "N"},
    "fig07": RING | {"sigma": 0.5},  # the text; the caption states 1
    "fig07_inset": RING,
    "fig08": {"cell_length": "1/N", "sigma": 0.5, "gamma": [1, "N"]} | BATHS,
    "fig09": PULSE | {"pulse_energy": 50000},
    "fig10": PULSE | {"pulse_energy": 50000},
}
