"""Whether the points of a figure are in the frames of their axes."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from workflow.lib.figure import NoValueError
from workflow.lib.style import GUIDE

ROUNDING = 1e-9  # relative to the range of the axis


def outside(figure: Figure) -> list[str]:
    """A sentence on the points outside of the frames, if there are such. Raises NoValueError if no point of
    the figure is finite."""
    frames = _with_insets(figure.axes)
    points = [each for each in map(_points, frames) if len(each)]
    if points and not np.isfinite(np.concatenate(points)).all(axis=1).any():
        raise NoValueError(
            "no value to draw: all points are undefined, as κ between baths of one temperature"
        )
    number = sum(map(_outside, frames))
    text = "1 point is outside the frame." if number == 1 else f"{number} points are outside the frames."
    return [text] if number else []


def _with_insets(frames: Iterable[Any]) -> list[Axes]:
    """The axes, with their insets, which are not in figure.axes, and second axes that have points."""
    axes = [one for one in frames if isinstance(one, Axes)]
    return [*axes, *(child for one in axes for child in _with_insets(one.child_axes))]


def _points(axes: Axes) -> np.ndarray:
    """Points of the lines that are neither guides nor caps of error bars nor at a fixed position in the axes;
    a point that is crossed out counts once."""
    caps = {cap for container in axes.containers for cap in getattr(container, "lines", [(), ()])[1]}
    found = [np.empty((0, 2))]
    for line in axes.get_lines():
        if (
            line.get_transform() == axes.transData
            and line.get_zorder() > GUIDE["zorder"]
            and line not in caps
        ):
            found.append(np.ma.filled(np.ma.asarray(line.get_xydata(), dtype=float), np.nan))
    return np.unique(np.concatenate(found), axis=0)


def _outside(axes: Axes) -> int:
    """Number of the finite points that are not in the frame."""
    low, high = np.sort([axes.get_xlim(), axes.get_ylim()]).T
    points = _points(axes)
    beyond = np.maximum(low - points, points - high) > ROUNDING * (high - low)
    return int((beyond.any(axis=1) & np.isfinite(points).all(axis=1)).sum())
