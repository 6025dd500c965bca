"""Whether the points of a figure are in the frames of their axes."""

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.container import ErrorbarContainer
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from workflow.lib.figure import NoValueError
from workflow.lib.style import GUIDE

ROUNDING = 1e-9  # relative to the range of the axis


def data_lines(axes: Axes) -> Iterator[Line2D]:
    """Lines of points and curves: no guides, no caps of error bars, none that are at a fixed position in the
    axes."""
    bars = [each for each in axes.containers if isinstance(each, ErrorbarContainer)]
    caps = {cap for container in bars for cap in container.lines[1]}
    for line in axes.get_lines():
        if (
            line not in caps
            and line.get_transform() == axes.transData
            and line.get_zorder() > GUIDE["zorder"]
        ):
            yield line


def finite_points(axes: Axes) -> set[tuple[float, float]]:
    """Points with finite coordinates. Those that are crossed out count once."""
    points: set[tuple[float, float]] = set()
    for line in data_lines(axes):
        x, y = (np.ma.filled(np.ma.asarray(values, dtype=float), np.nan) for values in line.get_data())
        known = np.isfinite(x) & np.isfinite(y)
        points |= {*zip(x[known].tolist(), y[known].tolist(), strict=True)}
    return points


def _inside(value: float, ends: tuple[float, float]) -> bool:
    low, high = sorted(ends)
    return low - ROUNDING * (high - low) <= value <= high + ROUNDING * (high - low)


def with_outside(caption: str, figure: Figure) -> str:
    """The caption, with a sentence on the points outside of the frames. Raises NoValueError if no point of
    the figure is finite."""
    points = [(axes, finite_points(axes)) for axes in figure.axes]
    if not any(of_axes for _, of_axes in points) and any(any(data_lines(axes)) for axes in figure.axes):
        raise NoValueError(
            "no value to draw: all points are undefined, as κ is between baths of one temperature"
        )
    outside = sum(
        not (_inside(x, axes.get_xlim()) and _inside(y, axes.get_ylim()))
        for axes, of_axes in points
        for x, y in of_axes
    )
    text = "1 point is outside the frame" if outside == 1 else f"{outside} points are outside the frames"
    return f"{caption} {text}." if outside else caption
