"""Results with known values for the runs of the plan, with their parameters."""

import math
import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from tests.python.conftest import ROOT
from workflow.claims.data import Data, MissingError
from workflow.claims.verdict import Number
from workflow.lib.load import Quantity, Result
from workflow.lib.plan import Panel, Run, data_path, load_plan

# Of every program, the quantities that claims are judged by, with their axes (docs/format.md).
QUANTITIES: dict[str, dict[str, tuple[str, ...]]] = {
    "particle_count": {"log_slope": (), "log_curvature": (), "plateau": ("time",), "front": ("time",), "front_exponent": ()},
    "persistence": {"mu": ()},
    "waiting_time": {"exponent": (), "exponent_spread": ()},
    "displacement": {"alpha": (), "momentum_drift": ()},
    "ageing": {"decade_slope": ("decade",)},
    "steady_profile": {
        "temperature_scatterer": ("cell",), "temperature_particle": ("cell",), "temperature_difference": ("cell",),
        "density_slope": (), "density_excess": ("end",), "rate_right": ("cell",), "rate_right_deviation": ("cell",),
        "rate_left_deviation": ("cell",), "particle_current_deviation": ("bond",), "scatterer_density": ("end", "momentum"),
    },
    "momentum_flux": {"flux": ("bond", "momentum"), "jump": ("bond",), "square": ("bond", "half"), "kurtosis": ("bond", "half")},
    "boltzmann": {"flux": ("x", "momentum"), "flux_density": ("x", "momentum"), "jump": ("x",), "kurtosis": ("x", "half")},
    "conductivity": {"kappa": (), "kappa_particle": (), "stationary": (), "energy_current": (), "particle_current": (), "current_correlation": ()},
    "correlation": {
        "damping_exponent": (), "damping_exponent_from": ("from",), "peak": ("time",),
    },
    "heat_current": {"local_exponent": ("middle",)},
    "energy_pulse": {
        "centre_share": ("time",), "odd_part": ("time", "distance"), "peak": ("time",), "peak_position": ("time",),
        "peak_speed": ("middle",), "damping_exponent": (), "damping_exponent_from": ("from",),
        "peak_raw": ("time",), "damping_drift": (), "local_damping_exponent": ("until",), "energy_difference": ("time", "cell"),
    },
}  # fmt: skip
DEFAULTS = {
    "cells": "continuum",
    "zero-total-momentum": False,
    "random-direction": False,
}  # where the plan leaves an option out

Fill = Callable[[Run], Mapping[str, Quantity]]
# By quantity: a number, or a function of the run and the coordinates along each axis.
Truth = Mapping[str, Any]

plan = cache(load_plan)


class Known(Data):
    """Every run of these panels has the results that the function returns for it; other panels have none."""

    def __init__(
        self, fills: Mapping[str, Fill], quality: str = "paper", converged: str = "no target"
    ) -> None:
        self.quality, self.root, self.fills, self.converged = quality, ROOT, fills, converged
        self.plan: dict[str, Panel] = plan(quality)
        self.loaded, self.used = {}, {}

    def _load(self, panel: str, run: Run) -> tuple[str, Result]:
        path = data_path(self.quality, panel, run)
        if panel not in self.fills:
            raise MissingError(f"{path} is missing, damaged or unreadable")
        if path not in self.loaded:
            planned = replace(run, options=DEFAULTS | run.options)
            provenance = {"program": planned.program, "converged": self.converged}
            quantities = dict(self.fills[panel](planned))
            self.loaded[path] = Result(Path(path), planned.options, provenance, quantities)
        return path, self.loaded[path]


def axes(run: Run) -> dict[str, np.ndarray]:
    """Coordinates along every axis that a quantity of the run may have."""
    cells = run.options["cells"] if isinstance(run.options["cells"], int) else 10
    times = np.array(str(run.options.get("times", 1)).split(","), dtype=float)
    bins, largest = run.options.get("momentum-bins", 100), run.options.get("momentum-max", 60)
    decades, end = run.options.get("decades", 6), run.options.get("observation-time")
    places = run.options.get("positions")
    return {
        "time": times,
        "from": times[:-1],
        "middle": 0.5 * (times[1:] + times[:-1]),
        "until": times[2::2],
        "cell": np.arange(float(cells)),
        "bond": np.arange(cells + 1.0),
        "end": np.arange(2.0),
        "half": np.array([-1.0, 1.0]),
        "x": np.array(places.split(","), dtype=float) if places else np.linspace(0, 1, cells + 1),
        "momentum": (np.arange(bins) + 0.5) * (2 * largest / bins) - largest,
        "distance": np.arange(1.0, cells // 2 + 1),
        "decade": (end if isinstance(end, int) else 1) * 10.0 ** np.arange(-decades, 0),
    }


def quantity(run: Run, name: str, mean: np.ndarray, error: np.ndarray) -> Quantity:
    """With a standard error, or a discretisation error if the run is not replicated."""
    along = {axis: axes(run)[axis] for axis in QUANTITIES[run.program][name]}
    if run.replicated:
        count = np.full(mean.shape, run.options["replicas"])
        return Quantity(mean, error, None, count, along, "1", {}, {}, None)
    return Quantity(mean, None, error, None, along, "1", {}, {}, None)


def uneven(run: Run) -> dict[str, Quantity]:
    """All quantities of a run: values from 1 to 2, errors from 0.01 to 0.02, different for every element and run."""
    random = np.random.default_rng(zlib.crc32(f"{run.name} {run.program} {run.options.get('seed')}".encode()))
    coordinates = axes(run)
    shapes = {
        name: tuple(len(coordinates[axis]) for axis in along)
        for name, along in QUANTITIES[run.program].items()
    }
    return {
        name: quantity(
            run, name, np.asarray(random.uniform(1, 2, shape)), np.asarray(random.uniform(0.01, 0.02, shape))
        )
        for name, shape in shapes.items()
    }


def truth(
    given: Truth, relative: float, random: np.random.Generator | None = None
) -> Callable[[Run], dict[str, Quantity]]:
    """The quantities given, with this relative error, or this error where they vanish. With random numbers they are measured:
    normal values with errors that are estimated from as many replicas as the run has."""

    def fill(run: Run) -> dict[str, Quantity]:
        coordinates = axes(run)
        found = {}
        for name in QUANTITIES[run.program].keys() & given.keys():
            grids = np.meshgrid(*(coordinates[axis] for axis in QUANTITIES[run.program][name]), indexing="ij")
            value = given[name](run, *grids) if callable(given[name]) else given[name]
            mean = np.array(np.broadcast_to(value, grids[0].shape if grids else ()), dtype=float)
            error = relative * np.where(mean == 0, 1, abs(mean))
            if random is not None and name != "stationary":
                mean = mean + error * random.standard_normal(mean.shape)
                freedom = run.options["replicas"] - 1
                error = error * np.sqrt(random.chisquare(freedom, mean.shape) / freedom)
            found[name] = quantity(run, name, mean, error)
        return found

    return fill


# What the tests of the claims' numbers share: results in which no two values are alike, and the numbers they should give.
PANELS = ("fig01", "fig02_upper", "fig03", "fig03_inset", "fig04a", "fig04b", "fig05", "fig06", "fig07", "fig07_inset",
          "fig08", "fig09a", "fig09b", "ext01", "ext03", "ext05", "ext07", "ext09", "ext10")  # fmt: skip
DATA = Known(dict.fromkeys(PANELS, uneven))


def check(
    numbers: Sequence[Number],
    value: ArrayLike,
    error: ArrayLike,
    systematic: ArrayLike = 0,
    freedom: float | None = None,
) -> None:
    """One number per value, in their order."""
    assert len(numbers) == np.size(value)
    found = np.array([(one.value, one.error, one.systematic) for one in numbers]).T
    for column, expected in zip(found, (value, error, systematic), strict=True):
        np.testing.assert_allclose(column, np.broadcast_to(expected, column.shape), rtol=1e-9, atol=1e-12)
    assert freedom is None or {one.freedom for one in numbers} == {freedom}


def freedom(panel: str, series: str, data: Known = DATA) -> int:
    """One less than the replicas of a series."""
    (replicas,) = {run.options["replicas"] for run in data.plan[panel].runs if run.series == series}
    return int(replicas) - 1


def of(panel: str, run: str, name: str, data: Known = DATA) -> tuple[np.ndarray, np.ndarray]:
    """Mean and error of a quantity of the input."""
    found = data.one(panel, run)[name]
    return found.mean, found.error


def each(panel: str, name: str, *runs: str) -> tuple[np.ndarray, np.ndarray]:
    mean, error = np.array([of(panel, run, name) for run in runs]).T
    return mean, error


def relative_change(one: ArrayLike, other: ArrayLike, *errors: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """other/one - 1 with the error by the two derivatives."""
    one, other = np.asarray(one), np.asarray(other)
    return other / one - 1, np.sqrt((errors[1] / one) ** 2 + (other * errors[0] / one**2) ** 2)


def line(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> tuple[float, float]:
    """Slope and its error."""
    solution, covariance = np.polyfit(
        np.asarray(x), np.asarray(y), 1, w=1 / np.asarray(error), cov="unscaled"
    )
    return float(solution[0]), math.sqrt(covariance[0, 0])


def power(x: ArrayLike, y: ArrayLike, error: ArrayLike) -> tuple[float, float, float]:
    """Exponent, its error, change without the first point."""
    x, relative, y = np.log(x), np.asarray(error) / y, np.log(y)
    exponent, spread = line(x, y, relative)
    return exponent, spread, abs(line(x[1:], y[1:], relative[1:])[0] - exponent) if len(x) > 2 else 0
