"""Results with known values for the runs of the plan, with their parameters."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from tests.python.conftest import planned, sampled
from tests.python.described import described
from workflow.lib.load import Quantity, Result
from workflow.pipeline.plan import Run
from workflow.study.results import Results

# Defaults of options that the plan does not give.
DEFAULTS = {"cells": "continuum", "zero-total-momentum": False, "rule": "elastic", "gamma": "N"}
# True value by quantity: a number, or a function of the run and of the coordinates along each axis.
Truth = Mapping[str, Any]
World = Mapping[str, Truth]  # by panel, the true values of the quantities on which a claim depends


@cache
def axes_of(program: str) -> dict[str, tuple[str, ...]]:
    """Names of the axes of every quantity of a program."""
    quantities = described()[program]["quantities"]
    return {quantity["name"]: tuple(axis["name"] for axis in quantity["axes"]) for quantity in quantities}


def axes(run: Run) -> dict[str, np.ndarray]:
    """Coordinates along every axis of the quantities of the worlds."""
    cells = run.options["cells"] if isinstance(run.options["cells"], int) else 10
    times = np.array(str(run.options.get("times", 1)).split(","), dtype=float)
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
        "x": np.array(positions.split(","), dtype=float) if positions else np.linspace(0, 1, cells + 1),
        "momentum": (np.arange(bins) + 0.5) * (2 * largest / bins) - largest,
    }


def known(world: World, relative: float) -> Results:
    """Results of the runs of the release with true values: with a standard error, or with a discretisation
    error if the run is not replicated. It is relative to the value, or absolute where the value is 0."""
    plan = planned("paper")
    return Results(
        _result(run, given, relative) for panel, given in world.items() for run in plan[panel].runs
    )


def _result(planned_run: Run, given: Truth, relative: float) -> Result:
    run = replace(planned_run, options=DEFAULTS | planned_run.options)
    coordinates, quantities = axes(run), {}
    for name in given.keys() & axes_of(run.program).keys():
        along = {axis: coordinates[axis] for axis in axes_of(run.program)[name]}
        grids = np.meshgrid(*along.values(), indexing="ij")
        value = given[name](run, *grids) if callable(given[name]) else given[name]
        mean = np.array(np.broadcast_to(value, grids[0].shape if grids else ()), dtype=float)
        error = relative * np.where(mean == 0, 1, abs(mean))
        # With a target error the number is not that of the option.
        count = np.full(mean.shape, run.options["replicas"] + 47) if sampled(run) else None
        errors = (error, None) if sampled(run) else (None, error)
        quantities[name] = Quantity(mean, *errors, count, along, "1", {}, 0)
    parameters = {name.replace("-", "_"): value for name, value in run.options.items()}
    provenance = {"program": run.program, "converged": "no target"}
    return Result(Path(planned_run.path), parameters, provenance, quantities)
