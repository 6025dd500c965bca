"""Results with known values for the runs of the plan, with their parameters."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from tests.python.conftest import planned, sampled
from tests.python.described import described
from workflow.lib.load import Quantity, Result
from workflow.pipeline.plan import Run
from workflow.study.results import MissingError, Results

DEFAULTS = {
    "cells": "continuum",
    "zero-total-momentum": False,
    "rule": "elastic",
    "gamma": "N",
}  # defaults of options that the plan does not give

Fill = Callable[[Run], Mapping[str, Quantity]]
# True value by quantity: a number, or a function of the run and of the coordinates along each axis.
Truth = Mapping[str, Any]


@cache
def axes_of(program: str) -> dict[str, tuple[str, ...]]:
    """Names of the axes of every quantity of a program."""
    quantities = described()[program]["quantities"]
    return {quantity["name"]: tuple(axis["name"] for axis in quantity["axes"]) for quantity in quantities}


class Known(Results):
    """Results of the runs of a plan, those of some panels, as the function of the panel returns them. A
    result is made when a claim first needs it."""

    def __init__(self, fills: Mapping[str, Fill], quality: str = "paper") -> None:
        super().__init__([])
        self.fills = fills
        self.runs = {panel.name: panel.runs for panel in planned(quality)}
        self.loaded: dict[str, Result] = {}

    def results(self, panel: str, *series: str, **parameters: object) -> list[Result]:
        wanted = {name.replace("_", "-"): value for name, value in parameters.items()}
        runs = [
            run
            for run in self.runs[panel]
            if run.series in series
            and all(run.options.get(name, value) == value for name, value in wanted.items())
        ]
        return Results(map(self._load, runs)).results(panel, *series, **parameters)

    def one(self, panel: str, run: str) -> Result:
        return Results(self._load(one) for one in self.runs[panel] if one.name == run).one(panel, run)

    def _load(self, run: Run) -> Result:
        path = run.path
        if run.panel not in self.fills:
            raise MissingError(f"{path} is missing")
        if path not in self.loaded:
            completed = replace(run, options=DEFAULTS | run.options)
            provenance = {"program": run.program, "converged": "no target"}
            quantities = dict(self.fills[run.panel](completed))
            parameters = {name.replace("-", "_"): value for name, value in completed.options.items()}
            self.loaded[path] = Result(Path(path), parameters, provenance, quantities)
        return self.loaded[path]


def axes(run: Run) -> dict[str, np.ndarray]:
    """Coordinates along every axis that a quantity of the run may have."""
    cells = run.options["cells"] if isinstance(run.options["cells"], int) else 10
    times = np.array(str(run.options.get("times", 1)).split(","), dtype=float)
    if "decades" in run.options:
        times = run.options["observation-time"] * np.geomspace(1e-3, 1, 10)
    bins, largest = run.options.get("momentum-bins", 100), run.options.get("momentum-max", 60)
    positions = run.options.get("positions")
    return {
        "time": times,
        "from": times[:-1],
        "middle": 0.5 * (times[1:] + times[:-1]),
        "until": times[2::2],
        "cell": np.arange(float(cells)),
        "bond": np.arange(cells + 1.0),
        "end": np.arange(2.0),
        "half": np.array([-1.0, 1.0]),
        "x": np.array(positions.split(","), dtype=float) if positions else np.linspace(0, 1, cells + 1),
        **dict.fromkeys(
            ("momentum", "scaled_momentum"), (np.arange(bins) + 0.5) * (2 * largest / bins) - largest
        ),
        "distance": np.arange(1.0, cells // 2 + 1),
    }


def truth(given: Truth, relative: float) -> Fill:
    """Function that returns the results of a run with given true values: with a standard error, or with a
    discretisation error if the run is not replicated. It is relative to the value, or absolute where the
    value is 0."""

    def fill(run: Run) -> dict[str, Quantity]:
        coordinates, quantities = axes(run), {}
        for name in (name for name in given if name in axes_of(run.program)):
            along = {axis: coordinates[axis] for axis in axes_of(run.program)[name]}
            grids = np.meshgrid(*along.values(), indexing="ij")
            value = given[name](run, *grids) if callable(given[name]) else given[name]
            mean = np.array(np.broadcast_to(value, grids[0].shape if grids else ()), dtype=float)
            error = relative * np.where(mean == 0, 1, abs(mean))
            # With a target error the number is not that of the option.
            count = np.full(mean.shape, run.options["replicas"] + 47) if sampled(run) else None
            errors = (error, None) if sampled(run) else (None, error)
            quantities[name] = Quantity(mean, *errors, count, along, "1", {}, 0)
        return quantities

    return fill
