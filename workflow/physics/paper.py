"""Parameters that the paper states for its figures, by the names of options, with all values. Numbers as text
are rounded to three decimals. What is missing, as the spacing in fig. 1, the paper does not state."""

from typing import Any

from workflow.lib.caption import BATHS

Stated = dict[str, list[Any]]

UNEQUAL: Stated = dict(zip(BATHS, ([220], [180], ["81.818"], ["122.222"]), strict=True))
EQUAL: Stated = {name: [100] for name in BATHS}
RING: Stated = {"cells": [11], "particles_per_cell": [20], "temperature": [500], "gamma": ["N"]}
PULSE: Stated = {"cells": [101], "particles_per_cell": [50], "sigma": [0.5], "gamma": [1, "N"]}
PULSE |= {"energy": [5000], "pulse_energy": [50000]}

PAPER: dict[str, Stated] = {
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
