"""Nothing that is plotted is lost in silence: points outside of frames, undefined values, series without a
look."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest

from tests.python.plotted import CHAIN, draw, points, result, right_scale
from workflow.figures import accuracy, fig03_inset
from workflow.lib import style
from workflow.lib.caption import warnings
from workflow.physics.fluxes import MEAN_FIELD, SIMULATION
from workflow.render.frame import outside

MANY = 7  # more than there are looks


def test_points_outside_of_the_frames_are_counted() -> None:
    """Two points are above the frame, one of them crossed out; four are negative on a logarithmic axis.
    Detected mistakes: ends of error bars, guides and NaN are counted, a point is counted twice."""
    figure, (above, below) = plt.subplots(2)
    x, y = np.arange(1.0, 6), np.array([1.0, 2, 9, 10, np.nan])
    above.errorbar(x, y, 20 + y, **style.points("o", style.BLUE))
    style.cross_out(above, x, y, y == 9)
    above.plot(x, 100 * x, **style.GUIDE)
    above.axhline(50)
    above.set_ylim(1, 5)
    assert outside(figure) == ["2 points are outside the frames."]
    below.errorbar(x, -x + 1.5, 0.1, **style.points("o", style.BLUE))
    below.set(yscale="log")
    assert outside(figure) == ["6 points are outside the frames."]
    above.set_ylim(0, 10)
    below.set(yscale="linear")
    assert outside(figure) == []
    plt.close(figure)


def test_points_of_insets_and_of_second_axes_are_counted() -> None:
    figure, axes = plt.subplots()
    inset, second = axes.inset_axes((0.6, 0.6, 0.3, 0.3)), axes.twinx()
    for frame in (inset, second):
        frame.plot([1, 2, 3], [1, 2, 30], "o")
        frame.set_ylim(0, 5)
    axes.secondary_yaxis("right")
    assert outside(figure) == ["2 points are outside the frames."]
    plt.close(figure)


def test_the_frame_of_fig02_upper_follows_the_baths() -> None:
    """Between T = 50 and T = 200, 25 of 60 points were outside of the frame. E_K = T/2 is on the right."""
    cells = np.arange(30)
    profile = (60 + 4 * cells, {"cell": cells})
    laws = {
        "temperature_scatterer": profile,
        "temperature_particle": profile,
        "temperature_difference": profile,
    }
    baths = {"temperature_left": 50.0, "temperature_right": 200.0}
    (above, _), _, _ = draw("fig02_upper", [result("deterministic", CHAIN | baths, **laws)])
    assert outside(above.figure) == []
    assert right_scale(above) == pytest.approx(0.5)
    low, high = above.get_ylim()
    assert low < baths["temperature_left"]
    assert high > baths["temperature_right"]


def test_more_series_than_looks_are_all_plotted() -> None:
    """Detected mistake: series from the fifth or sixth on are dropped."""
    sizes = np.arange(2, 2 + MANY)
    _, (of_sizes, kinetic) = plt.subplots(1, 2)
    rows = [
        {"kind": kind, "cells": size, "momentum": -1.0, "deviation": 0.1, "error": 0.1}
        for kind in (SIMULATION, MEAN_FIELD) for size in sizes
    ]  # fmt: skip
    fig03_inset.draw_end(of_sizes, pd.DataFrame(rows), -1, 2, "left end")
    runs = pd.DataFrame(
        {"gamma": sizes, "series": "kinetic", "cpu_seconds": 1.0, "error": 0.1}, columns=accuracy.COLUMNS
    )
    accuracy.draw_errors(kinetic, runs, runs[:0])
    assert len(points(of_sizes)) == len(kinetic.get_lines()) == len(kinetic.texts) == MANY
    plt.close("all")


def test_a_run_without_a_value_is_named() -> None:
    """Detected mistake: a size is missing in fig. 8 without a word."""
    run = result("rare_cells=32", CHAIN, kappa=np.nan)
    run.provenance["target_quantity"] = "kappa"
    assert warnings([run]) == ["Without a value: `rare_cells=32`."]
