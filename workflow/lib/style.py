"""Style of the figures: sizes, fonts, and colours that are distinct in grey and for colour-blind readers."""

import math
from collections.abc import Iterable
from itertools import cycle
from pathlib import Path
from string import ascii_lowercase
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib import font_manager
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.rcsetup import cycler
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter, NullLocator
from matplotlib.typing import LineStyleType, RcKeyType
from numpy.typing import ArrayLike

Look = dict[str, Any]  # keyword arguments of plotting functions

# Width of a journal column, and height, in inches.
COLUMN = 3.4
HEIGHT = 3.0

# Text in the axis labels of quantities with a dimension.
UNIT_SYSTEM = "$m = k_B = 1$"

# Colours of matplotlib's cycle, which apply() sets to those of Okabe and Ito (2008). Neighbours in SEQUENCE
# differ in lightness; markers differ too.
BLACK = "#000000"
BLUE, ORANGE, GREEN, VERMILLION, SKY, PURPLE = "C0", "C1", "C2", "C3", "C4", "C5"

# Colours and dashes for an ordered set of curves, with increasing lightness and increasing gaps.
SEQUENCE = [BLACK, BLUE, VERMILLION, ORANGE, SKY]
DASHES: list[LineStyleType] = ["solid", (0, (6, 1)), (0, (4, 1, 1, 1)), (0, (3, 1.5)), (0, (1, 1))]

# Markers and colours of series of points.
LOOKS = [("o", BLUE), ("s", VERMILLION), ("^", GREEN), ("D", ORANGE), ("v", SKY)]

MOST_TICKS = 6  # with numbers of up to four digits in a column

# Style of the shaded range of a fit.
WINDOW: Look = {"color": "0.92", "linewidth": 0, "zorder": -1}

# Lines with this zorder or less are no data: they may end outside of the frame.
GUIDE: Look = {"color": "0.55", "linestyle": (0, (4, 2)), "linewidth": 0.8, "zorder": 0}

LINE_OF_TEXT = 0.13  # inches from label to label

POINTS: Look = {
    "linestyle": "none",
    "capsize": 1.5,
    "elinewidth": 0.8,
    "capthick": 0.8,
    "markeredgewidth": 0.8,
}

_SETTINGS: dict[RcKeyType, Any] = {
    "font.family": "serif",
    "font.serif": ["STIXGeneral"],
    "font.size": 9,
    "mathtext.fontset": "stix",
    "axes.prop_cycle": cycler(color=["#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#CC79A7"]),
    "axes.linewidth": 0.6,
    "axes.labelsize": 9,
    "axes.titlesize": 9,
    "legend.title_fontsize": 8,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "legend.handlelength": 1.6,
    "lines.linewidth": 1.0,
    "lines.markersize": 3.5,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "figure.constrained_layout.use": True,
    "savefig.dpi": 300,
    "pdf.fonttype": 42,
    "svg.fonttype": "path",  # browsers have no STIX
    "svg.hashsalt": "lorentz-gas",
}


def apply() -> None:
    """Applies the style, independent of matplotlibrc, and of the fonts of the system: only those of
    matplotlib are used."""
    mpl.rcdefaults()
    mpl.rcParams.update(_SETTINGS)
    fonts = font_manager.fontManager
    fonts.ttflist.clear()
    for path in sorted(Path(mpl.get_data_path(), "fonts/ttf").glob("*.ttf")):
        fonts.addfont(path)


def points(marker: str, color: str, face: str | None = None, **more: Any) -> Look:
    """Style of measured points. face: fill colour of the marker, if it differs from its edge."""
    return {**POINTS, "marker": marker, "color": color, "markerfacecolor": face or color, **more}


def by_gamma(gammas: Iterable[str]) -> dict[str, tuple[str, str]]:
    """Marker and colour for each gamma: circles for N and squares for another, as in the paper."""
    others = [gamma for gamma in dict.fromkeys(gammas) if gamma != "N"]
    return dict(zip(["N", *others], cycle(LOOKS), strict=False))


def name_point(axes: Axes, name: str, point: tuple[float, Any], lift: tuple[int, int], **look: Any) -> None:
    """Writes a name beside a point, at a distance in points."""
    axes.annotate(name, point, lift, textcoords="offset points", size=label_size(), **look)


def name_ends(axes: Axes, ends: Iterable[tuple[str, float, float, str]]) -> None:
    """Writes names to the right of points, or of the frame if one is next to it, as near to their heights as
    the size of the text allows. ends: name, x, y, colour. Limits of the axes must not change later."""
    from scipy.optimize import isotonic_regression  # noqa: PLC0415  0.2 s, which most panels do not need

    axes.get_xlim()  # updates the limits
    in_frame = axes.transScale + axes.transLimits
    placed = sorted((*in_frame.transform((x, y))[::-1], name, color) for name, x, y, color in ends)
    if not placed:
        return
    heights, right = np.array([end[0] for end in placed]), max(end[1] for end in placed)
    left = 0.04 + (1 if right > 0.9 else right)
    inches = axes.bbox.transformed(axes.figure.dpi_scale_trans.inverted()).height
    apart = LINE_OF_TEXT / inches * np.arange(len(placed))
    shifted = np.clip(isotonic_regression(heights - apart).x, 0, max(0, 1 - apart[-1])) + apart
    for (height, x, name, color), text in zip(placed, shifted, strict=True):
        leader = {"arrowstyle": "-", "linewidth": 0.5, "color": color, "shrinkA": 0, "shrinkB": 0}
        leader["relpos"] = (0, 0.5)  # from the middle of the left edge: others would cross names
        look: Look = {"color": color, "size": label_size(), "va": "center", "arrowprops": leader}
        axes.annotate(name, (x, height), (left, text), "axes fraction", annotation_clip=False, **look)


def band(axes: Axes, x: ArrayLike, value: ArrayLike, error: ArrayLike, color: str) -> None:
    """Shades the value plus and minus its error."""
    low, high = (np.add(value, np.multiply(sign, error)) for sign in (-1, 1))
    axes.fill_between(x, low, high, color=color, alpha=0.3, linewidth=0)


def stacked(*ratios: float, height: float, width: float = 1) -> tuple[Figure, list[Axes]]:
    """Lettered panels, one below the other, with one x axis. ratios: of their heights; height, width: of
    the whole, in HEIGHT and COLUMN."""
    figure, panels = plt.subplots(
        len(ratios), sharex=True, figsize=(width * COLUMN, height * HEIGHT), height_ratios=ratios
    )
    letter(*panels)
    figure.align_ylabels()
    return figure, [*panels]


def letter(*panels: Axes, lift: float | None = None, first: int = 0) -> None:
    """Labels panels (a), (b), ... above the upper left corner. lift: distance in points, needed if one has
    tick labels on top; first: number of panels that are labelled already."""
    for character, axes in zip(ascii_lowercase[first:], panels, strict=False):
        axes.set_title(f"({character})", loc="left", y=None if lift is None else 1, pad=lift)


def label_size() -> float | str:
    """Size of the text beside lines and points: that of legends, as in rcParams."""
    return mpl.rcParams["legend.fontsize"]


def guide_at(axes: Axes, value: float, name: str, **look: Any) -> None:
    """Horizontal guide, labelled on the right of the frame. look: what differs from GUIDE."""
    axes.axhline(value, **GUIDE | look)
    axes.annotate(name, (1.01, value), xycoords=("axes fraction", "data"), va="center", size=label_size())


def second_axis(axes: Axes, factor: float, label: str) -> None:
    """Adds a y axis in another unit on the right."""
    axes.tick_params(axis="y", which="both", right=False)
    secondary = axes.secondary_yaxis(
        "right", functions=(lambda y: np.multiply(factor, y), lambda y: np.divide(y, factor))
    )
    secondary.set_ylabel(label)


def label_within_decades(axis: Axis) -> None:
    """Decimal ticks at 1, 2 and 5, for logarithmic axes of one or two decades."""
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def against_size(axes: Axes, sizes: Iterable[int]) -> None:
    """A logarithmic x axis of numbers of cells, with ticks at these, or at every second or third of many."""
    known = sorted({*sizes})
    ticks = known[:: max(1, math.ceil(len(known) / MOST_TICKS))]
    axes.set(xscale="log", xlabel="number of cells $N$")
    axes.set_xticks(ticks, [f"{size:g}" for size in ticks], minor=False)
    axes.xaxis.set_minor_locator(NullLocator())


def cross_out(axes: Axes, x: np.ndarray, y: np.ndarray, where: np.ndarray) -> None:
    """Crosses out points with a warning."""
    axes.plot(x[where], y[where], linestyle="none", marker="x", color=BLACK, markersize=6, zorder=5)
