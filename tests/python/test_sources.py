"""The source files of a script are found from its imports."""

from pathlib import Path

import pytest

from workflow.lib.plan import load_plan
from workflow.provenance import sources
from workflow.provenance.sources import sources_of


def test_imports_are_followed() -> None:
    found = sources_of("workflow/figures/fig10.py")
    assert found[0] == "workflow/figures/fig10.py"
    lib = (
        "caption",
        "columns",
        "figure",
        "fit",
        "load",
        "option_units",
        "parents",
        "places",
        "save",
        "style",
        "units",
    )
    assert set(found[1:]) == {"workflow/figures/fig09.py", *(f"workflow/lib/{name}.py" for name in lib)}


def test_every_form_of_import(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "workflow/figures"
    folder.mkdir(parents=True)
    (folder / "a.py").write_text("import os\nimport workflow.figures.b\nfrom workflow.figures import c\n")
    (folder / "b.py").write_text("from workflow.figures.d import x\nfrom workflow.figures import a\n")
    for name in "cde":
        (folder / f"{name}.py").write_text("")
    monkeypatch.setattr(sources, "ROOT", tmp_path)
    assert sources_of("workflow/figures/a.py") == [f"workflow/figures/{name}.py" for name in "abcd"]


def test_every_panel_has_its_sources() -> None:
    for panel in load_plan("smoke").values():
        assert "workflow/lib/load.py" in sources_of(f"workflow/figures/{panel.script}.py")


def test_a_missing_script_is_an_error() -> None:
    with pytest.raises(FileNotFoundError, match="nothing"):
        sources_of("workflow/figures/nothing.py")


@pytest.mark.parametrize("content", [b"def (", b"# caf\xe9", b"a = '\0'", b"(" * 100_000])
def test_a_script_that_is_no_python_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: bytes
) -> None:
    (tmp_path / "a.py").write_bytes(content)
    monkeypatch.setattr(sources, "ROOT", tmp_path)
    with pytest.raises(OSError, match="no Python") as error:
        sources_of("a.py")
    assert error.value.filename == "a.py"
