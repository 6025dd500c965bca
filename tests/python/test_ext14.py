"""The panel of the weak pulse and of the long ring, on peaks that follow their laws."""

import numpy as np

from tests.python.known_results import Known, axes, quantity, uneven
from workflow.figures.ext14 import draw
from workflow.lib.load import Quantity
from workflow.plan import Run


def test_laws_are_horizontal_and_the_runs_are_those_of_one_start() -> None:
    """The height falls as t^(-2/3) and the position is that of free flight. For the other start both deviate by 0.5 % per unit of ln t.
    At the first time there is no peak. Detected mistakes: another power; the run of fig. 9 with the other start; another speed."""

    def fill(run: Run) -> dict[str, Quantity]:
        time = axes(run)["time"]
        start = 0 if run.options["gamma"] == "N" else "particles"
        off = time ** (0.005 * (run.options["scatterer-temperature"] != start))
        laws = {
            "peak": 7 * time ** (-2 / 3) * off,
            "peak_position": 2 * run.options["pulse-energy"] ** 0.5 * time * off,
        }
        for law in laws.values():
            law[0] = np.nan
        return uneven(run) | {name: quantity(run, name, law, 0.01 * law) for name, law in laws.items()}

    data = Known(dict.fromkeys(("fig09a", "fig09b", "ext14"), fill))
    _, table, caption = draw([result for panel in ("fig09b", "ext14", "fig09a") for result in data.of(panel)])
    np.testing.assert_allclose(table.relative, 1)
    np.testing.assert_allclose(table.relative_error, 0.01)
    assert [*table.groupby("quantity").cells.unique()["peak_position"]] == [101, 1001]
    assert [*table.groupby("quantity").pulse_energy.unique()["peak"]] == [50_000, 9500]
    assert len(caption.split()) <= 120
    assert table.groupby(["quantity", "cells"]).time.min().to_dict() == {
        ("peak", 101): 0.02, ("peak_position", 101): 0.0125, ("peak_position", 1001): 0.04
    }  # fmt: skip
