"""Figures do not depend on installed fonts."""

from pathlib import Path

import matplotlib as mpl
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
