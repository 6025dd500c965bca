"""Fonts, bands and axes of the figures, whose labels and colours follow rcParams."""

from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib import font_manager

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
    assert [path.parent for path in chosen] == [own] * 3
    assert [path.stem for path in chosen] == ["STIXGeneral", "STIXSizOneSymReg", "STIXGeneral"]
    assert foreign not in fonts.ttflist


def test_a_band_reaches_one_error_to_either_side_and_a_second_axis_has_its_factor() -> None:
    """At 3 ± 0.5, and at 10 times the numbers of the first axis."""
    figure, axes = plt.subplots()
    style.band(axes, [0, 1], [3, 3], [0.5, 0.5], style.BLUE)
    heights = axes.collections[0].get_paths()[0].vertices[:, 1]
    assert (heights.min(), heights.max()) == (2.5, 3.5)
    axes.set_ylim(0, 4)
    style.second_axis(axes, 10, "tenths")
    figure.canvas.draw()
    np.testing.assert_allclose(axes.child_axes[0].get_ylim(), (0, 40))
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
