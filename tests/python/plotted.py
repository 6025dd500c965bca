"""Results of known laws for draw() of a panel, and the numbers that it plots.

Errors are distinct for every value, so that an error in place of a value, a wrong column, a swapped series or
a wrong factor is seen.
"""

import importlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.container import ErrorbarContainer

from workflow.lib.load import Quantity, Result

Law = tuple[Any, dict[str, Any]]  # values, and coordinates by axis
BATHS = {"nu_left": 220.0, "nu_right": 180.0, "temperature_left": 80.0, "temperature_right": 120.0}
CHAIN = {"cells": 8, "cell_length": "1/N", "sigma": 0.5, "gamma": "N", "rule": "elastic", **BATHS}
RING = {
    "cells": 11,
    "particles_per_cell": 20,
    "cell_length": 1.0,
    "sigma": 0.5,
    "gamma": "N",
    "rule": "elastic",
    "temperature": 500.0,
    "zero_total_momentum": False,
    "relaxation_time": 100.0,
}
PROVENANCE = {"converged": "no target", "events": 6400, "target_quantity": "", "achieved_error": 0.5}


def errors_of(values: np.ndarray) -> np.ndarray:
    """Distinct errors: 1 %, 1.1 %, 1.2 % ... of the mean magnitude."""
    size = np.nanmean(np.abs(values)) or 1.0
    errors: np.ndarray = 0.01 * size * (1 + 0.1 * np.arange(values.size)).reshape(values.shape)
    return np.where(np.isfinite(values), errors, np.nan)


def result(run: str, options: dict[str, Any], program: str = "sampled", **laws: Law | float) -> Result:
    """A result of a run with these quantities; of `boltzmann` without standard errors."""
    quantities = {}
    for name, law in laws.items():
        values, axes = law if isinstance(law, tuple) else (law, {})
        mean = np.asarray(values, dtype=float)
        coordinates = {axis: np.asarray(points, dtype=float) for axis, points in axes.items()}
        computed = program == "boltzmann"
        errors = (None, 0 * mean, None) if computed else (errors_of(mean), None, np.full(mean.shape, 64))
        quantities[name] = Quantity(mean, *errors, coordinates, "1", dict.fromkeys(axes, "1"), 0)
    path = Path(f"data/smoke/panel/{run}.h5")
    return Result(path, {"seed": 1, **options}, {"program": program, **PROVENANCE}, quantities)


def both(quantity: Quantity) -> tuple[np.ndarray, np.ndarray]:
    return quantity.mean, quantity.error


def over(runs: Sequence[Result], name: str) -> np.ndarray:
    """Values of a quantity without axes, and their errors, of several runs."""
    return np.transpose([both(run[name]) for run in runs])


def draw(
    script: str, results: Sequence[Result], folder: str = "figures"
) -> tuple[list[Axes], pd.DataFrame, str]:
    """Axes, table and caption of a panel."""
    plt.close("all")
    figure, table, caption = importlib.import_module(f"workflow.{folder}.{script}").draw([*results])
    return figure.axes, table.reset_index(drop=True), " ".join(caption.split())


def points(axes: Axes) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Abscissa, ordinate and error bar, vertical or horizontal, of every series of points; 0 without bars."""
    found = []
    for container in (each for each in axes.containers if isinstance(each, ErrorbarContainer)):
        line, _, bars = container
        x, y = (np.ma.filled(np.ma.asarray(values, dtype=float), np.nan) for values in line.get_data())
        segments = bars[0].get_segments() if bars else [np.zeros((1, 2))] * len(x)
        ends = [np.ptp(segment, axis=0).max() if len(segment) else np.nan for segment in segments]
        found.append((x, y, np.array(ends) / 2))
    return found


def lines(axes: Axes) -> list[tuple[np.ndarray, np.ndarray]]:
    """Abscissa and ordinate of the lines that are no series of points."""
    of_points = [container[0] for container in axes.containers]
    free = [line for line in axes.get_lines() if line not in of_points]
    return [tuple(np.asarray(values, dtype=float) for values in line.get_data()) for line in free]


def right_scale(axes: Axes) -> float:
    """A number on the axis on the right over the one beside it on the left."""
    axes.figure.canvas.draw()
    (right,) = axes.child_axes
    return float(right.get_ylim()[1] / axes.get_ylim()[1])


def assert_points(axes: Axes, *expected: tuple[Any, Any, Any]) -> None:
    """The series of points are these, in this order; NaN is not plotted."""
    for series, wanted in zip(points(axes), expected, strict=True):
        known = [np.atleast_1d(np.asarray(each, dtype=float)) for each in np.broadcast_arrays(*wanted)]
        shown, seen = (np.isfinite(each[1]) & np.isfinite(each[2]) for each in (series, known))
        for values, law in zip(series, known, strict=True):
            np.testing.assert_allclose(values[shown], law[seen], rtol=1e-9, atol=1e-12)


def assert_line(axes: Axes, x: Any, y: Any) -> None:
    """One of the lines has these points."""
    assert any(
        len(a) == len(x) and np.allclose(a, x) and np.allclose(b, y, rtol=1e-9, atol=0, equal_nan=True)
        for a, b in lines(axes)
    )
