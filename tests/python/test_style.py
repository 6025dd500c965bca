"""Fonts, names and axes of the figures, whose labels and colours follow rcParams."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib import font_manager
from matplotlib.text import Text

from workflow.lib import style


@pytest.mark.parametrize("family", ["STIXGeneral", "STIXSizeOneSym", "Times New Roman"])
def test_no_font_but_those_of_matplotlib_is_taken(family: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Fonts are taken neither from a cached list of fonts nor from a system font of the same name."""
    own = Path(mpl.get_data_path(), "fonts/ttf")
    foreign = font_manager.FontEntry(fname=str(own / "DejaVuSans.ttf"), name=family)
    fonts = font_manager.FontManager()
    fonts.ttflist = [foreign]
    monkeypatch.setattr(font_manager, "fontManager", fonts)
    assert Path(fonts.findfont(family)).name == "DejaVuSans.ttf"
    style.apply()
    chosen = [Path(fonts.findfont(name)) for name in ("STIXGeneral", "STIXSizeOneSym", "serif")]
    assert [path.parent.resolve() for path in chosen] == [own.resolve()] * 3  # .venv may be a link
    assert [path.stem for path in chosen] == ["STIXGeneral", "STIXSizOneSymReg", "STIXGeneral"]
    assert foreign not in fonts.ttflist


def test_names_of_ends_do_not_overlap() -> None:
    """Three ends at almost one height, and three at the limits. Detected mistakes: names that overlap,
    cross, leave the frame, or move without need."""
    style.apply()
    figure, axes = plt.subplots()
    axes.set(yscale="log", ylim=(1, 1e4), xlim=(0, 1))
    ends = {"low": 1.0, "c": 99.99, "b": 100.0, "a": 100.01, "next": 9999.0, "top": 1e4}
    style.name_ends(axes, [(name, 0.95, ends[name], style.BLUE) for name in sorted(ends)])
    figure.canvas.draw()
    texts = {text.get_text(): text for text in axes.texts}
    boxes = [Text.get_window_extent(texts[name]) for name in ends]  # without the leader
    assert all(box.y1 < above.y0 for box, above in pairwise(boxes))
    assert min(box.x0 for box in boxes) > axes.bbox.x1
    heights = [texts[name].get_position()[1] for name in ("low", "b", "top")]
    np.testing.assert_allclose(heights, [0, 0.5, 1], atol=1e-4)
    plt.close(figure)


def test_labels_and_colours_follow_the_parameters_of_matplotlib() -> None:
    mpl.rcParams.update({"font.size": 14, "axes.prop_cycle": mpl.cycler(color=["#111111"] * 5)})
    mpl.rcParams["legend.fontsize"] = "medium"
    _, axes = plt.subplots()
    style.guide_at(axes, 0, "guide")
    (points, *_) = axes.errorbar([1], [1], [1], **style.points("o", style.SKY))
    assert axes.texts[0].get_size() == 14
    assert mpl.colors.to_hex(points.get_color()) == "#111111"
    plt.close()
    style.apply()
    assert mpl.colors.to_hex(style.SKY) == "#56b4e9"
    assert style.label_size() == 8


@pytest.mark.parametrize("sizes", [(50, 55, 60), (2, 4, 8, 16), [2**k for k in range(2, 12)]])
def test_a_size_axis_has_numbers_at_its_sizes(sizes: Sequence[int]) -> None:
    """Detected mistake: ticks at powers of two only, of which there are none between 50 and 60."""
    _, axes = plt.subplots()
    axes.plot(sizes, sizes)
    style.against_size(axes, sizes)
    ticks = [int(text.get_text()) for text in axes.get_xticklabels()]
    assert 3 <= len(ticks) <= style.MOST_TICKS
    assert {*ticks} <= {*sizes}
    plt.close("all")
