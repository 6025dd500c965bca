"""Closed chains against the reference simulator, which shares no code and no random numbers with the
programs.

That no two replicas or seeds share a draw is tested in tests/cpp/engine/chance_test.cpp. Draws common to all
of them shift every result alike, and only this comparison finds them.
"""

from typing import Any

import numpy as np
import pytest

from tests.python.conftest import Measure, agree, simulate

Chain = dict[str, Any]  # options of a program
# Few particles in many replicas, so that errors common to all replicas exceed the standard errors.
BASE = {"sigma": 0.5, "gamma": "N", "cells": 6, "particles_per_cell": 1, "temperature": 500}
BASE |= {"relaxation_time": 0.5, "observation_time": 5, "replicas": 4000}

DECADES, POINTS_PER_DECADE, EVERY = 2, 8, 4  # times of the programs; every fourth is compared
BINS_PER_DECADE, BINS = 10, 50  # bins of the waiting times
MEANS = ("mu", "particle_energy", "scatterer_energy")  # over scatterings


def waiting_time_edges(chain: Chain) -> np.ndarray:
    return 1e-3 / np.sqrt(chain["temperature"]) * 10 ** (np.arange(BINS + 1) / BINS_PER_DECADE)


def reference(chain: Chain) -> dict[str, np.ndarray]:
    """Measurements of the reference simulator, [replica, ...]."""
    times = chain["observation_time"] * 10 ** np.arange(-DECADES, 0.01, EVERY / POINTS_PER_DECADE)
    options = chain | {"times": ",".join(map(str, times)), "seed": 1}
    options["gamma"] = chain["cells"] if chain["gamma"] == "N" else chain["gamma"]
    options["particle_reversal"] = 0.5 if options.pop("rule", None) == "random-direction" else 0
    options["scatterer_reversal"] = options.pop("reversal_probability", 0)
    options["rotation"] = options.pop("rotation_probability", 0)
    bins = {"first_edge": waiting_time_edges(chain)[0], "bins_per_decade": BINS_PER_DECADE, "bins": BINS}
    rows = simulate("closed_chain", **options, **bins)
    moments, scatterings, sums, waits = np.split(rows, 2 * len(times) + np.array([0, 1, 4]), axis=1)
    names = ("mean_square_displacement", "mean_square_drift")
    measurements = dict(zip(names, np.moveaxis(moments.reshape(chain["replicas"], -1, 2), 2, 0), strict=True))
    means = dict(zip(MEANS, np.moveaxis(sums[:, :, None], 1, 0), strict=True))
    return measurements | means | {"scatterings": scatterings, "waits": waits}


def average(sample: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return sample.mean(axis=0), sample.std(axis=0, ddof=1) / np.sqrt(len(sample))


def ratio(counts: np.ndarray, totals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Ratio of sums over replicas, with its standard error to first order."""
    value = counts.sum(axis=0) / totals.sum()
    return value, average((counts - value * totals) / totals.mean())[1]


Measured = dict[str, tuple[np.ndarray, np.ndarray]]  # means and standard errors


def measured(measure: Measure, chain: Chain) -> Measured:
    """Means and standard errors of all measurements by the programs."""
    measurements: Measured = {}

    def add(name: str, quantities: list[str], every: int = 1, **options: object) -> None:
        result = measure(name, **chain, **options)
        for key in quantities:
            measurements[key] = tuple(
                np.ravel(x)[::every] for x in (result[key].mean, result[key].standard_error)
            )

    add("displacement", ["mean_square_displacement", "mean_square_drift"], EVERY, decades=DECADES)
    add("persistence", [*MEANS])
    add("waiting_time", ["density"])
    return measurements


def scores(measurements: Measured, chain: Chain) -> dict[str, np.ndarray]:
    """z-scores of all measurements against the reference simulator."""
    sample = reference(chain)
    expected = {name: average(sample[name]) for name in measurements if name not in (*MEANS, "density")}
    often = sample["waits"].sum(axis=0) > 200  # often enough for a normal mean
    expected |= {name: ratio(sample[name], sample["scatterings"]) for name in MEANS}
    widths = np.diff(waiting_time_edges(chain))
    density = ratio(sample["waits"], sample["scatterings"])
    expected["density"] = tuple((x / widths)[often] for x in density)
    measurements = measurements | {"density": tuple(x[:BINS][often] for x in measurements["density"])}
    return {
        name: (measurements[name][0] - mean) / np.hypot(measurements[name][1], error)
        for name, (mean, error) in expected.items()
    }


REVERSAL = {"rule": "reversal", "reversal_probability": 0.3}
ROTATION = {"rule": "rotation", "rotation_probability": 0.3}
CHAINS = [
    BASE | {"sigma": 0.5},
    BASE | {"sigma": -0.4, "gamma": 3},
    BASE | {"sigma": -0.4, "gamma": 0.3},
    BASE | {"sigma": -0.4, "rule": "random-direction"},
    BASE | {"sigma": 0.5, "gamma": 1, "rule": "random-direction"},
    BASE | {"sigma": 0.5} | REVERSAL,
    BASE | {"sigma": -0.4, "gamma": 1} | REVERSAL,
    BASE | {"sigma": 0.5} | ROTATION,
    BASE | {"sigma": -0.4, "gamma": 1} | ROTATION,
    BASE
    | {"sigma": -0.9, "cells": 2, "particles_per_cell": 3, "rule": "rotation", "rotation_probability": 1},
]


@pytest.mark.parametrize("chain", CHAINS)
def test_closed_chain_against_the_reference_simulator(measure: Measure, chain: Chain) -> None:
    z = scores(measured(measure, chain), chain)
    assert agree(*z.values()), z


def test_closed_chain_with_other_parameters_does_not_agree_with_the_reference(measure: Measure) -> None:
    """Detected mistakes: another mass, rate of scattering, temperature, relaxation time or collision rule."""
    chain = BASE | {"gamma": 1}
    measurements = measured(measure, chain)
    assert agree(*scores(measurements, chain).values())
    others = [{"sigma": 0.42}, {"gamma": 1.1}, {"temperature": 450}, {"relaxation_time": 1}]
    for mutant in (*others, REVERSAL, ROTATION):
        assert not agree(*scores(measurements, chain | mutant).values()), mutant
